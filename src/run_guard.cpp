#include "run_guard.h"

#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
// the number of a fix is protected
struct Numbered : Fix {
  static int instance(const Fix *fix) { return fix->*(&Numbered::instance_me); }
};

bool is_ours(const Fix *fix)
{
  for (const char *style : {"^contact/history", "^flow/concentration", "^flow/field", "^flow/force",
                            "^inlet/flow", "^nve/sphere/mts", "^wall/levelset"})
    if (utils::strmatch(fix->style, style)) return true;
  return false;
}
}    // namespace

void RunGuard::prepared()
{
  fixes.clear();
  for (const auto &fix : modify->get_fix_list())
    if (!utils::strmatch(fix->style, "^MINIMIZE$"))    // it goes when the minimiser ends
      fixes.push_back({Numbered::instance(fix), fix->id});
  note_box();
}

void RunGuard::note_box()
{
  box = box_now();
  knows_box = true;
}

RunGuard::Box RunGuard::box_now() const
{
  Box now = {domain->xy, domain->xz, domain->yz, static_cast<double>(domain->triclinic)};
  for (int c = 0; c < 3; c++) {
    double *of_axis = &now[4 + 4 * c];
    of_axis[0] = domain->boxlo[c];
    of_axis[1] = domain->boxhi[c];
    of_axis[2] = domain->boundary[c][0];
    of_axis[3] = domain->boundary[c][1];
  }
  return now;
}

bool RunGuard::holds_box() const
{
  return !knows_box || box == box_now();
}

void RunGuard::require_box(const std::string &who) const
{
  if (!holds_box())
    error->all(FLERR, Error::NOLASTLINE,
               "{}: the box was changed since the last run: use run without pre no", who);
}

// Others' fixes that have come since do nothing in a run without setup, and harm nobody.
std::string RunGuard::changed() const
{
  const auto &now = modify->get_fix_list();
  for (size_t k = 0; k < fixes.size(); k++)
    if (k >= now.size() || Numbered::instance(now[k]) != fixes[k].instance) return fixes[k].id;
  for (size_t k = fixes.size(); k < now.size(); k++)
    if (is_ours(now[k])) return now[k]->id;
  return {};
}

void RunGuard::require(const Fix *who) const
{
  if (update->whichflag != 1 || update->setupflag) return;
  const auto name = [who] {
    return who ? fmt::format("Fix {} {}", who->style, who->id) : "Pair granular/adhesive";
  };
  if (fixes.empty())
    error->all(FLERR, Error::NOLASTLINE,
               "{} is new or has new coefficients since the last run: use run without pre no",
               name());
  if (const std::string other = changed(); !other.empty())
    error->all(
        FLERR, Error::NOLASTLINE,
        "{}: fix {} was made, replaced or taken away since the last run: use run without pre "
        "no",
        name(), other);
  // what changes the box within a run may have done so in this step
  if (!domain->box_change && !holds_box()) require_box(name());
}
