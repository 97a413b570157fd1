// The words of fix flow/field.

#include "fix_flow_field.h"

#include "argument_reader.h"
#include "domain.h"
#include "error.h"
#include "flow_grid.h"
#include "given_once.h"

#include <cstring>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   parse density or viscosity; return index of next argument
------------------------------------------------------------------------- */

int FixFlowField::parse_property(int iarg, int narg, char **arg)
{
  const bool is_density = strcmp(arg[iarg], "density") == 0;
  if (!is_density && strcmp(arg[iarg], "viscosity") != 0)
    error->all(FLERR, iarg, "Fix flow/field keyword must be density or viscosity, got {}",
               arg[iarg]);
  if (iarg + 2 > narg)
    utils::missing_cmd_args(FLERR, std::string("fix flow/field ") + arg[iarg], error);
  (is_density ? density : viscosity) =
      ArgumentReader(lmp, command, arg).number(iarg + 1, arg[iarg], Range::above(0.0));
  return iarg + 2;
}

/* ----------------------------------------------------------------------
   parse the kind of flow and its values; return index of next argument
------------------------------------------------------------------------- */

int FixFlowField::parse_kind(int narg, char **arg)
{
  struct Kind {
    const char *name;
    int nvalues;
    int (FixFlowField::*parse)(char **);
  };
  static const Kind kinds[] = {{"channel", 5, &FixFlowField::parse_channel},
                               {"pipe", 5, &FixFlowField::parse_pipe},
                               {"uniform", 3, &FixFlowField::parse_uniform},
                               {"shear", 4, &FixFlowField::parse_shear}};
  for (const auto &kind : kinds) {
    if (strcmp(arg[3], kind.name) != 0) continue;
    if (narg < 4 + kind.nvalues)
      utils::missing_cmd_args(FLERR, std::string("fix flow/field ") + kind.name, error);
    return (this->*kind.parse)(arg);
  }
  error->all(FLERR, 3, "Fix flow/field kind must be channel, pipe, uniform, shear or file, got {}",
             arg[3]);
  return 0;
}

/* ---------------------------------------------------------------------- */

int FixFlowField::parse_channel(char **arg)
{
  apf::ChannelFlow channel{};
  channel.flow = axis(arg, 4);
  channel.wall = axis(arg, 5);
  if (channel.wall == channel.flow)
    error->all(FLERR, 5, "Fix flow/field channel wall axis must differ from flow axis {}", arg[4]);
  const ArgumentReader reader(lmp, command, arg);
  channel.lo = reader.number(6, "channel lower wall");
  channel.hi = reader.number(7, "channel upper wall");
  if (!(channel.lo < channel.hi))
    error->all(FLERR, 7, "Fix flow/field channel upper wall must be > lower wall {}, got {}",
               arg[6], arg[7]);
  speed[0] = parse_speed(8, arg, "channel speed");
  flow = channel;
  return 9;
}

/* ---------------------------------------------------------------------- */

int FixFlowField::parse_pipe(char **arg)
{
  if (domain->dimension == 2)
    error->all(FLERR, 3, "Fix flow/field pipe requires a 3d simulation; use channel in 2d");
  apf::PipeFlow pipe{};
  pipe.flow = axis(arg, 4);
  pipe.across[0] = pipe.flow == 0 ? 1 : 0;
  pipe.across[1] = pipe.flow == 2 ? 1 : 2;
  const ArgumentReader reader(lmp, command, arg);
  for (int c = 0; c < 2; c++) pipe.centre[c] = reader.number(5 + c, "pipe centre");
  pipe.radius = reader.number(7, "pipe radius", Range::above(0.0));
  speed[0] = parse_speed(8, arg, "pipe speed");
  flow = pipe;
  return 9;
}

/* ---------------------------------------------------------------------- */

int FixFlowField::parse_uniform(char **arg)
{
  for (int k = 0; k < 3; k++) speed[k] = parse_speed(4 + k, arg, "uniform velocity");
  if (domain->dimension == 2 && (speed[2].value != 0.0 || !speed[2].variable.empty()))
    error->all(FLERR, 6, "Fix flow/field uniform z velocity must be 0 in a 2d simulation, got {}",
               arg[6]);
  flow = apf::UniformFlow{};
  return 7;
}

/* ---------------------------------------------------------------------- */

int FixFlowField::parse_shear(char **arg)
{
  apf::ShearFlow shear{};
  shear.flow = axis(arg, 4);
  shear.across = axis(arg, 5);
  if (shear.across == shear.flow)
    error->all(FLERR, 5, "Fix flow/field shear gradient axis must differ from flow axis {}",
               arg[4]);
  speed[0] = parse_speed(6, arg, "shear rate");
  shear.origin = ArgumentReader(lmp, command, arg).number(7, "shear origin");
  flow = shear;
  return 8;
}

/* ----------------------------------------------------------------------
   a flow from a file, with keywords of its own
------------------------------------------------------------------------- */

void FixFlowField::parse_file(int narg, char **arg)
{
  if (narg < 5) utils::missing_cmd_args(FLERR, "fix flow/field file", error);
  FlowGrid::Options options;
  GivenOnce given(lmp, command);
  int iarg = 5;
  while (iarg < narg) {
    given.add(arg[iarg], iarg);
    const int next = options.parse(lmp, iarg, narg, arg);
    if (next == iarg && strcmp(arg[iarg], "density") != 0 && strcmp(arg[iarg], "viscosity") != 0)
      error->all(FLERR, iarg,
                 "Fix flow/field keyword must be density, viscosity, loop, outside or wall, got {}",
                 arg[iarg]);
    iarg = next == iarg ? parse_property(iarg, narg, arg) : next;
  }
  clamp = options.clamp;
  grid = std::make_unique<FlowGrid>(lmp, arg[4], options, 4);
  varies = grid->series();
  gridded = grid->flow();
}

/* ---------------------------------------------------------------------- */

int FixFlowField::axis(char **arg, int iarg)
{
  const bool planar = domain->dimension == 2;
  const char *word = arg[iarg];
  if (strcmp(word, "x") == 0) return 0;
  if (strcmp(word, "y") == 0) return 1;
  if (strcmp(word, "z") == 0 && !planar) return 2;
  error->all(FLERR, iarg, "Fix flow/field {} axis must be {}, got {}", arg[3],
             planar ? "x or y in a 2d simulation" : "x, y or z", word);
  return 0;
}

/* ---------------------------------------------------------------------- */

FixFlowField::Speed FixFlowField::parse_speed(int iarg, char **arg, const char *what)
{
  Speed result;
  if (utils::strmatch(arg[iarg], "^v_")) {
    result.variable = arg[iarg] + 2;
    varies = true;
  } else
    result.value = ArgumentReader(lmp, command, arg).number(iarg, what);
  return result;
}
