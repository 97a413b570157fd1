#include "node_memory.h"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

using namespace LAMMPS_NS;

static constexpr std::size_t line = 64;    // bytes of a cache line

// Memory of at least one large page lies in such pages. Particles take numbers from everywhere in a
// grid, and the processor remembers where few pages are: on a grid of 128^3 nodes the flow at a
// particle took 1.3 to 1.4 times as long in small ones.
static void *in_large_pages(std::size_t bytes)
{
  constexpr std::size_t page = std::size_t(2) << 20;
  if (bytes > SIZE_MAX - page) return nullptr;
  const std::size_t unit = bytes < page ? line : page, whole = (bytes + unit - 1) / unit * unit;
  void *memory = std::aligned_alloc(unit, whole);
#ifdef MADV_HUGEPAGE
  if (memory && unit == page) madvise(memory, whole, MADV_HUGEPAGE);    // a wish
#endif
  return memory;
}

#ifdef MPI_STUBS

NodeMemory::NodeMemory(MPI_Comm) {}
NodeMemory::~NodeMemory() {}
void NodeMemory::synchronize() const {}
void NodeMemory::release() {}
bool NodeMemory::share(std::size_t)
{
  return false;
}

#else

static constexpr std::size_t spare = line / sizeof(double);    // numbers that aligning may cost

static double *aligned(void *from)
{
  std::size_t space = 2 * line;
  return static_cast<double *>(std::align(line, line, from, space));
}

NodeMemory::NodeMemory(MPI_Comm world)
{
  MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  MPI_Comm_set_errhandler(node, MPI_ERRORS_RETURN);
  MPI_Comm_rank(node, &me);
  MPI_Comm_size(node, &nprocs);
}

NodeMemory::~NodeMemory()
{
  release();
  MPI_Comm_free(&node);
}

void NodeMemory::release()
{
  if (window == MPI_WIN_NULL) return;
  MPI_Win_unlock_all(window);
  MPI_Win_free(&window);
}

void NodeMemory::synchronize() const
{
  if (window == MPI_WIN_NULL) return;
  MPI_Win_sync(window);
  MPI_Barrier(node);
  MPI_Win_sync(window);
}

bool NodeMemory::share(std::size_t count)
{
  const MPI_Aint bytes = me == 0 ? (count + spare) * sizeof(double) : 0;
  void *base;
  int disp_unit;
  MPI_Aint length;
  if (MPI_Win_allocate_shared(bytes, sizeof(double), MPI_INFO_NULL, node, &base, &window) !=
      MPI_SUCCESS) {
    window = MPI_WIN_NULL;
    return false;
  }
  MPI_Win_shared_query(window, 0, &length, &disp_unit, &base);
  MPI_Win_lock_all(MPI_MODE_NOCHECK, window);
  numbers = aligned(base);    // pages begin at the same lines for all ranks
  return true;
}

#endif

/* ---------------------------------------------------------------------- */

bool NodeMemory::allocate(std::size_t count)
{
  release();
  own.reset();
  numbers = nullptr;
  size = count;
  if (nprocs > 1) return share(count);
  if (count > SIZE_MAX / sizeof(double)) return false;
  own.reset(in_large_pages(count * sizeof(double)));
  numbers = static_cast<double *>(own.get());
  return numbers || count == 0;
}
