#include "fix_flow_field.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "flow_grid.h"
#include "given_once.h"
#include "input.h"
#include "lost_state.h"
#include "modify.h"
#include "restart_state.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixFlowField::FixFlowField(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), density(0.0), viscosity(0.0), guard(lmp), varies(false), evaluated(never),
    evaluated_at(std::numeric_limits<double>::quiet_NaN())
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix flow/field", error);

  dynamic_group_allow = 1;
  vector_flag = 1;
  size_vector = 9;
  global_freq = 1;
  extvector = 0;

  if (strcmp(arg[3], "file") == 0) {
    parse_file(narg, arg);
  } else {
    GivenOnce given(lmp, command);
    int iarg = parse_kind(narg, arg);
    while (iarg < narg) {
      given.add(arg[iarg], iarg);
      iarg = parse_property(iarg, narg, arg);
    }
  }
  if (density == 0.0) error->all(FLERR, "Fix flow/field requires keyword density");
  if (viscosity == 0.0) error->all(FLERR, "Fix flow/field requires keyword viscosity");
  change = flow;
  set_speed(flow, &Speed::value);
  set_speed(change, &Speed::rate);
  restart_global = varies && !grid;
}

/* ---------------------------------------------------------------------- */

FixFlowField::~FixFlowField() = default;

/* ---------------------------------------------------------------------- */

int FixFlowField::setmask()
{
  return varies ? PRE_FORCE | PRE_FORCE_RESPA : 0;
}

/* ---------------------------------------------------------------------- */

void FixFlowField::find_variables()
{
  for (auto &one : speed) {
    if (one.variable.empty()) continue;
    one.index = input->variable->find(one.variable.c_str());
    if (one.index < 0)
      error->all(FLERR, Error::NOLASTLINE, "Fix flow/field {}: variable {} does not exist", id,
                 one.variable);
    if (!input->variable->equalstyle(one.index))
      error->all(FLERR, Error::NOLASTLINE, "Fix flow/field {}: variable {} must be of style equal",
                 id, one.variable);
  }
}

void FixFlowField::init()
{
  if (restart_global) LostState::warn(lmp, this, "its flow begins anew");
  find_variables();
  if (grid) grid->check_box(Error::NOLASTLINE);

  every = 1;
  int dim;
  for (const auto &fix : modify->get_fix_list())
    if (const auto *steps = static_cast<int *>(fix->extract("fluid_every", dim))) every = *steps;
  begins = true;
}

/* ----------------------------------------------------------------------
   a flow that was forgotten in a run; all who sample it have told so in their init()
------------------------------------------------------------------------- */

void FixFlowField::setup(int /*vflag*/)
{
  guard.prepared();
  const bool has_walls = has_distance() && !modify->get_fix_by_style("^flow/concentration").empty();
  if (!taken && !has_walls && !warned) {
    warned = true;
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix flow/field {}: no fix makes this flow act on particles, and it does not "
                     "by itself; fix flow/force {} makes it do so",
                     id, id);
  }
  taken = false;
}

/* ----------------------------------------------------------------------
   evaluate variables before the first force of a step, whatever its level
------------------------------------------------------------------------- */

void FixFlowField::setup_pre_force(int /*vflag*/)
{
  evaluate();
}

void FixFlowField::setup_pre_force_respa(int /*vflag*/, int /*ilevel*/)
{
  evaluate();
}

void FixFlowField::pre_force(int /*vflag*/)
{
  evaluate();
}

void FixFlowField::pre_force_respa(int /*vflag*/, int /*ilevel*/, int /*iloop*/)
{
  evaluate();
}

void FixFlowField::evaluate()
{
  guard.require(this);
  const bigint now = update->ntimestep;
  if (evaluated == now && !begins) return;
  const bool begun = begins;    // a run: the script may have changed variables
  begins = false;
  if (!grid && now % every && now > evaluated && now - evaluated < every) {
    if (begun) modify->addstep_compute_all((now / every + 1) * every);
    return;
  }
  evaluated = now;
  if (grid) {
    grid->set_time(time());
    gridded = grid->flow();
  } else
    evaluate_variables();
}

/* ----------------------------------------------------------------------
   values of the variables now, and how fast they changed since the last ones
------------------------------------------------------------------------- */

void FixFlowField::evaluate_variables()
{
  const double interval = time() - evaluated_at;
  evaluated_at = time();
  find_variables();    // a run without setup finds those that the script has made since
  modify->clearstep_compute();
  for (auto &one : speed) {
    if (one.index < 0) continue;
    const double before = one.value;
    one.value = input->variable->compute_equal(one.index);
    if (!std::isfinite(one.value))
      error->all(FLERR, Error::NOLASTLINE, "Fix flow/field {}: variable {} is {} at step {}", id,
                 one.variable, one.value, update->ntimestep);
    if (interval != 0.0) one.rate = interval > 0.0 ? (one.value - before) / interval : 0.0;
  }
  modify->addstep_compute((update->ntimestep / every + 1) * every);
  set_speed(flow, &Speed::value);
  set_speed(change, &Speed::rate);
}

