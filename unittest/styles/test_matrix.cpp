// Every style that has a state, against everything that must not matter to it: restart in the midst
// of contacts, ranks, tiles that are balanced, periodic wrap, sorting, runs that are cut. One table
// of styles, one of perturbations; tools/cases --matrix prints what was measured.

#include "criterion.h"
#include "matrix_rows.h"

#include <array>

namespace {

using namespace matrix;

// ---------------------------------------------------------------------------------------------
// what is compared

struct Snapshot {
  std::map<int, std::array<double, 15>> atoms;    // by ID: x, v, omega, f, torque
  std::vector<std::vector<double>> outputs;
};

Snapshot snapshot(Simulation &sim, const Row &row)
{
  const auto *atom = sim.lammps()->atom;
  std::vector<double> mine, all;
  for (int i = 0; i < atom->nlocal; i++) {
    mine.push_back(atom->tag[i]);
    for (double **array : {atom->x, atom->v, atom->omega, atom->f, atom->torque})
      mine.insert(mine.end(), array[i], array[i] + 3);
  }
  const MPI_Comm world = sim.lammps()->world;
  int ranks, length = static_cast<int>(mine.size());
  MPI_Comm_size(world, &ranks);
  std::vector<int> lengths(ranks), starts(ranks, 0);
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, world);
  for (int r = 1; r < ranks; r++) starts[r] = starts[r - 1] + lengths[r - 1];
  all.resize(starts.back() + lengths.back());
  MPI_Allgatherv(mine.data(), length, MPI_DOUBLE, all.data(), lengths.data(), starts.data(),
                 MPI_DOUBLE, world);
  expect_finite(all.data(), all.size(), "particles");
  Snapshot result;
  for (size_t n = 0; n < all.size(); n += 16)
    std::copy_n(all.data() + n + 1, 15, result.atoms[static_cast<int>(all[n])].data());
  for (const auto &group : row.outputs) {
    result.outputs.emplace_back();
    for (const auto &name : group) result.outputs.back().push_back(sim.value(name));
  }
  return result;
}

// largest difference of a vector or an output over its largest value; 1 if particles differ
double deviation(const Snapshot &a, const Snapshot &b, const double *shift)
{
  if (a.atoms.size() != b.atoms.size()) return 1.0;
  double most = 0.0;
  for (int kind = 0; kind < 5; kind++) {
    double size = kind == 0 ? 8.0 : 0.0, differ = 0.0;
    for (const auto &[tag, one] : b.atoms) {
      const auto other = a.atoms.find(tag);
      if (other == a.atoms.end()) return 1.0;
      for (int c = 0; c < 3; c++) {
        double d = other->second[3 * kind + c] - one[3 * kind + c];
        if (kind == 0) {
          d -= shift[c];
          d -= 8.0 * std::round(d / 8.0);
        }
        differ = std::max(differ, std::fabs(d));
        size = std::max(size, std::fabs(one[3 * kind + c]));
      }
    }
    if (differ > 0.0) most = std::max(most, differ / size);
  }
  for (size_t g = 0; g < a.outputs.size(); g++)
    if (!b.outputs[g].empty()) most = std::max(most, difference(a.outputs[g], b.outputs[g]));
  return most;
}

// ---------------------------------------------------------------------------------------------
// the perturbations

// A difference in the first step is rounding; what follows makes it grow: it changes overlaps, of
// some 1e-2 of a particle, and moments of touch.
struct Limits {
  double first, all;
};

struct Perturbation {
  enum Kind { WHOLE, CUT, PRE_NO, RESTART, FEWER, MORE, DATA };

  std::string name, more;    // commands before the run
  Kind kind;
  Limits limits;
  bool shifted = false;

  bool cut() const { return kind != WHOLE; }
  bool begins() const { return cut() && kind != CUT && kind != PRE_NO; }    // from a file
  // a restart file of all ranks that one of them reads, and of one that all read
  bool on_others() const { return kind == FEWER || kind == MORE; }
};

const Limits order = {1e-13 * unoptimised, 1e-11 * unoptimised},
             cut = {1e-14, 1e-12};    // another order of sums
const Perturbation whole = {"", "", Perturbation::WHOLE, {}};
const Perturbation two_runs = {"two runs", "", Perturbation::CUT, cut};

