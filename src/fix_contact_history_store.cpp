// Contacts and bridges of FixContactHistory while lists are built anew: with their atoms, by ID,
// and with the owners of ghosts.

#include "fix_contact_history.h"

#include "atom.h"
#include "box_images.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "neighbor.h"
#include "pair_granular_adhesive.h"

#include <algorithm>
#include <type_traits>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   each contact goes to both its atoms, also to those of other ranks
------------------------------------------------------------------------- */

void FixContactHistory::store_contacts()
{
  const auto &contacts = pair->closed_contacts();
  const tagint *tag = atom->tag;
  const int nlocal = atom->nlocal;
  const auto *bridges = pair->liquid_bridges();
  // about as many come from ghosts on other ranks as go there
  auto room = [&](const auto &list) {
    const auto shared = std::count_if(list.j.begin(), list.j.end(), [&](int j) {
      return j >= nlocal;
    });
    return list.size() + shared + shared / 4;
  };
  store.start(nlocal + atom->nghost, room(contacts), bridges ? room(*bridges) : 0, pair->planar());
  for (int i = 0; i < nlocal; i++) store.set_owner(i, tag[i]);
  auto keep = [&](auto &records, int i, int j, const auto &memory) {
    if (j < nlocal || force->newton_pair)
      records.add(i, j, tag[i], tag[j], memory);
    else
      records.add(i, tag[j], memory);
  };
  for (int k = 0; k < contacts.size(); k++)
    keep(store.contacts, contacts.i[k], contacts.j[k], contacts.history_of(k));
  if (force->newton_pair) send_to_owners(store.contacts);
  if (bridges) {
    for (int k = 0; k < bridges->size(); k++)
      keep(store.bridges, bridges->i[k], bridges->j[k], bridges->memory(k));
    if (force->newton_pair) send_to_owners(store.bridges);
  }
  if (!pair->remembers()) return;
  check_images(contacts, store.contacts, "touches", "");
  if (bridges) check_images(*bridges, store.bridges, "has a liquid bridge with", " and bridges");
}

// Of a pair that is joined by two images at once both would find one memory, and where another
// image than the one that is joined is nearer, that one would.
template <class List, class Records>
void FixContactHistory::check_images(const List &list, const Records &records, const char *does,
                                     const char *wider) const
{
  constexpr double apart = 1.01;    // since the list is built a step later
  const NearestImages images(domain);
  if (images.width() > (1.0 + apart) * (neighbor->cutneighmax - neighbor->skin)) return;
  velocities.bodies.with_rows([&](const auto *rows) {
    for (int k = 0; k < list.size(); k++) {
      const int i = list.i[k], j = list.j[k];
      double d[3] = {};
      for (int c = 0; c < domain->dimension; c++) d[c] = rows[j].x[c] - rows[i].x[c];
      if (!images.nearest(d, apart)) refuse_images(i, atom->tag[j], does, wider);
    }
  });
  for (int i = 0; i < atom->nlocal; i++)
    if (const tagint partner = records.repeated(i)) refuse_images(i, partner, does, wider);
}

void FixContactHistory::refuse_images(int i, tagint partner, const char *does,
                                      const char *wider) const
{
  error->one(
      FLERR, Error::NOLASTLINE,
      "Pair granular/adhesive: particle {} {} {} at about the same distance through two faces "
      "of the box, which is {:.6g} thick along a periodic axis, and must be thicker than two "
      "diameters and necks{}",
      atom->tag[i], does, partner == atom->tag[i] ? "itself" : fmt::format("particle {}", partner),
      NearestImages(domain).width(), wider);
}

/* ----------------------------------------------------------------------
   delete_atoms and reset_atoms may have numbered atoms anew since the last run; new ones may have
   the IDs of those that were deleted
------------------------------------------------------------------------- */

void FixContactHistory::setup_pre_exchange()
{
  const tagint *tag = atom->tag;
  std::vector<tagint> mine;    // old ID, new ID
  int seen[2] = {0, 0};        // atoms that were here, and those that are new or have another ID
  for (int i = 0; i < atom->nlocal; i++) {
    const tagint old = store.owner(i);
    seen[old != tag[i]] = 1;
    if (old == 0) continue;
    seen[0] = 1;
    mine.push_back(old);
    mine.push_back(tag[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, seen, 2, MPI_INT, MPI_MAX, world);
  if (!seen[0] || !seen[1]) return;

  const int n = static_cast<int>(mine.size());
  std::vector<int> counts(comm->nprocs), starts(comm->nprocs, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 1; p < comm->nprocs; p++) starts[p] = starts[p - 1] + counts[p - 1];
  std::vector<tagint> all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), n, MPI_LMP_TAGINT, all.data(), counts.data(), starts.data(),
                 MPI_LMP_TAGINT, world);
  std::unordered_map<tagint, tagint> new_id;
  for (size_t k = 0; k < all.size(); k += 2) new_id[all[k]] = all[k + 1];
  for (int i = 0; i < atom->nlocal; i++)
    if (store.owner(i) != 0) store.renumber(i, tag[i], new_id);
}

/* ----------------------------------------------------------------------
   what ghosts hold goes to their owners, a contact a ghost and round: messages of fixed size, which
   tiled decompositions need; a ghost that passes on another rank's contacts has more rounds to go
------------------------------------------------------------------------- */

template <class Records> void FixContactHistory::send_to_owners(Records &records)
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  sending = std::is_same_v<Records, PartnerRecords<apf::BridgeMemory>> ? Sent::BRIDGES
                                                                       : Sent::CONTACTS;
  sent.assign(nall, 0);
  while (true) {
    int left = 0;
    for (int i = nlocal; i < nall; i++) left = MAX(left, records.count(i) - sent[i]);
    MPI_Allreduce(MPI_IN_PLACE, &left, 1, MPI_INT, MPI_MAX, world);
    if (left == 0) return;
    comm->reverse_comm(this);
  }
}

int FixContactHistory::pack_reverse_comm(int n, int first, double *buf)
{
  if (carried) {
    std::copy_n(carried->data() + columns * first, columns * n, buf);
    return columns * n;
  }
  auto pack = [&](const auto &records) {
    for (int k = 0; k < n; k++, buf += comm_reverse) {
      const int i = first + k;
      const bool some = sent[i] < records.count(i);
      buf[0] = some;
      if (some) records.pack_record(i, sent[i]++, buf + 1);
    }
  };
  if (sending == Sent::CONTACTS)
    pack(store.contacts);
  else
    pack(store.bridges);
  return n * comm_reverse;
}

void FixContactHistory::unpack_reverse_comm(int n, int *list, double *buf)
{
  if (carried) {
    for (int k = 0; k < n; k++)
      for (int c = 0; c < columns; c++) (*carried)[columns * list[k] + c] += *buf++;
    return;
  }
  for (int k = 0; k < n; k++, buf += comm_reverse) {
    if (buf[0] == 0.0) continue;
    if (sending == Sent::CONTACTS)
      store.contacts.unpack_record(list[k], buf + 1);
    else
      store.bridges.unpack_record(list[k], buf + 1);
  }
}
