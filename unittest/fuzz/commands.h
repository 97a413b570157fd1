// Right commands of every style of APF, to be spoilt by fuzz_commands, and what must be there
// before. The files that they name are in the folder where it works.

#ifndef APF_FUZZ_COMMANDS_H
#define APF_FUZZ_COMMANDS_H

#include "vtkhdf_writer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace fuzz {

// two pairs of spheres that touch, one of them at the wall y = 0
inline const std::string scene = R"(
units si
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary p f p
region box block 0 8 0 8 0 8
create_box 2 box
create_atoms 1 single 3 0.495 4
create_atoms 2 single 3.99 0.6 4
create_atoms 1 single 5 5 5
create_atoms 2 single 5.99 5 5
set group all diameter 1.0 density 1.0
neighbor 0.5 bin
timestep 1e-5
thermo 1
variable zero equal 0.0
)";

// What a file has at a position in place of a number.
using Spoil = std::function<double(const double *x, double right)>;
inline double as_it_is(const double *, double right)
{
  return right;
}

inline const std::string walls_file = "walls.vtkhdf", flow_file = "flow.vtkhdf";
inline const VtkhdfWriter::Counts grid_nodes = {9, 9, 9};
inline const VtkhdfWriter::Triple grid_origin = {0, 0, 0}, grid_spacing = {1, 1, 1};

// walls below and above the box
inline void write_walls(const std::string &path, const Spoil &floor, const Spoil &lid)
{
  VtkhdfWriter walls(path, grid_nodes, grid_origin, grid_spacing);
  walls.field("distance_floor", 1, [&](const double *x, double, double *s) {
    *s = floor(x, x[1]);
  });
  walls.field("distance_lid", 1, [&](const double *x, double, double *s) {
    *s = lid(x, 8.0 - x[1]);
  });
}

// a shear flow between them, which a frame later is faster
inline void write_flow(const std::string &path, const Spoil &distance, const Spoil &velocity)
{
  VtkhdfWriter flow(path, grid_nodes, grid_origin, grid_spacing);
  flow.field("distance", 1, [&](const double *x, double, double *s) {
    *s = distance(x, std::min(x[1], 8.0 - x[1]));
  });
  flow.steps({0.0, 1e-5});
  flow.field("velocity", 3,
             [&](const double *x, double t, double *u) {
               u[0] = velocity(x, x[1] * (1.0 + 1e4 * t));
             },
             {0.0, 1e-5});
}

inline void write_grids()
{
  write_walls(walls_file, as_it_is, as_it_is);
  write_flow(flow_file, as_it_is, as_it_is);
}

// what parts of the words of a command need
inline const std::string pair = "pair_style granular/adhesive\npair_coeff * * jkr 1e6 0.3 10\n";
inline const std::string wet_law =
    "jkr 1e6 0.3 10 bridge 0.01 0.072 20 1e-3 form film inventory 0.5";
inline const std::string wet = "pair_style granular/adhesive\npair_coeff * * " + wet_law + "\n";
inline const std::string nve = "fix nve all nve/sphere\n";
inline const std::string air =
    "fix air all flow/field shear x y 1.0 0.0 density 1.2 viscosity 1.8e-1\n";
inline const std::string floor_below = "fix floor all wall/levelset plane y 0 8 jkr 1e6 0.3 10\n";
inline const std::string cloud = "fix cloud all flow/concentration 8 8 8 cloud 0.6 every 1\n";

struct Command {
  std::string before, command;
  int keep;    // words at the beginning that stay, since others would be another command
  std::string after = {};    // what a right one needs before a run
  bool ours = true;          // else LAMMPS's, whose messages are its own
  double most = HUGE_VAL;    // a number beyond which LAMMPS itself fails, by too many ghosts
};