std::vector<Perturbation> perturbations(const Row &row)
{
  return {{"ranks", "", Perturbation::WHOLE, order},
          {"restart in contact", "", Perturbation::RESTART, cut},
          {"... on fewer ranks", "", Perturbation::FEWER, order},
          {"... on more ranks", "", Perturbation::MORE, order},
          {"write_data, read_data", "", Perturbation::DATA, cut},
          {"balance shift", "fix even all balance 7 1.0 shift " + row.axes + " 5 1.1\n",
           Perturbation::WHOLE, order},
          {"balance rcb, tiled",
           "comm_style tiled\ncomm_modify vel yes\nfix even all balance 7 1.0 rcb\n",
           Perturbation::WHOLE, order},
          // coordinates are rounded at other places
          {"periodic wrap", "", Perturbation::WHOLE, {1e-12, 1e-10}, true},
          {"sort, lists at every step",
           "atom_modify sort 7 1.0\nneigh_modify delay 0 every 1 check no\n", Perturbation::WHOLE,
           order},
          two_runs,
          {"run pre no", "", Perturbation::PRE_NO, cut}};
}

// Steps before and after the place where a run may be cut, and parts into which each is divided.
struct Course {
  int before, after, finer = 1;
};

// Reads what another run wrote, and defines again what files do not have.
void read_again(Simulation &sim, const Row &row, const Perturbation &how, const Course &course,
                const std::string &file, const std::string &again)
{
  const bool data = how.kind == Perturbation::DATA;
  sim.run("atom_modify sort 0 0");
  if (data)
    sim.run("newton on\nunits lj\natom_style sphere\natom_modify map array\n"
            "comm_modify vel yes\nboundary p p p\nread_data " +
            file + "\nreset_timestep " + std::to_string(course.finer * course.before) + " time " +
            digits(course.before * inner * dt));
  else
    sim.run("read_restart " + file + "\ncomm_modify vel yes");
  sim.run((data ? row.data_pair : "") + again);
}

Snapshot outcome(const Row &row, const std::string &integrator, const Perturbation &how,
                 const Course &course, MPI_Comm ranks)
{
  std::string thermo = "thermo_style custom step pe ke";
  for (const auto &group : row.outputs)
    for (const auto &name : group)
      if (name.compare(0, 2, "c_") == 0) thermo += " " + name;
  const std::string go = row.styles + integrate(integrator) +
      (course.finer > 1 ? "timestep " + digits(inner * dt / course.finer) + "\n" : "") + thermo +
      "\nthermo_modify norm no\n";
  const auto run = [&course](int steps) {
    return "run " + std::to_string(course.finer * steps);
  };
  auto sim = std::make_unique<Simulation>(std::vector<std::string>(),
                                          how.kind == Perturbation::MORE ? MPI_COMM_SELF : ranks);
  sim->run(row.start + (how.shifted ? "displace_atoms all move " + row.shift + "\n" : "") + go +
           how.more + run(how.cut() ? course.before : course.before + course.after));
  if (how.begins()) {
    // where each rank has a run of its own each writes a file, and that of the first is read
    const std::string file = scratch_file("matrix"),
                      mine = how.kind == Perturbation::MORE
        ? file + std::to_string(TemporaryFile::rank())
        : file;
    sim->run((how.kind == Perturbation::DATA ? "write_data " + mine + " nocoeff"
                                             : "write_restart " + mine));
    if (how.on_others()) {
      sim.reset();    // one at a time
      MPI_Barrier(MPI_COMM_WORLD);
      sim = std::make_unique<Simulation>(std::vector<std::string>(),
                                         how.kind == Perturbation::FEWER ? MPI_COMM_SELF : ranks);
    } else {
      sim->run("clear");
    }
    read_again(*sim, row, how, course, how.kind == Perturbation::MORE ? file + "0" : file, go);
    MPI_Barrier(how.on_others() ? MPI_COMM_WORLD : ranks);
    if (TemporaryFile::rank() == 0 || mine != file) std::remove(mine.c_str());
  }
  if (how.cut()) sim->run(run(course.after) + (how.kind == Perturbation::PRE_NO ? " pre no" : ""));
  return snapshot(*sim, row);
}

void record(const Row &row, const Perturbation &how, const std::string &text)
{
  testing::Test::RecordProperty("matrix|" + row.full_name() + "|" + how.name, text);
}

