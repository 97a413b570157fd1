#include "lost_state.h"

#include "comm.h"
#include "error.h"
#include "fix_contact_history.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {
// parts of a restart file that wait for their fixes are protected
struct Waiting : Modify {
  static bool here(Modify *modify, int n)
  {
    return (modify->*(&Waiting::used_restart_global))[n] == 0;
  }
  static std::pair<std::string, std::string> name(Modify *modify, int n)
  {
    return {(modify->*(&Waiting::id_restart_global))[n],
            (modify->*(&Waiting::style_restart_global))[n]};
  }
};
}    // namespace

void LostState::note(Modify *modify)
{
  if (modify->nfix_restart_global > 0) lost.clear();    // all wait yet
  for (int n = 0; n < modify->nfix_restart_global; n++)
    if (Waiting::here(modify, n)) lost.push_back(Waiting::name(modify, n));
}

bool LostState::take(const Fix *fix)
{
  const auto part = std::find(lost.begin(), lost.end(),
                              std::make_pair<std::string, std::string>(fix->id, fix->style));
  if (part == lost.end()) return false;
  lost.erase(part);
  return true;
}

void LostState::warn(LAMMPS *lmp, const Fix *fix, const std::string &means)
{
  bool is_lost = false;
  for (const auto &other : lmp->modify->get_fix_by_style("^contact/history")) {
    auto *history = dynamic_cast<FixContactHistory *>(other);
    if (history && history->lost.take(fix)) is_lost = true;
  }
  if (is_lost && lmp->comm->me == 0)
    lmp->error->warning(FLERR,
                        "Fix {} {}: the restart file had its state, but a command that prepares "
                        "a run, such as run 0, write_data or delete_atoms overlap, came before "
                        "this fix was given, and LAMMPS threw it away: {}; give all fixes "
                        "directly after read_restart",
                        fix->style, fix->id, means);
}
