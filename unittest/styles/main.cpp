#include "gtest/gtest.h"

#include <mpi.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

// A temporary folder of this run's own, the same for all ranks and whatever they start: no other
// run of the tests, in this checkout or another, writes there. It goes at the end with all that
// failed tests left.
class RunFolder {
 public:
  explicit RunFolder(int me) : owner(me == 0)
  {
    std::array<char, 4096> name{};
    const auto pattern =
        (std::filesystem::temp_directory_path() / ("apf-test-" + std::string(6, 'X'))).string();
    pattern.copy(name.data(), name.size() - 1);
    if (owner && !mkdtemp(name.data())) MPI_Abort(MPI_COMM_WORLD, 1);
    MPI_Bcast(name.data(), static_cast<int>(name.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
    path = name.data();
    setenv("TMPDIR", path.c_str(), 1);
  }
  ~RunFolder()
  {
    if (owner) std::filesystem::remove_all(path);
  }
  RunFolder(const RunFolder &) = delete;
  RunFolder &operator=(const RunFolder &) = delete;

 private:
  bool owner;
  std::string path;
};

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int me;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  if (me != 0) {    // one voice; failures of other ranks still count through the exit code
    auto &listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  int failed;
  {
    const RunFolder folder(me);
    failed = RUN_ALL_TESTS();
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  }
  MPI_Finalize();
  return failed;
}
