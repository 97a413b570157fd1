// Aggregates: particles connected by contacts that are closed now, and what they measure.

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(aggregate/contact,ComputeAggregateContact);
// clang-format on
#else

#ifndef LMP_COMPUTE_AGGREGATE_CONTACT_H
#define LMP_COMPUTE_AGGREGATE_CONTACT_H

#include "compute.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace LAMMPS_NS {

class ComputeAggregateContact : public Compute {
 public:
  ComputeAggregateContact(class LAMMPS *, int, char **);
  ~ComputeAggregateContact() override;
  void init() override;
  void setup() override { contacts_are_old = false; }
  void compute_peratom() override;
  void compute_vector() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

  // Bits of each atom of this rank become those of all atoms of its aggregate together. Called by
  // all ranks.
  void spread(std::vector<std::uint64_t> &bits);

  // aggregates of all particles, for a fix; nullptr if the pair style keeps no contacts
  static std::unique_ptr<ComputeAggregateContact> of_all(class LAMMPS *, class Pair *);

 private:
  struct Contact {
    int i, j;    // owned or ghost atoms
    int root;    // the atom that stands for all that are connected with i and j on this rank
  };
  struct Part {             // what one rank holds of an aggregate; after the count: all of it
    tagint id;              // smallest atom ID of the aggregate
    bigint size;            // particles
    std::uint64_t marks;    // bits of all of them
    int rank;               // where the part came from
    int position;           // and its number there
  };
  struct Totals {
    bigint particles, aggregates;              // of aggregates of at least two particles
    bigint wall_particles, wall_aggregates;    // of those that touch a wall
  };
  bool contacts_are_old = false;    // from the start of a run's setup to its first forces

  int nmax;                            // rows of array_atom
  std::vector<Contact> contacts;       // closed contacts and bridges between particles of the group
  std::vector<tagint> label;           // owned and ghost atoms: smallest ID found so far in the
                                       // aggregate of the atom, 0 outside the group
  std::vector<int> n_pair_contacts;    // owned and ghost atoms
  std::vector<int> n_wall_contacts;    // owned atoms
  std::vector<int> n_bridges;          // owned and ghost atoms, also to walls
  std::vector<double> liquid;          // owned and ghost atoms: on them and their share in bridges
  Totals totals;
  enum { LABEL, CONTACTS } reverse;    // what reverse_comm brings to the owner of an atom

  // in compute_aggregate_contact_gather.cpp
  static bool keeps_contacts(class Pair *);
  bool atoms_have_changed() const;
  void gather_contacts();
  void gather_wall_contacts();

  void find_aggregates();
  void require_contacts();    // an error without a pair style that keeps them
  void start_labels();
  void connect_contacts();
  void spread_labels();
  void measure_aggregates();
  std::vector<Part> gather_parts(const std::vector<std::uint64_t> &marks,
                                 std::vector<int> &part_of);
  void write_rows(const std::vector<Part> &, const std::vector<int> &);
  static int add_parts(int, char *, int &, int *&, char *&, void *);
};

}    // namespace LAMMPS_NS

#endif
#endif
