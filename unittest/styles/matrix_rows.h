// The styles that have a state, each in a scene that uses it: one table for test_matrix.cpp.

#ifndef APF_TEST_MATRIX_ROWS_H
#define APF_TEST_MATRIX_ROWS_H

#include "grid_scene.h"

namespace matrix {

constexpr int inner = 8;    // collision steps in one of particles

inline const std::vector<std::string> all_integrators = {"verlet", "respa", "mts"};

struct Row {
  std::string name;
  std::string start;     // from units to particles in motion; not given again after a restart
  std::string styles;    // given again
  std::vector<std::vector<std::string>> outputs;    // each group is compared to its largest value
  std::string axes = "xyz";                         // along which ranks are balanced
  std::string shift = "4 4 4";                      // through periodic boundaries; empty: see below
  std::string no_shift, no_data = "data files have no contacts or counters";
  std::string data_pair;    // given again after read_data
  double begin = 0.0;    // what a cut changes: forces that follow velocities are taken anew there
  bool random = false;
  bool enters = false;    // particles that depend on the step: none are the same with half of it
  int empty = 0;          // steps in which some output is 0
  int half = 30;          // steps before a cut, and after it
  std::vector<std::string> integrators = all_integrators;

  // for the table: with its integrators, if they are not the three
  std::string full_name() const
  {
    if (integrators == all_integrators || integrators.size() == 1) return name;
    std::string text;
    for (const auto &one : integrators) text += (text.empty() ? " (" : ", ") + one;
    return name + text + ")";
  }
};

inline std::string box(const std::string &boundary, const std::string &z = "0 8")
{
  return "newton on\natom_modify sort 0 0\nunits lj\natom_style sphere\natom_modify map array\n"
         "comm_modify vel yes\nboundary " +
      boundary + "\nregion box block 0 8 0 8 " + z + "\ncreate_box 1 box\n";
}

struct Mover {
  double x, y, z, d, vx, vy, vz;
};
inline std::string spheres(const std::vector<Mover> &all)
{
  std::string text;
  for (const auto &s : all)
    text += "create_atoms 1 single " + digits(snap(s.x)) + " " + digits(snap(s.y)) + " " +
        digits(snap(s.z)) + "\n";
  for (size_t n = 0; n < all.size(); n++) {
    const auto &s = all[n];
    text += "set atom " + std::to_string(n + 1) + " diameter " + digits(s.d) + " density 1 vx " +
        digits(s.vx) + " vy " + digits(s.vy) + " vz " + digits(s.vz) + " omega " +
        digits(2.0 - n % 4) + " " + digits(0.5 * (n % 5)) + " 1\n";
  }
  return text;
}
inline std::vector<std::string> entries(const std::string &what, int from, int to)
{
  std::vector<std::string> all;
  for (int n = from; n <= to; n++) all.push_back(what + "[" + std::to_string(n) + "]");
  return all;
}

// an aggregate on a journey, hit by a bullet
inline const std::vector<Mover> aggregate = {
    {4.0, 4.0, 4.0, 1.0, 48.0, -32.0, 64.0},   {4.985, 4.0, 4.0, 1.0, 48.3, -32.1, 64.0},
    {4.49, 4.85, 4.0, 1.0, 48.6, -32.1, 64.1}, {4.49, 4.29, 4.81, 1.0, 48.0, -32.0, 64.0},
    {3.3, 3.31, 4.0, 1.0, 48.3, -32.1, 64.0},  {4.49, 4.29, 3.64, 0.2, 48.6, -32.1, 64.1},
    {6.1, 4.7, 4.3, 0.5, 23.0, -27.0, 61.5}};
// three in contact with each other, two of them with a floor z = 0, and one that falls on it
inline const std::vector<Mover> pile = {{3.5, 4.0, 0.49, 1.0, 31.0, 20.5, 0.0},
                                        {4.48, 4.0, 0.485, 1.0, 30.5, 21.0, 0.0},
                                        {4.0, 4.2, 1.315, 1.0, 32.0, 20.0, -1.0},
                                        {4.0, 6.0, 0.6, 1.0, 20.0, -9.0, -20.0}};
// in a cylinder of radius 3.5 about (4, 4): on its wall, and a pair
inline const std::vector<Mover> pipe = {{4.0, 0.99, 4.0, 1.0, 3.0, 0.0, 40.0},
                                        {7.013, 4.0, 4.3, 1.0, 0.0, 2.0, 40.0},
                                        {4.9, 1.32, 4.3, 1.0, 1.0, 0.0, 40.0},
                                        {4.0, 6.9, 4.1, 1.0, 0.0, 20.0, 41.0}};

inline const std::string lossy = jkr + "damping tsuji 0.5" + all_friction;
inline const std::string wet = " jkr 1.0e6 0.25 20.0 damping alpha 0.3 sliding 0.3 rolling 0.02 "
                               "bridge 0.02 40.0 10 0.3 0.01 tangential yes inventory 0.3 ";
inline const std::string agg =
    "compute agg all aggregate/contact\ncompute sum all reduce sum c_agg[1] "
    "c_agg[2] c_agg[3] c_agg[4] c_agg[5] c_agg[6]\n";
inline const std::vector<std::string> of_agg = {"c_agg[1]", "c_agg[2]", "c_agg[3]"};

// Some of all sizes in a fluid, far from each other but for two in contact, without friction: what
// a data file has is enough to find their contact again.
inline std::string crowd()
{
  std::vector<Mover> all;
  for (int n = 0; n < 40; n++)
    all.push_back({0.5 + n % 4 * 2.0 + 0.1 * (n % 7), 0.6 + n / 4 % 4 * 2.0, 0.7 + n / 16 * 2.0,
                   n % 3 ? 0.4 : 0.6, 3.0 * (n % 5) - 6.0, 40.0, 1.0 * (n % 3)});
  all.push_back({3.0, 3.0, 6.7, 1.0, 38.0, 1.0, -0.5});
  all.push_back({3.9, 3.4, 6.7, 1.0, 38.5, 1.1, -0.4});
  return spheres(all) + pair_of(jkr);
}

struct Files {
  TemporaryFile pipe{"apf_matrix_pipe"}, series{"apf_matrix_series"};
  Files()
  {
    pipe.write({41, 41, 41}, {0, 0, 0}, {0.2, 0.2, 0.2}, [](VtkhdfWriter &w) {
      w.field("distance", 1, [](const double *x, double, double *phi) {
        *phi = 3.5 - std::hypot(x[0] - 4.0, x[1] - 4.0);
      });
    });
    series.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, [](VtkhdfWriter &w) {
      w.steps({0.0, 0.015, 0.04});
      w.field("velocity", 3,
              [](const double *, double t, double *u) {
                u[0] = t < 0.01 ? 9.0 : -20.0;
                u[1] = 30.0 + 100.0 * t;
              },
              {0.0, 0.015, 0.04});
    });
  }
};