inline const Command commands[] = {
    {nve + wet,
     "fix wall all wall/levelset plane y 0 8 jkr 1e6 0.3 10 damping tsuji 0.2 bridge 0.01 0.072 20 "
     "1e-3 0.01 form film capillary willett tangential yes wet_gamma 2.0 1 1.5 0.5 inventory 0.5 "
     "even film 1e-3 zone low lo",
     4},
    {nve + pair,
     "fix wall all wall/levelset file walls.vtkhdf array distance_floor array distance_lid jkr 1e6 "
     "0.3 10 sliding 0.3 resolution 0.1 zone low floor",
     4},
    {nve + wet, "fix wall all wall/levelset file walls.vtkhdf " + wet_law + " film 1e-3", 4},
    {nve + pair,
     "fix air all flow/field file flow.vtkhdf density 1.2 viscosity 1.8e-5 loop yes outside clamp "
     "wall reconstruct",
     4},
    {nve + "pair_style granular/adhesive\n",
     "pair_coeff * * jkr 1e6 0.3 10 damping tsuji 0.8 sliding 0.3 twisting yes rolling 0.02 0.1 "
     "break force scale_stiffness 0.5",
     1},
    {nve + "pair_style granular/adhesive\n",
     "pair_coeff * * material materials.adhesive silica damping alpha 0.4 sliding 0.3", 1},
    {nve + "pair_style granular/adhesive\n",
     "pair_coeff * * jkr 1e6 0.3 10 damping tsuji 0.2 sliding 0.3 bridge 0.01 0.072 20 1e-3 form "
     "film capillary willett tangential yes inventory 0.5 origin",
     1},
    {nve + pair,
     "fix wall all wall/levelset plane y 0 8 jkr 1e6 0.3 10 damping alpha 0.3 sliding 0.3 twisting "
     "yes rolling 0.02 0.1 break displacement scale_stiffness 0.5",
     4},
    {nve + pair, "fix wall all wall/levelset cylinder z 4 4 5.0 inside jkr 1e6 0.3 10", 4},
    {nve + pair, "fix air all flow/field channel x y 0 8 1.0 density 1.2 viscosity 1.8e-5", 4},
    {nve + pair, "fix air all flow/field pipe x 4 4 4 1.0 density 1.2 viscosity 1.8e-5", 4},
    {nve + pair, "fix air all flow/field uniform 1 v_zero 0 density 1.2 viscosity 1.8e-5", 4},
    {nve + pair, "fix air all flow/field shear x y 1.0 0.0 density 1.2 viscosity 1.8e-5", 4},
    {nve + pair + air,
     "fix drag all flow/force air drag stokes torque yes gravity 0 -9.8 0 lift saffman magnus yes "
     "added_mass yes pressure yes cunningham 1e-8",
     4},
    {nve + pair + air, "fix drag all flow/force air drag schiller brownian 300 12345", 4},
    {nve + pair + air + cloud,
     "fix drag all flow/force air drag difelice superficial concentration cloud feedback yes", 4},
    {nve + pair + air, "fix drag all flow/force air drag difelice concentration 0.1 feedback 4 4 4",
     4},
    {nve + pair, "fix cloud all flow/concentration 8 8 8 cloud 0.6 every 1 method direct", 4},
    {nve + pair, "fix cloud all flow/concentration 40 40 40 cloud 0.6 method fft", 4},
    {nve + pair + air,
     "fix in all inlet/flow x 1.0 air concentration 0.01 every 1 diameter lognormal 0.2 1.2 0.1 "
     "0.4 "
     "density 2 type 1 seed 7 window 1 7 1 7 gap 0.01 attempts 50 outlet x 7.0",
     4},
    {nve + pair + air,
     "fix in all inlet/flow x 1.0 air number 2 diameter poly volume 2 0.2 0.5 0.3 0.5 density 2 "
     "type "
     "2 seed 7",
     4},
    {pair, "fix nve all nve/sphere/mts collision 10 fluid 2 lookahead yes", 4},
    {pair, "fix nve all nve/sphere/mts collision auto safety 0.2", 4},
    {pair, "fix nve all nve/sphere/mts collision tolerance 0.01", 4},
    {nve + pair, "compute clumps all aggregate/contact", 3},
    {nve + pair, "compute parts all pair granular/adhesive", 3},
    {nve + pair + floor_below, "compute dust all wall/deposit floor", 3},
    {nve + pair + air, "apf_advise speed 0.5 length 1e-3", 1},
    {nve + pair,
     "fix lid all wall/levelset plane y 0 NULL jkr 1e6 0.3 10 sliding 0.3 move rotate 4 0 4 0 "
     "v_zero 0",
     4},
    {nve + pair,
     "fix lid all wall/levelset plane y 0 NULL jkr 1e6 0.3 10 sliding 0.3 move linear 0.1 v_zero "
     "0",
     4},
    {nve + "pair_style granular/adhesive\n",
     "pair_coeff * * jkr 1e6 0.3 10 damping none sliding 0.3 twisting no break touch", 1},
    {nve + "pair_style granular/adhesive\n",
     "pair_coeff * * jkr 1e6 0.3 10 bridge 0.01 0.072 20 1e-3 form contact capillary maugis "
     "tangential no inventory 0.5 even",
     1},
    {nve + pair + "region part block 0 4 0 8 0 8\n",
     "fix wall all wall/levelset plane y 0 8 jkr 1e6 0.3 10 break touch zone high hi zone part "
     "part",
     4},
    {nve + pair, "fix wall all wall/levelset cylinder z 7 7 0.5 outside jkr 1e6 0.3 10", 4},
    {nve + pair,
     "fix air all flow/field file flow.vtkhdf density 1.2 viscosity 1.8e-5 loop yes outside error "
     "wall plain",
     4},
    {nve + pair + air,
     "fix drag all flow/force air drag stokes torque no magnus no added_mass no pressure no "
     "peratom no",
     4},
    {nve + pair + air + cloud,
     "fix drag all flow/force air drag difelice concentration cloud feedback no peratom yes", 4},
    {nve + pair, "fix cloud all flow/concentration 8 8 8 cloud 0.6 method auto", 4},
    {nve + pair + air,
     "fix in all inlet/flow x 1.0 air number 2 every 3 diameter uniform 0.2 0.4 density 2 type 1 "
     "seed 7 outlet x 7.0 outlet -x 0.5",
     4},
    {nve + pair + air,
     "fix in all inlet/flow x 1.0 air number 2 diameter poly number 2 0.2 0.5 0.3 0.5 density 2 "
     "type "
     "1 seed 7",
     4},
    {pair, "fix nve all nve/sphere/mts collision auto lookahead no fluid 3", 4},
    {nve + pair + floor_below, "compute dust all wall/deposit floor zone lo", 3},
    {nve, "pair_style granular/adhesive", 1, "pair_coeff * * jkr 1e6 0.3 10"},
    {nve + pair + air + floor_below +
         "fix drag all flow/force air drag stokes brownian 300 12345\n",
     "timestep 1e-5", 1, "", false},
    {pair + floor_below + "fix nve all nve/sphere/mts collision auto\n", "timestep 1e-5", 1, "",
     false},
    {nve + pair + floor_below, "neighbor 0.5 bin", 1, "", false, 20.0},
    {pair + floor_below + "fix nve all nve/sphere/mts collision 10\n", "neighbor 0.5 bin", 1, "",
     false, 20.0},
    // (without keyword one: LAMMPS crashes at one 0, with any pair style)
    {nve + pair + floor_below, "neigh_modify delay 0 every 1 check yes page 100000", 1, "", false,
     1e6},
    {nve + pair + air + floor_below, "comm_modify vel yes cutoff 2.0 mode single", 1, "", false,
     20.0},
    {nve + pair + floor_below, "fix_modify floor energy yes virial yes respa 1", 2},
    {nve + pair + air + "fix drag all flow/force air drag stokes\n",
     "fix_modify drag virial no respa 1", 2},
};

// How messages call values that follow a keyword, where they do not repeat it. In lower case.
struct Called {
  const char *keyword, *as;
};
inline const Called called[] = {{"jkr", "young's modulus"},
                                {"jkr", "poisson's ratio"},
                                {"jkr", "surface energy"},
                                {"feedback", "a grid of"}};

// lower case; one of them begins every message of APF's own, and says nothing by itself
inline const char *const names[] = {
    "pair granular/adhesive",
    "fix wall/levelset",
    "fix flow/field",
    "fix flow/force",
    "fix flow/concentration",
    "fix inlet/flow",
    "fix nve/sphere/mts",
    "compute aggregate/contact",
    "compute wall/deposit",
    "command apf_advise",
    "fix_modify",
    "pair_coeff",
};

}    // namespace fuzz

#endif
