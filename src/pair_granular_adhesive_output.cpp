// What pair style granular/adhesive tells of its contacts and bridges.

#include "pair_granular_adhesive.h"

#include "atom.h"
#include "fix_contact_history.h"
#include "force.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   energy, virial and stress of all contacts and bridges from their parts
------------------------------------------------------------------------- */

void PairGranularAdhesive::Tally::read(int k, const apf::ContactParts &p)
{
  pair.tally_pair(pair.contacts.i[k], pair.contacts.j[k], eflag, p.force, 0,
                  {p.elastic_energy, p.sliding_energy, p.rolling_energy, p.twisting_energy});
}

void PairGranularAdhesive::tally_bridges(int eflag)
{
  const auto &all = bridges.all();
  for (int k = 0; k < all.size(); k++) {
    const auto &p = bridges.parts[k];
    tally_pair(all.i[k], all.j[k], eflag, p.force, bridge_energy, {p.energy});
  }
}

// energies: go to pvector from number `first` on
void PairGranularAdhesive::tally_pair(int i, int j, int eflag, const double (&f)[3], int first,
                                      std::initializer_list<double> energies)
{
  // with newton off both ranks of a pair count it, each half
  const double share = (force->newton_pair || j < atom->nlocal) ? 1.0 : 0.5;
  double energy = 0.0;
  for (const double part : energies) {
    pvector[first++] += share * part;
    energy += part;
  }
  const double *const *x = atom->x;
  ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, eflag ? energy : 0.0, 0.0, f[0], f[1], f[2],
               x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]);
}

/* ----------------------------------------------------------------------
   parts of all contacts as they are now
------------------------------------------------------------------------- */

void PairGranularAdhesive::evaluate_parts()
{
  if (parts_step == update->ntimestep) return;
  parts_step = update->ntimestep;
  parts.of.resize(contacts.size());
  auto bodies = store->bodies();    // a copy: loads stay as they are
  kernel(contacts, bodies, store->last_times(), &parts);
  index_of_pair.number(contacts);
  if (wet) bridges.evaluate(store->last_times());
}

double PairGranularAdhesive::single(int i, int j, int, int, double rsq, double, double,
                                    double &fforce)
{
  evaluate_parts();
  fforce = 0.0;
  std::fill(svector, svector + n_parts, 0.0);
  return single_contact(i, j, rsq, fforce) + (wet ? single_bridge(i, j, rsq, fforce) : 0.0);
}

double PairGranularAdhesive::single_contact(int i, int j, double rsq, double &fforce)
{
  const auto [index, sign] = index_of_pair.find(i, j);    // tangential parts: on the first atom
  if (index < 0) return 0.0;

  const auto &p = parts.of[index];
  fforce += (p.elastic + p.damping) / sqrt(rsq);
  double *out = svector;
  *out++ = p.overlap;
  *out++ = p.contact_radius;
  *out++ = p.elastic;
  *out++ = p.damping;
  for (double component : p.sliding) *out++ = sign * component;
  for (double component : p.rolling) *out++ = sign * component;
  *out++ = p.twisting;
  return p.energy();
}

double PairGranularAdhesive::single_bridge(int i, int j, double rsq, double &fforce)
{
  const auto [index, sign] = bridges.find(i, j);
  if (index < 0) return 0.0;
  const auto &p = bridges.parts[index];
  fforce += (p.viscous - p.capillary) / sqrt(rsq);
  double *out = svector + n_contact_parts;
  *out++ = p.capillary;
  *out++ = p.viscous;
  for (double component : p.tangential) *out++ = sign * component;
  *out++ = bridges.all().memory(index).volume();
  return p.energy;
}

/* ---------------------------------------------------------------------- */

void *PairGranularAdhesive::extract(const char *name, int &dim)
{
  dim = 0;
  if (strcmp(name, "contact_list") == 0) return &contacts;
  if (strcmp(name, "bridge_list") == 0)
    return wet ? const_cast<apf::BridgeList *>(&bridges.all()) : nullptr;
  if (strcmp(name, "liquid") == 0) {
    if (!store || !store->keeps_liquid()) return nullptr;
    store->settle_liquid();    // all ranks ask for it
    return store->all_liquid();
  }
  return nullptr;
}

/* ---------------------------------------------------------------------- */

double PairGranularAdhesive::memory_usage()
{
  return Pair::memory_usage() + bridges.memory_usage() + contacts.memory_usage() +
      tiles.memory_usage() + candidates.memory_usage() +
      parts.of.capacity() * sizeof(apf::ContactParts);
}
