#include "wall_motion.h"

#include "argument_reader.h"
#include "domain.h"
#include "error.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

using namespace LAMMPS_NS;

void WallMotion::parse(const char *command_in, int narg, char **arg, int &iarg)
{
  command = command_in;
  const std::string where = "fix wall/levelset move";
  if (narg < iarg + 2) utils::missing_cmd_args(FLERR, where, error);
  const ArgumentReader reader(lmp, command, arg);
  const bool rotates = reader.choice(iarg + 1, "move", {"linear", "rotate"}) == 1;
  bool &given = rotates ? turned : moved;
  if (given) error->all(FLERR, iarg, "{} move {} is given twice", command, arg[iarg + 1]);
  given = pose.moves = true;

  iarg += 2;
  if (narg < iarg + (rotates ? 6 : 3))
    utils::missing_cmd_args(FLERR, where + (rotates ? " rotate" : " linear"), error);
  if (rotates) {
    // farther away the last digit of a coordinate about it would be more than 1e-10 of the box
    const double far = 1e6 * std::max({domain->prd[0], domain->prd[1], domain->prd[2]});
    double x[3];
    for (double &component : x)
      component = reader.number(iarg++, "move rotate centre", Range::from(-far, far));
    pose.set_centre({x[0], x[1], x[2]});
  }
  for (int c = 0; c < 3; c++, iarg++) {
    Speed &speed = rotates ? turn[c] : linear[c];
    if (utils::strmatch(arg[iarg], "^v_"))
      speed.variable = arg[iarg] + 2;
    else
      speed.value = reader.number(iarg, rotates ? "move rotate" : "move linear");
    by_variables = by_variables || !speed.variable.empty();
    const bool in_plane = rotates == (c == 2);
    if (domain->dimension == 2 && !in_plane && (speed.value != 0.0 || !speed.variable.empty()))
      error->all(FLERR, iarg, "{} move {} must be 0 {} {} in 2 dimensions, got {}", command,
                 rotates ? "rotate" : "linear", rotates ? "about" : "along", "xyz"[c], arg[iarg]);
  }
}

bool WallMotion::same_as(const WallMotion &other) const
{
  const auto same = [](const Speed &a, const Speed &b) {
    return a.value == b.value && a.variable == b.variable;
  };
  if (pose.moves != other.pose.moves || moved != other.moved || turned != other.turned)
    return false;
  double mine[apf::WallPose::state_size], others[apf::WallPose::state_size];
  pose.write(mine);
  other.pose.write(others);
  return std::equal(linear, linear + 3, other.linear, same) &&
      std::equal(turn, turn + 3, other.turn, same) && std::equal(mine, std::end(mine), others);
}

void WallMotion::find_variables()
{
  for (Speed *speeds : {linear, turn})
    for (int c = 0; c < 3; c++) {
      Speed &speed = speeds[c];
      if (speed.variable.empty()) continue;
      speed.index = input->variable->find(speed.variable.c_str());
      if (speed.index < 0)
        error->all(FLERR, Error::NOLASTLINE, "{} {} move: variable {} does not exist", command, id,
                   speed.variable);
      if (!input->variable->equalstyle(speed.index))
        error->all(FLERR, Error::NOLASTLINE, "{} {} move: variable {} must be of equal style",
                   command, id, speed.variable);
    }
}

void WallMotion::init(const char *id_in)
{
  id = id_in;
  find_variables();
  if (!by_variables) take_speeds();
}

void WallMotion::take_speeds()
{
  if (!pose.moves) return;
  if (by_variables) {
    find_variables();    // a run without setup finds those that the script has made since
    modify->clearstep_compute();
  }
  double values[2][3];
  for (int s = 0; s < 2; s++)
    for (int c = 0; c < 3; c++) {
      const Speed &speed = s ? turn[c] : linear[c];
      values[s][c] = speed.variable.empty() ? speed.value
                                            : input->variable->compute_equal(speed.index);
      if (!std::isfinite(values[s][c]))
        error->all(FLERR, Error::NOLASTLINE, "{} move: variable {} is {} at step {}", command,
                   speed.variable, values[s][c], update->ntimestep);
    }
  if (by_variables) modify->addstep_compute(update->ntimestep + 1);
  pose.velocity = {values[0][0], values[0][1], values[0][2]};
  pose.spin = {values[1][0], values[1][1], values[1][2]};
}

double WallMotion::fastest(double reach) const
{
  if (!pose.moves) return 0.0;
  return std::sqrt(norm2(pose.velocity)) + reach * std::sqrt(norm2(pose.spin));
}
