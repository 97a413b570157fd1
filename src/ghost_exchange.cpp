#include "ghost_exchange.h"

#include "box_images.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {

constexpr int tag_rows = 1, tag_forward = 2, tag_reverse = 3;

template <class Row> constexpr int motion_size = 2 * Row::dim + Row::spin_dim;
template <class Row> constexpr int load_size = Row::dim + Row::spin_dim;

template <class Row> double *pack_motion(const Row &row, double *buf)
{
  for (const double c : row.x) *buf++ = c;
  for (const double c : row.v) *buf++ = c;
  for (const double c : row.omega) *buf++ = c;
  return buf;
}

}    // namespace

/* ---------------------------------------------------------------------- */

GhostExchange::GhostExchange(MPI_Comm world) : world(world)
{
  MPI_Comm_rank(world, &me);
  MPI_Comm_size(world, &nprocs);
  self.rank = me;
}

/* ---------------------------------------------------------------------- */

void GhostExchange::set_owners(int nlocal, std::vector<int> rank, std::vector<int> index)
{
  first = nlocal;
  owner_rank = std::move(rank);
  owner_row = std::move(index);
  partners.clear();
  partner_of_rank.assign(nprocs, -1);
  if (nprocs == 1) return;

  std::vector<char> has_ghosts(nprocs, 0), has_mine(nprocs);
  for (const int r : owner_rank) has_ghosts[r] = 1;
  MPI_Alltoall(has_ghosts.data(), 1, MPI_CHAR, has_mine.data(), 1, MPI_CHAR, world);
  for (int r = 0; r < nprocs; r++) {
    if (r == me || !(has_ghosts[r] || has_mine[r])) continue;
    partner_of_rank[r] = static_cast<int>(partners.size());
    partners.emplace_back();
    partners.back().rank = r;
  }
}

/* ---------------------------------------------------------------------- */

void GhostExchange::choose(const std::vector<char> &used, const Domain *domain, double lag,
                           const apf::Bodies &bodies, std::vector<char> &wanted)
{
  chosen.clear();
  self.images.clear(), self.sent.clear();
  for (auto &p : partners) p.images.clear(), p.sent.clear();
  std::vector<std::vector<int>> asked(partners.size());
  const int nghost = static_cast<int>(owner_rank.size());
  for (int g = 0; g < nghost; g++) {
    if (!used[first + g]) continue;
    chosen.push_back(first + g);
    const int r = owner_rank[g];
    partner(r).images.push_back({first + g, {}, {}, {}});
    if (r == me)
      self.sent.push_back(owner_row[g]);
    else
      asked[partner_of_rank[r]].push_back(owner_row[g]);
  }

  requests.resize(partners.size());
  for (size_t p = 0; p < partners.size(); p++)
    MPI_Isend(asked[p].data(), static_cast<int>(asked[p].size()), MPI_INT, partners[p].rank,
              tag_rows, world, &requests[p]);
  for (auto &p : partners) {
    MPI_Status status;
    int n;
    MPI_Probe(p.rank, tag_rows, world, &status);
    MPI_Get_count(&status, MPI_INT, &n);
    p.sent.resize(n);
    MPI_Recv(p.sent.data(), n, MPI_INT, p.rank, tag_rows, world, MPI_STATUS_IGNORE);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);

  for (const int i : self.sent) wanted[i] = 1;
  for (const auto &p : partners)
    for (const int i : p.sent) wanted[i] = 1;

  // where images stand relative to their owners: six numbers from each owner
  auto motion = [&](int i, double *buf) {
    double omega[3];
    bodies.position(i, buf);
    bodies.motion(i, buf + 3, omega);
  };
  auto compare = [&](Image &image, const double *owner) {
    double ghost[6], n[3], now[3], rate[3] = {};
    motion(image.ghost, ghost);
    image_number(domain, owner, ghost, n);
    sum_of_box_vectors(n, domain->h, now);
    if (domain->deform_vremap) sum_of_box_vectors(n, domain->h_rate, rate);
    for (int c = 0; c < 3; c++) {
      image.shift[c] = now[c] + lag * rate[c];
      image.to_come[c] = domain->box_change ? image.shift[c] - (ghost[c] - owner[c]) : 0.0;
      image.dv[c] = domain->deform_vremap ? ghost[3 + c] - owner[3 + c] : 0.0;
    }
  };
  for (auto &p : partners) {
    p.in.resize(6 * p.images.size());
    p.out.resize(6 * p.sent.size());
    for (size_t k = 0; k < p.sent.size(); k++) motion(p.sent[k], &p.out[6 * k]);
  }
  start(tag_rows);
  finish();
  for (auto &p : partners)
    for (size_t k = 0; k < p.images.size(); k++) compare(p.images[k], &p.in[6 * k]);
  for (size_t k = 0; k < self.images.size(); k++) {
    double owner[6];
    motion(self.sent[k], owner);
    compare(self.images[k], owner);
  }
}

