// Which particles are connected over all ranks, and how large the aggregates are. Contacts and
// bridges are gathered in compute_aggregate_contact_gather.cpp.

#include "compute_aggregate_contact.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_contacts.h"
#include "force.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <unordered_map>

using namespace LAMMPS_NS;

namespace {

enum { ID, SIZE, WALL, CONTACTS_OF_ATOM, BRIDGES_OF_ATOM, LIQUID_OF_ATOM, N_COLUMNS };

// the atom that stands for a connected set; shortens the way there for the next search
int find_root(std::vector<int> &parent, int i)
{
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}    // namespace

/* ---------------------------------------------------------------------- */

ComputeAggregateContact::ComputeAggregateContact(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), nmax(0), totals{}, reverse(LABEL)
{
  if (narg > 3)
    error->all(FLERR, 3, "Compute aggregate/contact takes no arguments, got {}", arg[3]);
  if (!atom->tag_enable)
    error->all(FLERR, "Compute aggregate/contact needs atom IDs: atom_modify id yes");

  peratom_flag = 1;
  size_peratom_cols = N_COLUMNS;
  vector_flag = 1;
  size_vector = 6;
  extvector = 0;    // counts are not to be divided by the number of atoms
  comm_forward = 1;
  comm_reverse = 3;
  vector = new double[size_vector];
  std::fill_n(vector, size_vector, 0.0);
}

ComputeAggregateContact::~ComputeAggregateContact()
{
  memory->destroy(array_atom);
  delete[] vector;
}

void ComputeAggregateContact::init()
{
  contacts_are_old = true;
  require_contacts();
}

void ComputeAggregateContact::require_contacts()
{
  if (!keeps_contacts(force->pair))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute aggregate/contact needs a pair style that keeps contacts, such as "
               "granular/adhesive; the pair style is {}",
               force->pair ? force->pair_style : "none");
}

std::unique_ptr<ComputeAggregateContact> ComputeAggregateContact::of_all(LAMMPS *lmp, Pair *pair)
{
  if (!keeps_contacts(pair)) return nullptr;
  char id[] = "aggregates", group[] = "all", style[] = "aggregate/contact";
  char *words[] = {id, group, style};
  return std::make_unique<ComputeAggregateContact>(lmp, 3, words);
}

/* ---------------------------------------------------------------------- */

void ComputeAggregateContact::compute_peratom()
{
  if (invoked_peratom != update->ntimestep) find_aggregates();
}

void ComputeAggregateContact::compute_vector()
{
  if (invoked_vector != update->ntimestep) find_aggregates();
}

// both outputs, so that the second of them that is asked for costs nothing
void ComputeAggregateContact::find_aggregates()
{
  if (contacts_are_old && update->setupflag)    // not these atoms, or not this decomposition
    error->all(
        FLERR, Error::NOLASTLINE,
        "Compute aggregate/contact {} is asked for before the first forces of a run, as by a "
        "variable of fix balance or of a flow, or by a dynamic group: keep its values for that by "
        "fix ave/atom",
        id);
  if (update->whichflag == 0) require_contacts();    // they may be gone since the last run
  if (update->whichflag == 0 && (!FixContacts::lists_hold(lmp) || atoms_have_changed()))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute aggregate/contact {} is asked for after atoms were moved or renumbered, as "
               "by write_restart, and before contacts were found again: use run 0 first",
               id);
  invoked_peratom = invoked_vector = update->ntimestep;

  start_labels();
  gather_contacts();
  gather_wall_contacts();
  connect_contacts();
  spread_labels();
  measure_aggregates();

  Totals sum;
  MPI_Allreduce(&totals, &sum, sizeof(Totals) / sizeof(bigint), MPI_LMP_BIGINT, MPI_SUM, world);
  auto mean = [](bigint particles, bigint aggregates) {
    return aggregates ? static_cast<double>(particles) / aggregates : 0.0;
  };
  vector[0] = sum.particles;
  vector[1] = sum.aggregates;
  vector[2] = mean(sum.particles, sum.aggregates);
  vector[3] = sum.wall_particles;
  vector[4] = sum.wall_aggregates;
  vector[5] = mean(sum.wall_particles, sum.wall_aggregates);
}