// One style under one integrator.
class Trial {
 public:
  const Row &row;
  const std::string &integrator;

  Trial(const Row &of, const std::string &by) : row(of), integrator(by) {}

  // What a perturbation is measured against: the run on one rank; where it is cut, that on as many
  // ranks, if all of it is on these. If forces are taken anew where a run begins, a restart is
  // compared to two runs.
  double deviation_of(const Perturbation &how, const Course &course)
  {
    const auto &plain = row.begin > 0.0 && how.begins() ? two_runs : whole;
    double shift[3] = {};
    if (how.shifted) std::istringstream(row.shift) >> shift[0] >> shift[1] >> shift[2];
    return deviation(
        outcome(row, integrator, how, course, MPI_COMM_WORLD),
        twin(plain, course, how.cut() && !how.on_others() ? MPI_COMM_WORLD : MPI_COMM_SELF), shift);
  }

  void expect_motion()
  {
    double f = 0.0, v = 0.0;
    for (const auto &[tag, one] : twin(whole, {row.half, row.half}, MPI_COMM_SELF).atoms) {
      f = std::max(f, std::fabs(one[9]) + std::fabs(one[10]) + std::fabs(one[11]));
      v = std::max(v, std::fabs(one[3]) + std::fabs(one[4]) + std::fabs(one[5]));
    }
    EXPECT_GT(f, row.empty ? -1.0 : 1e-3) << integrator;
    EXPECT_GT(v, 10.0) << integrator;
  }

  // What a cut changes is an error of the time step, of second order, and nothing that is
  // forgotten. Brownian kicks are the larger the shorter the step: less is gained.
  void expect_error_of_the_step(double coarse)
  {
    const double gain = coarse / deviation_of(two_runs, {row.half, row.half, 2});
    EXPECT_NEAR(gain, row.random ? 2.5 : 4.0, row.random ? 0.8 : 0.7) << integrator;
  }

 private:
  std::map<std::array<int, 5>, Snapshot> twins;

  const Snapshot &twin(const Perturbation &how, const Course &course, MPI_Comm ranks)
  {
    const std::array<int, 5> key = {how.kind, course.before, course.after, course.finer,
                                    ranks == MPI_COMM_SELF};
    if (!twins.count(key)) twins[key] = outcome(row, integrator, how, course, ranks);
    return twins[key];
  }
};

void try_out(std::vector<Trial> &trials, const Perturbation &how)
{
  const Row &row = trials[0].row;
  const std::string &none = how.shifted ? row.no_shift : row.no_data;
  if ((how.shifted || how.kind == Perturbation::DATA) && !none.empty())
    return record(row, how, none);
  const bool anew = row.begin > 0.0 && how.kind == Perturbation::CUT;
  const Limits limits = anew ? Limits{row.begin, row.begin} : how.limits;
  Limits most = {};
  for (auto &trial : trials) {
    // LAMMPS refuses it
    if (how.kind == Perturbation::PRE_NO && trial.integrator == "respa") continue;
    const double first = trial.deviation_of(
                     how, {how.cut() ? std::max(row.half, row.empty) : row.empty, 1}),
                 all = trial.deviation_of(how, {row.half, row.half});
    EXPECT_LE(first, limits.first) << trial.integrator << ", " << how.name << ", first step";
    EXPECT_LE(all, limits.all) << trial.integrator << ", " << how.name;
    if (anew && !row.enters) trial.expect_error_of_the_step(all);
    most = {std::max(most.first, first), std::max(most.all, all)};
  }
  char text[64];
  snprintf(text, sizeof(text), "%.1e %.1e|%.0e, %.0e%s", most.first, most.all, limits.first,
           limits.all, row.begin > 0.0 && how.begins() ? ", to two runs" : "");
  record(row, how, text);
}

TEST(RanksMatrix, what_does_not_matter_changes_nothing)
{
  const Files files;
  for (const auto &row : table(files)) {
    SCOPED_TRACE(row.name);
    std::vector<Trial> trials;
    for (const auto &integrator : row.integrators) trials.emplace_back(row, integrator);
    for (auto &trial : trials) trial.expect_motion();
    for (const auto &how : perturbations(row)) try_out(trials, how);
  }
}

}    // namespace
