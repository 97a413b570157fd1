// A file in the temporary folder, the same on all ranks, removed at the end.

#ifndef APF_TEST_TEMPORARY_FILE_H
#define APF_TEST_TEMPORARY_FILE_H

#include "vtkhdf_writer.h"

#include <mpi.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string &name, const std::string &extension = ".vtkhdf")
  {
    int id = static_cast<int>(getpid());
    MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
    path =
        (std::filesystem::temp_directory_path() / (name + std::to_string(id) + extension)).string();
  }
  ~TemporaryFile()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank() == 0) std::filesystem::remove(path);
  }
  // written by one rank
  void write(VtkhdfWriter::Counts n, VtkhdfWriter::Triple origin, VtkhdfWriter::Triple spacing,
             const std::function<void(VtkhdfWriter &)> &content) const
  {
    if (rank() == 0) {
      VtkhdfWriter writer(path, n, origin, spacing);
      content(writer);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  static int rank()
  {
    int me;
    MPI_Comm_rank(MPI_COMM_WORLD, &me);
    return me;
  }

  std::string path;
};

#endif
