#include "nodes.h"

#include <mpi.h>

// MPI's profiling interface: the plugin finds this one first, MPI's own is PMPI_...
extern "C" int MPI_Comm_split_type(MPI_Comm comm, int type, int key, MPI_Info info, MPI_Comm *node)
{
  if (ranks_of_a_node == 0) return PMPI_Comm_split_type(comm, type, key, info, node);
  int me;
  MPI_Comm_rank(comm, &me);
  return MPI_Comm_split(comm, me / ranks_of_a_node, key, node);
}