// Labels tell the group of ghosts too: their masks are as old as the last re-neighbouring.
void ComputeAggregateContact::start_labels()
{
  label.assign(atom->nlocal + atom->nghost, 0);
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) label[i] = atom->tag[i];
  comm->forward_comm(this);
}

// union-find over the contacts of this rank
void ComputeAggregateContact::connect_contacts()
{
  std::vector<int> parent(label.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto &c : contacts) parent[find_root(parent, c.i)] = find_root(parent, c.j);
  for (auto &c : contacts) c.root = find_root(parent, c.i);
}

// The smallest ID goes through all that is connected on a rank at once, then over to the images of
// its atoms: as many rounds as an aggregate crosses boundaries. With newton on a contact is known
// to one rank only, so ghosts speak to their owners (reverse) before owners speak to ghosts.
void ComputeAggregateContact::spread_labels()
{
  int differ = 1;
  while (differ) {
    for (const auto &c : contacts)
      label[c.root] = std::min({label[c.root], label[c.i], label[c.j]});
    for (const auto &c : contacts) label[c.i] = label[c.j] = label[c.root];

    reverse = LABEL;
    comm->reverse_comm(this, 1);
    comm->forward_comm(this);

    int differ_here = 0;
    for (const auto &c : contacts)
      if (label[c.i] != label[c.root] || label[c.j] != label[c.root]) differ_here = 1;
    MPI_Allreduce(&differ_here, &differ, 1, MPI_INT, MPI_MAX, world);
  }
}

void ComputeAggregateContact::measure_aggregates()
{
  std::vector<std::uint64_t> wall(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) wall[i] = n_wall_contacts[i] > 0;
  std::vector<int> part_of;
  const auto parts = gather_parts(wall, part_of);
  write_rows(parts, part_of);
}

void ComputeAggregateContact::spread(std::vector<std::uint64_t> &bits)
{
  compute_peratom();
  std::vector<int> part_of;
  const auto parts = gather_parts(bits, part_of);
  for (int i = 0; i < atom->nlocal; i++)
    if (part_of[i] >= 0) bits[i] = parts[part_of[i]].marks;
}

// Each rank sends what it has of every aggregate to the rank that the ID of the aggregate hashes to
// and gets the sums back. A particle without contacts is all of its aggregate and is not sent.
//   marks     of each atom, to be united
//   part_of   number of each atom's part, -1 without
std::vector<ComputeAggregateContact::Part>
ComputeAggregateContact::gather_parts(const std::vector<std::uint64_t> &marks,
                                      std::vector<int> &part_of)
{
  const int nlocal = atom->nlocal;
  std::vector<Part> parts;
  std::vector<int> owners;
  part_of.assign(nlocal, -1);
  std::unordered_map<tagint, int> known;
  for (int i = 0; i < nlocal; i++) {
    if (!n_pair_contacts[i]) continue;
    const auto found = known.emplace(label[i], static_cast<int>(parts.size()));
    part_of[i] = found.first->second;
    if (found.second) {
      parts.push_back({label[i], 0, 0, comm->me, part_of[i]});
      owners.push_back(std::hash<tagint>{}(label[i]) % comm->nprocs);
    }
    auto &part = parts[part_of[i]];
    part.size++;
    part.marks |= marks[i];
  }

  totals = {};
  char *answer;
  constexpr int all_to_all = 1, unordered = 0;
  const int n = comm->rendezvous(all_to_all, static_cast<int>(parts.size()),
                                 reinterpret_cast<char *>(parts.data()), sizeof(Part), unordered,
                                 owners.data(), add_parts, unordered, answer, sizeof(Part), this);
  const auto *whole = reinterpret_cast<const Part *>(answer);
  for (int k = 0; k < n; k++) parts[whole[k].position] = whole[k];
  memory->sfree(answer);
  return parts;
}

