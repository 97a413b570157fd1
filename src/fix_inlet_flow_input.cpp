// The words of fix inlet/flow.

#include "argument_reader.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_inlet_flow.h"
#include "given_once.h"
#include "modify.h"
#include "random_mars.h"

#include "flow/di_felice.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

// ID group inlet/flow PLANE POSITION FIELD-ID keywords
void FixInletFlow::parse(int narg, char **arg)
{
  if (narg < 6) utils::missing_cmd_args(FLERR, "fix inlet/flow", error);
  dim = parse_axis(3, arg, "plane", sign);
  const ArgumentReader reader(lmp, command, arg);
  position = reader.number(4, "position");
  field_id = arg[5];
  for (auto &side : window) side[0] = side[1] = NAN;

  GivenOnce given(lmp, command);
  int iarg = 6;
  while (iarg < narg) {
    const std::string word = arg[iarg];
    if (word != "outlet") given.add(word, iarg);
    if (word == "window")
      iarg = parse_window(iarg, narg, arg);
    else if (word == "diameter")
      iarg = parse_diameter(iarg, narg, arg);
    else if (word == "outlet")
      iarg = parse_outlet(iarg, narg, arg);
    else
      iarg = parse_number(iarg, narg, arg);
  }
  check_required();
}

/* ----------------------------------------------------------------------
   keywords with one number
------------------------------------------------------------------------- */

int FixInletFlow::parse_number(int iarg, int narg, char **arg)
{
  const std::string word = arg[iarg];
  const ArgumentReader reader(lmp, command, arg);
  auto need_value = [&] {
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix inlet/flow " + word, error);
  };
  auto real = [&](const Range &range) {
    need_value();
    return reader.number(iarg + 1, word, range);
  };
  auto integer = [&](const Range &range) {
    need_value();
    return reader.integer(iarg + 1, word, range);
  };

  if (word == "concentration") {
    concentration = real(Range::above(0.0, apf::max_concentration));
  } else if (word == "number") {
    number = real(Range::above(0.0));
  } else if (word == "every") {
    every = integer(Range::from(1));
  } else if (word == "density") {
    density = real(Range::above(0.0));
  } else if (word == "gap") {
    gap = real(Range::from(0.0));
  } else if (word == "attempts") {
    attempts = integer(Range::from(1));
  } else if (word == "seed") {
    seed = integer(Range::from(1, 900000000));
    random = std::make_unique<RanMars>(lmp, seed);
  } else if (word == "type") {
    need_value();
    // a number, or the name of one by labelmap
    const bool named = atom->labelmapflag && !utils::is_integer(arg[iarg + 1]);
    type = named ? utils::expand_type_int(FLERR, arg[iarg + 1], Atom::ATOM, lmp)
                 : integer(Range::from(1, atom->ntypes));
  } else {
    error->all(FLERR, iarg,
               "{} keyword must be concentration, number, every, diameter, density, type, seed, "
               "window, gap, attempts or outlet, got {}",
               command, word);
  }
  return iarg + 2;
}

/* ---------------------------------------------------------------------- */

// x, y, z or, against the axis, -x, -y, -z
int FixInletFlow::parse_axis(int iarg, char **arg, const char *what, double &direction)
{
  const char *word = arg[iarg];
  direction = word[0] == '-' ? -1.0 : 1.0;
  const char *letter = word[0] == '-' ? word + 1 : word;
  const int axes = domain->dimension;
  for (int axis = 0; axis < axes; axis++)
    if (letter[0] == "xyz"[axis] && letter[1] == '\0') return axis;
  error->all(FLERR, iarg, "{} {} must be {}, got {}", command, what,
             axes == 2 ? "x, -x, y or -y in a 2d simulation" : "x, -x, y, -y, z or -z", word);
  return 0;
}

// bounds along the axes across the plane, in the order x, y, z; NULL leaves the box's
int FixInletFlow::parse_window(int iarg, int narg, char **arg)
{
  const int axes = domain->dimension - 1;
  if (iarg + 1 + 2 * axes > narg) utils::missing_cmd_args(FLERR, "fix inlet/flow window", error);
  const ArgumentReader reader(lmp, command, arg);
  for (int k = 0; k < axes; k++) {
    const int at = iarg + 1 + 2 * k;
    for (int end = 0; end < 2; end++)
      if (strcmp(arg[at + end], "NULL") != 0)
        window[k][end] = reader.number(at + end, "window bound");
    if (window[k][1] <= window[k][0])
      error->all(FLERR, at + 1, "{} window upper bound must be > lower bound {}, got {}", command,
                 arg[at], arg[at + 1]);
  }
  return iarg + 1 + 2 * axes;
}

