#ifdef PAIR_CLASS
// clang-format off
PairStyle(granular/adhesive,PairGranularAdhesive);
// clang-format on
#else

#ifndef LMP_PAIR_GRANULAR_ADHESIVE_H
#define LMP_PAIR_GRANULAR_ADHESIVE_H

#include "pair.h"

#include "contact/candidates.h"
#include "contact/contact_kernel.h"
#include "contact_keywords.h"
#include "type_sizes.h"

#include <unordered_map>

namespace LAMMPS_NS {

class PairGranularAdhesive : public Pair {
 public:
  PairGranularAdhesive(class LAMMPS *);
  ~PairGranularAdhesive() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  void setup() override;
  double init_one(int, int) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void *extract(const char *, int &) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  // for the fix that keeps histories
  const apf::ContactList &closed_contacts() const { return contacts; }
  double longest_neck() const { return neck_max; }
  bool planar() const { return choice.planar; }
  void list_was_built() { rebuild = true; }
  apf::StiffestMode stiffest_possible() const;    // of any two particles

  // sub-steps of a particle step, see FixContacts
  void find_fastest(apf::LookAhead &);
  void find_approaching(apf::LookAhead &);
  bool find_near(apf::LookAhead &ahead) { return candidates.find_near(ahead); }
  void find_stiffest(apf::Stiffest &);
  void sub_step(const apf::ContactTimes &);

 private:
  void parse_types(const char *word, int iarg, int &lo, int &hi) const;
  apf::Candidates candidates;    // pairs of the neighbour list
  apf::ContactList contacts;
  apf::ContactKinds kinds;
  apf::KernelChoice choice;
  apf::ContactKernel kernel = nullptr;
  std::vector<std::vector<ContactCoeff>> coefficients;    // [1..ntypes][1..ntypes]

  class FixContactHistory *store = nullptr;    // histories between rebuilds, velocities
  std::string id_store;
  bool rebuild = true;      // neighbour list is newer than candidates
  double neck_max = 0.0;    // longest neck of any pair of types
  int freeze_group_bit = 0;
  class Fix *rigid = nullptr;
  std::vector<double> mass_rigid;    // of the body an atom belongs to, 0 if none
  TypeSizes sizes;

  // parts of all contacts at one timestep, for single()
  std::vector<apf::ContactParts> parts;
  std::unordered_map<uint64_t, int> index_of_pair;
  bigint parts_step = -1;

  void allocate();
  void find_rigid_masses();
  void build_candidates();
  void detect(bool all, double step);
  void close(int candidate, const apf::ContactHistory &);
  apf::ContactBodies bodies_of(int i, int j, double zi, double zj) const;
  const apf::ContactKind &kind_of(int i, int j);
  void share_masses();
  void correct_ends(double step);
  void remove_ended(bool in_sub_step);
  void tally(int eflag);
  void evaluate_parts();
};

}    // namespace LAMMPS_NS

#endif
#endif
