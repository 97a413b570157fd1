// Numbers that all ranks of a node read: one copy in its memory, written by the lowest rank there.
// They begin where a cache line does, and lie in large pages where the system gives such on demand.

#ifndef LMP_NODE_MEMORY_H
#define LMP_NODE_MEMORY_H

#include <mpi.h>

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace LAMMPS_NS {

class NodeMemory {
 public:
  explicit NodeMemory(MPI_Comm world);
  ~NodeMemory();
  NodeMemory(const NodeMemory &) = delete;
  NodeMemory &operator=(const NodeMemory &) = delete;

  // These are called by all ranks.
  bool allocate(std::size_t count);    // gives the old numbers up; false if there is no memory
  void synchronize() const;            // what was read and written before is done after

  bool writer() const { return me == 0; }
  int ranks() const { return nprocs; }    // of this node
  double *data() const { return numbers; }
  std::size_t bytes() const { return writer() ? size * sizeof(double) : 0; }

 private:
  int me = 0, nprocs = 1;
  std::size_t size = 0;
  double *numbers = nullptr;
  struct Free {
    void operator()(void *from) const { std::free(from); }
  };
  std::unique_ptr<void, Free> own;    // where the node has one rank only
#ifndef MPI_STUBS
  MPI_Comm node;
  MPI_Win window = MPI_WIN_NULL;
#endif

  bool share(std::size_t count);
  void release();
};

}    // namespace LAMMPS_NS

#endif