void GhostExchange::pin(apf::Islands &islands) const
{
  for (const int i : chosen) islands.pin(i);
  for (const int i : self.sent) islands.pin(i);
  for (const auto &p : partners)
    for (const int i : p.sent) islands.pin(i);
}

/* ---------------------------------------------------------------------- */

void GhostExchange::start(int tag)
{
  requests.clear();
  for (auto &p : partners) {
    if (!p.in.empty()) {
      requests.emplace_back();
      MPI_Irecv(p.in.data(), static_cast<int>(p.in.size()), MPI_DOUBLE, p.rank, tag, world,
                &requests.back());
    }
    if (!p.out.empty()) {
      requests.emplace_back();
      MPI_Isend(p.out.data(), static_cast<int>(p.out.size()), MPI_DOUBLE, p.rank, tag, world,
                &requests.back());
    }
  }
}

void GhostExchange::finish()
{
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

/* ---------------------------------------------------------------------- */

template <class Row> int GhostExchange::forward(Row *rows, double left)
{
  constexpr int size = motion_size<Row>;
  for (auto &p : partners) {
    p.out.resize(size * p.sent.size());
    p.in.resize(size * p.images.size());
    double *buf = p.out.data();
    for (const int i : p.sent) buf = pack_motion(rows[i], buf);
  }
  start(tag_forward);
  auto place = [rows, left](const Image &image, const double *buf) {
    Row &row = rows[image.ghost];
    for (int c = 0; c < Row::dim; c++) row.x[c] = *buf++ + image.shift[c] - left * image.to_come[c];
    for (int c = 0; c < Row::dim; c++) row.v[c] = *buf++ + image.dv[c];
    for (double &c : row.omega) c = *buf++;
  };
  for (size_t k = 0; k < self.images.size(); k++) {
    double buf[size];
    pack_motion(rows[self.sent[k]], buf);
    place(self.images[k], buf);
  }
  finish();
  size_t placed = self.images.size();
  for (auto &p : partners) {
    for (size_t k = 0; k < p.images.size(); k++) place(p.images[k], &p.in[size * k]);
    placed += p.images.size();
  }
  return static_cast<int>(placed);
}

/* ---------------------------------------------------------------------- */

template <class Row> void GhostExchange::reverse(Row *rows)
{
  constexpr int size = load_size<Row>;
  auto take = [rows](int ghost, double *buf) {
    Row &row = rows[ghost];
    for (double &c : row.f) *buf++ = c, c = 0.0;
    for (double &c : row.torque) *buf++ = c, c = 0.0;
  };
  auto give = [rows](int i, const double *buf) {
    for (double &c : rows[i].f) c += *buf++;
    for (double &c : rows[i].torque) c += *buf++;
  };
  for (auto &p : partners) {
    p.out.resize(size * p.images.size());
    p.in.resize(size * p.sent.size());
    for (size_t k = 0; k < p.images.size(); k++) take(p.images[k].ghost, &p.out[size * k]);
  }
  start(tag_reverse);
  for (size_t k = 0; k < self.images.size(); k++) {
    double buf[size];
    take(self.images[k].ghost, buf);
    give(self.sent[k], buf);
  }
  finish();
  for (auto &p : partners)
    for (size_t k = 0; k < p.sent.size(); k++) give(p.sent[k], &p.in[size * k]);
}

namespace LAMMPS_NS {
template int GhostExchange::forward(apf::PlaneRow *, double);
template int GhostExchange::forward(apf::SpaceRow *, double);
template void GhostExchange::reverse(apf::PlaneRow *);
template void GhostExchange::reverse(apf::SpaceRow *);
}    // namespace LAMMPS_NS