/* ----------------------------------------------------------------------
   diameter D | uniform LO HI | lognormal MEDIAN GSD [LO HI] | poly number|volume N d f ...
------------------------------------------------------------------------- */

int FixInletFlow::parse_diameter(int iarg, int narg, char **arg)
{
  if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix inlet/flow diameter", error);
  const std::string law = arg[iarg + 1];
  auto need = [&](int words) {
    if (iarg + words > narg)
      utils::missing_cmd_args(FLERR, "fix inlet/flow diameter " + law, error);
  };
  if (law == "uniform") {
    need(4);
    const double lo = positive(iarg + 2, arg, "diameter uniform LO"),
                 hi = positive(iarg + 3, arg, "diameter uniform HI");
    check_order(iarg + 3, arg, "uniform", lo, hi);
    diameters = apf::UniformDiameters{lo, hi};
    return iarg + 4;
  }
  if (law == "lognormal") return parse_lognormal(iarg, narg, arg);
  if (law == "poly") return parse_list(iarg, narg, arg);
  diameters = apf::OneDiameter{positive(iarg + 1, arg, "diameter")};
  return iarg + 2;
}

// cut at three geometric standard deviations if not told
int FixInletFlow::parse_lognormal(int iarg, int narg, char **arg)
{
  if (iarg + 4 > narg) utils::missing_cmd_args(FLERR, "fix inlet/flow diameter lognormal", error);
  apf::LognormalDiameters law{};
  law.median = positive(iarg + 2, arg, "diameter lognormal median");
  const ArgumentReader reader(lmp, command, arg);
  law.gsd = reader.number(iarg + 3, "diameter lognormal geometric deviation", Range::above(1.0));
  law.lo = law.median / std::pow(law.gsd, 3);
  law.hi = law.median * std::pow(law.gsd, 3);
  diameters = law;
  if (iarg + 4 == narg || !utils::is_double(arg[iarg + 4])) return iarg + 4;

  if (iarg + 6 > narg) utils::missing_cmd_args(FLERR, "fix inlet/flow diameter lognormal", error);
  law.lo = positive(iarg + 4, arg, "diameter lognormal LO");
  law.hi = positive(iarg + 5, arg, "diameter lognormal HI");
  check_order(iarg + 5, arg, "lognormal", law.lo, law.hi);
  if (law.kept() < 0.01)
    error->all(FLERR, iarg + 4,
               "{} diameter bounds {} and {} must keep at least 1 % of the lognormal distribution "
               "with median {} and deviation {}, got {:.3g} %",
               command, arg[iarg + 4], arg[iarg + 5], arg[iarg + 2], arg[iarg + 3],
               100.0 * law.kept());
  diameters = law;
  return iarg + 6;
}

int FixInletFlow::parse_list(int iarg, int narg, char **arg)
{
  if (iarg + 4 > narg) utils::missing_cmd_args(FLERR, "fix inlet/flow diameter poly", error);
  const ArgumentReader reader(lmp, command, arg);
  const bool by_volume = reader.choice(iarg + 2, "diameter poly", {"number", "volume"}) == 1;
  const int n = reader.integer(iarg + 3, "diameter poly number of diameters");
  if (n < 1 || n > (narg - iarg - 4) / 2)
    error->all(FLERR, iarg + 3,
               "{} diameter poly takes from 1 diameter on, each with its fraction, got {} and {} "
               "further words",
               command, n, narg - iarg - 4);
  std::vector<double> d, fraction;
  for (int k = 0; k < n; k++) {
    d.push_back(positive(iarg + 4 + 2 * k, arg, "diameter poly d"));
    fraction.push_back(positive(iarg + 5 + 2 * k, arg, "diameter poly fraction"));
  }
  diameters = apf::ListedDiameters::of(std::move(d), std::move(fraction), by_volume);
  return iarg + 4 + 2 * n;
}

double FixInletFlow::positive(int iarg, char **arg, const char *what)
{
  return ArgumentReader(lmp, command, arg).number(iarg, what, Range::above(0.0));
}

void FixInletFlow::check_order(int iarg, char **arg, const char *law, double lo, double hi)
{
  if (!(lo < hi))
    error->all(FLERR, iarg, "{} diameter {} HI must be > LO {}, got {}", command, law,
               arg[iarg - 1], arg[iarg]);
}

/* ---------------------------------------------------------------------- */