void ComputeAggregateContact::write_rows(const std::vector<Part> &parts,
                                         const std::vector<int> &part_of)
{
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(array_atom);
    memory->create(array_atom, nmax, N_COLUMNS, "aggregate/contact:array_atom");
  }
  for (int i = 0; i < atom->nlocal; i++) {
    const int inside = label[i] ? 1 : 0;
    const bool single = part_of[i] < 0;
    const bool wall = single ? n_wall_contacts[i] > 0 : parts[part_of[i]].marks != 0;
    array_atom[i][ID] = label[i];
    array_atom[i][SIZE] = single ? inside : parts[part_of[i]].size;
    array_atom[i][WALL] = wall ? 1.0 : 0.0;
    array_atom[i][CONTACTS_OF_ATOM] = n_pair_contacts[i] + n_wall_contacts[i];
    array_atom[i][BRIDGES_OF_ATOM] = n_bridges[i];
    array_atom[i][LIQUID_OF_ATOM] = inside ? liquid[i] : 0.0;
  }
}

// Callback of rendezvous: sums the parts of each aggregate, counts the aggregates that meet here,
// and returns every part, now with the sums, to where it came from.
int ComputeAggregateContact::add_parts(int n, char *buf, int &flag, int *&ranks, char *&answer,
                                       void *self)
{
  auto *compute = static_cast<ComputeAggregateContact *>(self);
  auto *parts = reinterpret_cast<Part *>(buf);

  std::unordered_map<tagint, Part> aggregates;
  for (int k = 0; k < n; k++) {
    auto &whole = aggregates.emplace(parts[k].id, Part{parts[k].id, 0, 0, 0, 0}).first->second;
    whole.size += parts[k].size;
    whole.marks |= parts[k].marks;
  }

  auto &totals = compute->totals;
  for (const auto &entry : aggregates) {
    const Part &whole = entry.second;
    if (whole.size < 2) continue;    // a particle that touches its own periodic image
    totals.particles += whole.size;
    totals.aggregates++;
    if (!whole.marks) continue;
    totals.wall_particles += whole.size;
    totals.wall_aggregates++;
  }

  compute->memory->create(ranks, n, "aggregate/contact:ranks");    // freed by rendezvous
  for (int k = 0; k < n; k++) {
    const Part &whole = aggregates.at(parts[k].id);
    parts[k].size = whole.size;
    parts[k].marks = whole.marks;
    ranks[k] = parts[k].rank;
  }
  answer = buf;
  flag = 1;    // the answer is the input buffer
  return n;
}

/* ---------------------------------------------------------------------- */

int ComputeAggregateContact::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/,
                                               int * /*pbc*/)
{
  for (int m = 0; m < n; m++) buf[m] = ubuf(label[list[m]]).d;
  return n;
}

void ComputeAggregateContact::unpack_forward_comm(int n, int first, double *buf)
{
  for (int m = 0; m < n; m++) label[first + m] = static_cast<tagint>(ubuf(buf[m]).i);
}

int ComputeAggregateContact::pack_reverse_comm(int n, int first, double *buf)
{
  for (int i = first; i < first + n; i++)
    if (reverse == LABEL) {
      *buf++ = ubuf(label[i]).d;
    } else {
      *buf++ = n_pair_contacts[i];
      *buf++ = n_bridges[i];
      *buf++ = liquid[i];
    }
  return reverse == LABEL ? n : 3 * n;
}

void ComputeAggregateContact::unpack_reverse_comm(int n, int *list, double *buf)
{
  for (int m = 0; m < n; m++) {
    const int i = list[m];
    if (reverse == LABEL) {
      label[i] = std::min(label[i], static_cast<tagint>(ubuf(*buf++).i));
    } else {
      n_pair_contacts[i] += static_cast<int>(*buf++);
      n_bridges[i] += static_cast<int>(*buf++);
      liquid[i] += *buf++;
    }
  }
}

double ComputeAggregateContact::memory_usage()
{
  return static_cast<double>(nmax) * N_COLUMNS * sizeof(double) +
      contacts.capacity() * sizeof(Contact) + label.capacity() * sizeof(tagint) +
      (n_pair_contacts.capacity() + n_wall_contacts.capacity()) * sizeof(int);
}
