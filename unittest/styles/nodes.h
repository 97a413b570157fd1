// Several nodes on one machine: while `ranks_of_a_node` is not 0, as many ranks as that share a
// memory for all that ask MPI_Comm_split_type, which this program puts in front of MPI's own.

#ifndef APF_TEST_NODES_H
#define APF_TEST_NODES_H

inline int ranks_of_a_node = 0;

class SmallNodes {
 public:
  explicit SmallNodes(int ranks) { ranks_of_a_node = ranks; }
  ~SmallNodes() { ranks_of_a_node = 0; }
  SmallNodes(const SmallNodes &) = delete;
  SmallNodes &operator=(const SmallNodes &) = delete;
};

#endif
