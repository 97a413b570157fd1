// LAMMPS with the plugin loaded, for tests: commands in, numbers and error texts out.

#ifndef APF_TEST_SIMULATION_H
#define APF_TEST_SIMULATION_H

#define LAMMPS_LIB_MPI    // lammps_open with a communicator

#include "atom.h"
#include "exceptions.h"
#include "input.h"
#include "lammps.h"
#include "library.h"
#include "modify.h"
#include "update.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

// Whatever a test gets from LAMMPS passes here, since the comparisons of std::max are false for
// what is no number, and pass over it.
inline void expect_finite(const double *numbers, size_t count, const std::string &name)
{
  const auto *bad = std::find_if_not(numbers, numbers + count, [](double x) {
    return std::isfinite(x);
  });
  if (bad != numbers + count) ADD_FAILURE() << name << ", number " << bad - numbers << ": " << *bad;
}

class Simulation {
 public:
  // extra: further command-line words, for example {"-var", "x", "1"}
  explicit Simulation(const std::vector<std::string> &extra = {}, MPI_Comm ranks = MPI_COMM_WORLD)
  {
    std::vector<std::string> words = {"lmp", "-log", "none", "-screen", "none", "-nocite"};
    words.insert(words.end(), extra.begin(), extra.end());
    std::vector<char *> argv;
    argv.reserve(words.size() + 1);
    for (auto &word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    handle = lammps_open(static_cast<int>(words.size()), argv.data(), ranks, nullptr);
  }
  ~Simulation()
  {
    if (handle) lammps_close(handle);
  }
  Simulation(const Simulation &) = delete;
  Simulation &operator=(const Simulation &) = delete;

  LAMMPS_NS::LAMMPS *lammps() const { return static_cast<LAMMPS_NS::LAMMPS *>(handle); }

  // Runs commands, one per line; an error of LAMMPS is thrown as std::runtime_error with its text.
  void run(const std::string &commands)
  {
    const std::string text = error_of(commands);
    if (!text.empty()) throw std::runtime_error(text);
  }

  // The error that the commands raise; empty if there is none.
  std::string error_of(const std::string &commands)
  {
    std::istringstream lines(commands);
    std::string line, word;
    while (std::getline(lines, line)) {
      while (!line.empty() && line.back() == '&' && std::getline(lines, word)) {
        line.back() = ' ';
        line += word;
      }
      try {
        lammps()->input->one(line);
      } catch (LAMMPS_NS::LAMMPSAbortException &error) {
        // of this rank alone: the others would wait for it forever
        int ranks;
        MPI_Comm_size(lammps()->world, &ranks);
        if (ranks == 1) return error.what();
        std::cerr << error.what() << " at " << line << std::endl;
        MPI_Abort(MPI_COMM_WORLD, 1);
      } catch (LAMMPS_NS::LAMMPSException &error) {
        return error.what();
      }
    }
    return {};
  }

  // an equal-style expression, as in "c_1[2] + vx[1]"; needs a run before for computes
  double value(const std::string &expression)
  {
    run("variable __value delete");
    run("variable __value equal " + expression);
    const auto *result = static_cast<double *>(lammps_extract_variable(handle, "__value", nullptr));
    const double number = *result;
    lammps_free(const_cast<double *>(result));
    expect_finite(&number, 1, expression);
    return number;
  }

 private:
  void *handle = nullptr;
};

#endif