int FixInletFlow::parse_outlet(int iarg, int narg, char **arg)
{
  if (iarg + 3 > narg) utils::missing_cmd_args(FLERR, "fix inlet/flow outlet", error);
  Outlet outlet{};
  outlet.dim = parse_axis(iarg + 1, arg, "outlet", outlet.sign);
  outlet.position = ArgumentReader(lmp, command, arg).number(iarg + 2, "outlet position");
  if (outlet.dim == dim && outlet.sign * (position - outlet.position) >= 0.0)
    error->all(
        FLERR, iarg + 2,
        "{} outlet at {}, which deletes what is beyond it along {}, would delete what enters "
        "at {}",
        command, arg[iarg + 2], arg[iarg + 1], arg[4]);
  outlets.push_back(outlet);
  return iarg + 3;
}

/* ---------------------------------------------------------------------- */

void FixInletFlow::check_required() const
{
  auto require = [this](bool given, const char *word) {
    if (!given) error->all(FLERR, "{} requires keyword {}", command, word);
  };
  require(concentration > 0.0 || number > 0.0, "concentration or number");
  if (concentration > 0.0 && number > 0.0)
    error->all(FLERR, "{} takes keyword concentration or number, not both", command);
  require(smallest() > 0.0, "diameter");
  require(density > 0.0, "density");
  require(type > 0, "type");
  require(random != nullptr, "seed");
}

/* ----------------------------------------------------------------------
   plane and window in the box as it is when a run begins
------------------------------------------------------------------------- */

void FixInletFlow::check_plane() const
{
  static const char axes[] = "xyz";
  const double *lo = domain->boxlo, *hi = domain->boxhi;
  auto shrinks = [this](int axis) {
    return domain->boundary[axis][0] > 1 || domain->boundary[axis][1] > 1;
  };
  if (!shrinks(dim)) {
    if (position < lo[dim] || position > hi[dim])
      error->all(FLERR, Error::NOLASTLINE,
                 "{} plane {} = {} must lie within the box, which is {} to {}", command, axes[dim],
                 position, lo[dim], hi[dim]);
    if (!domain->periodicity[dim] && position == (sign > 0.0 ? hi[dim] : lo[dim]))
      error->all(FLERR, Error::NOLASTLINE,
                 "{} particles that enter along {}{} at {} would leave the box; write {}{}",
                 command, sign > 0.0 ? "" : "-", axes[dim], position, sign > 0.0 ? "-" : "",
                 axes[dim]);
  }
  for (const auto &outlet : outlets) {
    const int axis = outlet.dim;
    if (axis == dim && domain->periodicity[axis] && comm->me == 0)
      error->warning(FLERR,
                     "{} {}: the box is periodic in {}, so that what comes to the outlet at {} {} "
                     "touches what has entered; use boundary f there",
                     command, id, axes[axis], axes[axis], outlet.position);
    if (!shrinks(axis) && (outlet.position < lo[axis] || outlet.position > hi[axis]))
      error->all(FLERR, Error::NOLASTLINE,
                 "{} outlet {} = {} must lie within the box, which is {} to {}", command,
                 axes[axis], outlet.position, lo[axis], hi[axis]);
  }

  const auto plane = rectangle();
  for (int k = 0; k < 2; k++) {
    if (plane.flat(k) && domain->dimension == 2) continue;
    const int axis = plane.across[k];
    const bool follows_box = std::isnan(window[k][0]) || std::isnan(window[k][1]);
    if (shrinks(axis)) {
      if (follows_box)
        error->all(FLERR, Error::NOLASTLINE,
                   "{} needs keyword window with bounds along {}, where the box is shrink-wrapped",
                   command, axes[axis]);
    } else if (plane.lo[k] < lo[axis] || plane.hi[k] > hi[axis])
      error->all(FLERR, Error::NOLASTLINE,
                 "{} window along {} must lie within the box, {} to {}, got {} to {}", command,
                 axes[axis], lo[axis], hi[axis], plane.lo[k], plane.hi[k]);
    if (!(largest() < plane.width(k)))
      error->all(FLERR, Error::NOLASTLINE,
                 "{} particles must be smaller than the window, which is {} wide along {}, got a "
                 "diameter of {}",
                 command, plane.width(k), axes[axis], largest());
  }
}

/* ---------------------------------------------------------------------- */

void FixInletFlow::warn_of_equal_seeds()
{
  if (comm->me != 0) return;
  for (const auto &fix : modify->get_fix_by_style("^inlet/flow")) {
    if (fix == this) return;    // the later one of two tells
    const auto *other = dynamic_cast<FixInletFlow *>(fix);
    if (other && other->seed == seed)
      error->warning(FLERR,
                     "{} {} and fix {} have the same seed {}: places and diameters of their "
                     "particles are not independent; give one of them another",
                     command, id, other->id, seed);
  }
}