/* ---------------------------------------------------------------------- */

double FixFlowField::time() const
{
  return update->atime + (update->ntimestep - update->atimestep) * update->dt;
}

/* ---------------------------------------------------------------------- */

void FixFlowField::require(apf::Detail detail, bool acts)
{
  taken |= acts;
  if (!grid) return;
  grid->require(detail);
  grid->set_time(time());
  gridded = grid->flow();
}

/* ---------------------------------------------------------------------- */

bool FixFlowField::has_distance() const
{
  return grid && grid->has_distance();
}

void FixFlowField::distance(const apf::PointBlock &points, apf::Lanes &out) const
{
  apf::FluidBlock fluid;
  sample(points, apf::Detail::VELOCITY, fluid);
  std::copy_n(fluid.distance, points.n, out);
}

/* ----------------------------------------------------------------------
   name the particle that has left the grid
------------------------------------------------------------------------- */

void FixFlowField::outside(const apf::PointBlock &points) const
{
  apf::PointBlock one;
  apf::FluidBlock fluid;
  double x[3] = {0.0, 0.0, 0.0};
  one.n = 1;
  for (int l = 0; l < points.n; l++) {
    for (int c = 0; c < 3; c++) x[c] = points.x[c][l];
    one.set(0, x);
    if (!gridded.sample(one, apf::Detail::VELOCITY, fluid)) break;
  }
  std::string name = "a point", border;
  for (int i = 0; i < atom->nlocal; i++)
    if (std::equal(x, x + 3, atom->x[i])) {
      name = fmt::format("atom {}", atom->tag[i]);
      border = border_left(x);
    }
  const auto place =
      fmt::format("Fix flow/field {}: {} at ({:.8g}, {:.8g}, {:.8g}) ", id, name, x[0], x[1], x[2]);
  if (border.empty())
    error->one(FLERR, Error::NOLASTLINE,
               "{}is outside the grid, {}; keyword outside clamp continues it", place,
               grid->extent());
  error->one(FLERR, Error::NOLASTLINE,
             "{}has left the box at its fixed border {}, and is outside the grid, {}; keyword "
             "outlet of fix inlet/flow deletes and counts particles that leave, before the border",
             place, border, grid->extent());
}

// the fixed border of the box that a point is beyond, as in "x = 1", or nothing
std::string FixFlowField::border_left(const double *x) const
{
  constexpr int fixed = 1;
  for (int c = 0; c < domain->dimension; c++)
    for (const int upper : {0, 1}) {
      const double border = upper ? domain->boxhi[c] : domain->boxlo[c];
      if (domain->boundary[c][upper] == fixed && (upper ? x[c] > border : x[c] < border))
        return fmt::format("{} = {:.6g}", "xyz"[c], border);
    }
  return {};
}

/* ---------------------------------------------------------------------- */

void FixFlowField::set_speed(apf::FlowField &kind, double Speed::*part) const
{
  const double first = speed[0].*part;
  if (auto *uniform = std::get_if<apf::UniformFlow>(&kind))
    uniform->speed = {first, speed[1].*part, speed[2].*part};
  else if (auto *shear = std::get_if<apf::ShearFlow>(&kind))
    shear->rate = first;
  else if (auto *channel = std::get_if<apf::ChannelFlow>(&kind))
    channel->umax = first;
  else if (auto *pipe = std::get_if<apf::PipeFlow>(&kind))
    pipe->umax = first;
}

/* ----------------------------------------------------------------------
   1-3 = velocities or rate that the flow has now, 4 = density, 5 = viscosity,
   6 = time in the file's series, 7-9 = d/dt of 1-3
------------------------------------------------------------------------- */

double FixFlowField::compute_vector(int n)
{
  if (n < 3) return speed[n].value;
  if (n > 5) return speed[n - 6].rate;
  if (n == 5) return grid ? grid->file_time() : 0.0;
  return n == 3 ? density : viscosity;
}

/* ----------------------------------------------------------------------
   speeds that variables gave and their rates, so that the rates go on after a restart
------------------------------------------------------------------------- */

void FixFlowField::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  RestartState::write(lmp, this,
                      {speed[0].value, speed[1].value, speed[2].value, speed[0].rate, speed[1].rate,
                       speed[2].rate, evaluated_at, static_cast<double>(evaluated)},
                      fp);
}

void FixFlowField::restart(char *buffer)
{
  RestartState state(lmp, this, buffer);
  for (auto &s : speed) {
    const double value = state.next();
    if (!s.variable.empty()) s.value = value;
  }
  for (auto &s : speed) s.rate = state.next();
  evaluated_at = *state.bits(1);
  evaluated = static_cast<bigint>(state.whole(never, most_counted));
  if (!std::isfinite(evaluated_at) && evaluated != never) state.damaged();
  state.end();
  set_speed(flow, &Speed::value);
  set_speed(change, &Speed::rate);
}

/* ---------------------------------------------------------------------- */

double FixFlowField::memory_usage()
{
  return grid ? grid->memory_usage() : 0.0;
}