inline std::vector<Row> table(const Files &files)
{
  const std::string floor = "fix wall all wall/levelset plane z 0 NULL" + lossy;
  const std::string pull = "fix pull all gravity 50 vector 1 0.5 -1\n";
  const std::string loads = "thermo_modify norm no\n";
  std::vector<Row> rows;
  auto add = [&](const std::string &name) -> Row & {
    rows.emplace_back();
    rows.back().name = name;
    return rows.back();
  };
  {
    auto &row = add("pair granular/adhesive, fix contact/history");
    row.start = box("p p p") + spheres(aggregate) + pair_of(lossy);
    row.outputs = {{"pe"}};
  }
  {
    auto &row = add("... with bridges and the liquid of particles");
    row.start = box("p p p") + spheres(aggregate) + pair_of(wet);
    row.styles = agg + "neighbor 0.6 bin\n";
    row.outputs = {of_agg, entries("c_sum", 4, 5), {"c_sum[6]"}};
  }
  {
    auto &row = add("... of pair_style hybrid/overlay, beside pair soft");
    row.start = box("p p p") + spheres(aggregate) +
        "pair_style hybrid/overlay granular/adhesive soft 1.6\n";
    row.styles = "pair_coeff * * granular/adhesive" + lossy + "\npair_coeff * * soft 3.0\n";
    row.outputs = {{"pe"}};
    row.half = 15;    // rounding grows faster where pairs are pushed apart, too
  }
  {
    auto &row = add("... in a plane, with friction");
    auto flat = aggregate;
    for (auto &one : flat) one.z = one.vz = 0.0;
    flat.erase(flat.begin() + 3);    // it stood above another one, as the sixth below
    flat.erase(flat.begin() + 4);
    row.start = "dimension 2\n" + box("p p p", "-0.5 0.5") + spheres(flat) + pair_of(lossy);
    row.styles = "fix flat all enforce2d\n";
    row.outputs = {{"pe"}};
    row.axes = "xy";
    row.shift = "4 4 0";
  }
  {
    auto &row = add("compute aggregate/contact");
    row.start = box("p p f") + spheres(pile) + pair_of(lossy);
    row.styles = floor + "\n" + agg;
    row.outputs = {of_agg, entries("c_agg", 4, 6), entries("c_sum", 2, 4)};
    row.shift = "4 4 0";
  }
  {
    auto &row = add("fix wall/levelset plane, zones");
    row.start = box("p p f") + spheres(pile) + pair_of(lossy);
    row.styles = floor + " zone floor lo\n" + pull;
    row.outputs = {entries("f_wall", 1, 3), entries("f_wall", 7, 9), entries("f_wall[1]", 8, 11)};
    row.shift = "4 4 0";
  }
  {
    auto &row = add("compute wall/deposit");
    row.start = box("p p f") + spheres(pile) + pair_of(lossy);
    row.styles = floor + " zone floor lo\n" + pull +
        "compute dust all wall/deposit wall zone floor\ncompute sum all reduce sum c_dust\n";
    row.outputs = {{"c_dust[1]"}, {"c_dust[2]"}, {"c_dust[3]"}, {"c_sum"}};
    row.shift = "4 4 0";
  }
  {
    auto &row = add("fix wall/levelset cylinder");
    row.start = box("f f p") + spheres(pipe) + pair_of(lossy);
    row.styles = "fix wall all wall/levelset cylinder z 4 4 3.5 inside" + lossy + "\n";
    row.outputs = {entries("f_wall", 1, 3), entries("f_wall", 7, 9)};
    row.shift = "0 0 4";
  }
  {
    auto &row = add("fix wall/levelset file");
    row.start = box("f f p") + spheres(pipe) + pair_of(lossy);
    row.styles = "fix wall all wall/levelset file " + files.pipe.path + lossy + "\n";
    row.outputs = {entries("f_wall", 1, 3), entries("f_wall", 7, 9)};
    row.shift = "0 0 4";
  }
  {
    auto &row = add("fix wall/levelset move, by variables");
    row.start = box("p p f") + spheres(pile) + pair_of(lossy);
    row.styles = "variable shake equal 1.5*sin(200*time)\nvariable side equal 3\n" + floor +
        " move linear v_side 0 v_shake\n" + pull;
    row.outputs = {entries("f_wall", 1, 3), entries("f_wall", 7, 9)};
    row.shift = "4 4 0";
  }
  {    // the axis of the pipe goes around that of the turn, faster and faster
    auto &row = add("fix wall/levelset file, move rotate by a variable");
    row.start = box("f f p") + spheres(pipe) + pair_of(lossy);
    row.styles = "variable turn equal 5+300*time\nfix wall all wall/levelset file " +
        files.pipe.path + lossy + " move rotate 4.02 4 0 0 0 v_turn\n";
    row.outputs = {entries("f_wall", 1, 3), entries("f_wall", 7, 9)};
    row.shift = "0 0 4";
  }
  {
    auto &row = add("fix wall/levelset with a film, bridges");
    row.start = box("p p f") + spheres(pile) + pair_of(wet);
    row.styles = "fix wall all wall/levelset plane z 0 NULL" + wet + "film 0.01\n" + agg +
        "neighbor 0.6 bin\n";
    row.outputs = {entries("f_wall", 1, 3), {"f_wall[12]"}, {"c_sum[6]"}};
    row.shift = "4 4 0";
  }
  {
    auto &row = add("fix wall/levelset file with a film, bridges");
    row.start = box("f f p") + spheres(pipe) + pair_of(wet);
    row.styles = "fix wall all wall/levelset file " + files.pipe.path + wet + "film 0.01\n" + agg +
        "neighbor 0.6 bin\n";
    row.outputs = {entries("f_wall", 1, 3), {"f_wall[12]"}, {"c_sum[6]"}};
    row.shift = "0 0 4";
  }
  auto add_inlet = [&](const std::string &name, const std::string &words, const char *last) {
    auto &row = add(name);
    row.start = box("f p p") + pair_of(jkr);
    row.styles = "fix air all flow/field uniform 200 0 0 density 1 viscosity 1\n"
                 "fix in all inlet/flow x 0 air " +
        words +
        " diameter uniform 0.3 0.5 density 1 type 1 seed 7 outlet x 5\n"
        "fix drag all flow/force air drag stokes torque yes\nneighbor 0.6 bin\n";
    row.outputs = {entries("f_in", 1, 2), entries("f_in", 3, 4), {last}};
    row.no_shift = "places where particles enter do not move along";
    row.empty = 2 * row.half - 1;
  };
  add_inlet("fix inlet/flow, fix flow/force drag", "concentration 0.02", "f_in[9]");
  // in a window where there is hardly room
  add_inlet("fix inlet/flow number, what waits",
            "number 1.7 every 2 window 3.5 4.5 3.5 4.5 attempts 10", "f_in[5]");
  for (const bool any : {false, true}) {
    auto &row = add("fix inlet/flow in a channel, contacts of what has entered");
    if (any) {
      row.name += ", steps as needed";
      row.integrators = {"mts auto", "mts tolerance 0.01"};
    }
    row.start = box("f f p") + pair_of(lossy);
    row.styles = "fix air all flow/field channel x y 0 8 200 density 1 viscosity 1\n"
                 "fix in all inlet/flow x 0 air concentration 0.2 diameter uniform 0.6 0.9 "
                 "density 1 type 1 seed 7 window 0.6 7.4 0.6 7.4 outlet x 5\n"
                 "fix drag all flow/force air drag stokes torque yes\nneighbor 0.8 bin\n" +
        agg;
    row.outputs = {entries("f_in", 1, 2), entries("f_in", 3, 4), {"c_sum[4]"}};
    row.no_shift = "places where particles enter do not move along";
    row.empty = 2 * row.half - 1;
    row.begin = 1e-2;
    row.enters = true;
  }
  {
    auto &row = add("fix flow/force brownian");
    row.start = box("p p p") + crowd();
    row.styles = "fix air all flow/field uniform 30 9 1 density 0.2 viscosity 0.5\n"
                 "fix drag all flow/force air drag schiller torque yes brownian 0.5 4711\n";
    row.outputs = {entries("f_drag", 1, 3)};
    row.data_pair = pair_of(jkr);
    row.random = true;
    row.no_data = "";
    row.begin = 1e-2;
  }
  {
    auto &row = add("fix flow/force brownian, all forces");
    row.start = box("p p p") + crowd();
    row.styles = "fix air all flow/field uniform 30 9 1 density 0.2 viscosity 0.5\n"
                 "fix drag all flow/force air drag schiller torque yes lift saffman magnus yes "
                 "added_mass yes pressure yes gravity 0 0 -9 brownian 0.5 4711\n";
    row.integrators = {"verlet", "mts"};    // added_mass refuses respa
    row.outputs = {entries("f_drag", 1, 3)};
    row.data_pair = pair_of(jkr);
    row.random = true;
    row.no_data = "";
    row.begin = 1e-2;
  }
  {
    auto &row = add("fix flow/field by variables, added mass and pressure");
    row.start = box("p p p") + crowd();
    row.styles = "variable u equal 30*sin(300*time)\n"
                 "fix air all flow/field uniform v_u 9 1 density 0.2 viscosity 0.5\n"
                 "fix drag all flow/force air drag stokes added_mass yes pressure yes\n";
    row.integrators = {"verlet", "mts", "mts 8 fluid 3"};
    row.half = 31;    // amid a fluid step
    row.outputs = {entries("f_drag", 1, 3)};
    row.data_pair = pair_of(jkr);
    row.no_data = "data files have no rate of change of the flow";
    row.begin = 1e-3;
  }
  {
    auto &row = add("fix flow/field file, series");
    row.start = box("p p p") + crowd();
    row.styles = "fix air all flow/field file " + files.series.path +
        " density 0.2 viscosity 0.5\nfix drag all flow/force air drag stokes torque yes\n";
    row.integrators.push_back("mts 8 fluid 3");
    row.half = 31;    // amid a fluid step
    row.outputs = {{"f_air[6]"}, entries("f_drag", 1, 3)};
    row.data_pair = pair_of(jkr);
    row.no_data = "";
    row.begin = 1e-3;
  }
  {
    auto &row = add("fix flow/concentration, feedback");
    row.start = box("p p p") + crowd();
    row.styles = "fix air all flow/field uniform 30 9 1 density 0.2 viscosity 0.5\n"
                 "fix c all flow/concentration 16 16 16 cloud 0.8 method direct\n"
                 "fix drag all flow/force air drag difelice concentration c torque yes feedback "
                 "yes\n";
    row.integrators.push_back("mts 8 fluid 3");
    row.outputs = {{"f_c[1]"}, {"f_c[2]"}, entries("f_drag", 1, 3)};
    row.data_pair = pair_of(jkr);
    row.no_data = "";
    row.begin = 1e-3;
  }
  {    // the grid is older than the particles in most steps
    auto &row = add("fix flow/concentration every 6, feedback on a grid of its own");
    row.start = box("p p p") + crowd();
    row.styles = "fix air all flow/field uniform 30 9 1 density 0.2 viscosity 0.5\n"
                 "fix c all flow/concentration 16 16 16 cloud 0.8 every 6 method direct\n"
                 "fix drag all flow/force air drag difelice concentration c torque yes feedback "
                 "12 8 10\n";
    row.integrators.push_back("mts 8 fluid 3");
    row.outputs = {{"f_c[1]"}, {"f_c[2]"}, entries("f_drag", 1, 3), entries("f_drag", 25, 27)};
    row.data_pair = pair_of(jkr);
    row.no_data = "";
    row.begin = 1e-3;
  }
#ifdef APF_FFTW
  {
    auto &row = add("fix flow/concentration method fft");
    row.start = box("p p p") + crowd();
    row.styles = "fix air all flow/field uniform 30 9 1 density 0.2 viscosity 0.5\n"
                 "fix c all flow/concentration 16 16 16 cloud 1.4 method fft\n"
                 "fix drag all flow/force air drag difelice concentration c torque yes\n";
    row.outputs = {{"f_c[1]"}, {"f_c[2]"}, entries("f_drag", 1, 3)};
    row.data_pair = pair_of(jkr);
    row.no_data = "";
    row.begin = 1e-3;
  }
#endif
  for (const std::string how : {"auto", "tolerance 0.01"}) {
    auto &wall = add("fix nve/sphere/mts collision " + how + " beside fix wall/levelset file");
    wall.start = box("f f p") + spheres(pipe) + pair_of(lossy);
    wall.styles = "fix wall all wall/levelset file " + files.pipe.path + lossy + "\n";
    wall.integrators = {"mts " + how};
    wall.outputs = {{"f_nve[1]"}, {"f_nve[3]"}, {"f_nve[4]"}, entries("f_wall", 1, 3)};
    wall.shift = "0 0 4";
    auto &row = add("fix nve/sphere/mts collision " + how);
    row.start = box("p p p") + spheres(aggregate) + pair_of(lossy);
    row.integrators = {"mts " + how};
    row.outputs = {{"f_nve[1]"}, {"f_nve[3]"}, {"f_nve[4]"}};
  }
  for (auto &row : rows) row.styles += loads;
  return rows;
}

inline std::string integrate(const std::string &name)
{
  if (name == "verlet") return "fix nve all nve/sphere\ntimestep " + digits(inner * dt) + "\n";
  if (name == "respa")
    return "fix nve all nve/sphere\ntimestep " + digits(inner * dt) + "\nrun_style respa 2 " +
        std::to_string(inner) + " pair 1\n";
  if (name == "mts") return mts(inner);
  return "fix nve all nve/sphere/" + name.substr(0, 4) + "collision " + name.substr(4) +
      "\ntimestep " + digits(inner * dt) + "\n";
}

}    // namespace matrix

#endif
