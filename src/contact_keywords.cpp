#include "contact_keywords.h"

#include "error.h"
#include "fmt/format.h"
#include "given_once.h"
#include "material_file.h"
#include "tokenizer.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

namespace {

constexpr double infinity = INFINITY;
constexpr double largest = 1.0e30;    // products of a few numbers are finite yet
constexpr double rounding = 1.0e-12;

// Reads words one after another; errors name command, keyword, value and range.
class Words {
 public:
  Words(LAMMPS *lmp, const char *command, int narg, char **arg, int &iarg, int offset) :
      lmp(lmp), command(command), narg(narg), arg(arg), iarg(iarg), offset(offset)
  {
  }

  bool at_end() const { return iarg >= narg; }
  bool is(const char *word) const { return !at_end() && strcmp(arg[iarg], word) == 0; }
  bool is_number() const { return !at_end() && utils::is_double(arg[iarg]); }
  void skip() { iarg++; }

  void need(int n, const std::string &keyword) const
  {
    if (iarg + n > narg) refuse(fmt::format("{}: missing argument(s)", keyword));
  }

  const char *text(const std::string &keyword)
  {
    need(1, keyword);
    return arg[iarg++];
  }

  double number(const std::string &keyword, double low, bool low_allowed, double high)
  {
    const std::string range = std::isinf(high)
        ? fmt::format("{} {}", low_allowed ? ">=" : ">", low)
        : fmt::format("in {}{}, {}]", low_allowed ? '[' : '(', low, high);
    if (at_end()) refuse(fmt::format("{} is missing; it must be {}", keyword, range));
    if (!utils::is_double(arg[iarg]))
      lmp->error->all(FLERR, offset + iarg, "{} {} must be a number, got {}", command, keyword,
                      arg[iarg]);
    const double value = utils::numeric(FLERR, arg[iarg], false, lmp);
    if (!(low_allowed ? value >= low : value > low) || !(value <= high))
      lmp->error->all(FLERR, offset + iarg, "{} {} must be {}, got {}", command, keyword, range,
                      arg[iarg]);
    if (value > largest)
      lmp->error->all(FLERR, offset + iarg, "{} {} must be <= {}, got {}", command, keyword,
                      largest, arg[iarg]);
    iarg++;
    return value;
  }

  [[noreturn]] void refuse(const std::string &message) const
  {
    lmp->error->all(FLERR, offset + (at_end() ? narg - 1 : iarg), "{} {}", command, message);
  }

  // the same where the word is none of those that the message lists
  [[noreturn]] void refuse_word(const std::string &message) const
  {
    refuse(fmt::format("{}, got {}", message, arg[iarg]));
  }

 private:
  LAMMPS *lmp;
  const char *command;
  int narg;
  char **arg;
  int &iarg;
  int offset;
};

void parse_damping(Words &words, apf::ContactModel &model)
{
  if (words.is("tsuji")) {
    words.skip();
    model.alpha =
        apf::damping_from_restitution(words.number("damping tsuji restitution", 0.0, false, 1.0));
  } else if (words.is("alpha")) {
    words.skip();
    model.alpha = words.number("damping alpha", 0.0, true, infinity);
  } else if (words.is("none")) {
    words.skip();
    model.alpha = 0.0;
  } else {
    words.need(1, "damping");
    words.refuse_word("damping must be tsuji, alpha or none");
  }
}

// true if the word was a keyword of the contact law
bool parse_keyword(Words &words, apf::ContactModel &model)
{
  if (words.is("damping")) {
    words.skip();
    parse_damping(words, model);
  } else if (words.is("sliding")) {
    words.skip();
    model.mu = words.number("sliding mu", 0.0, true, infinity);
  } else if (words.is("twisting")) {
    words.skip();
    words.need(1, "twisting");
    if (!words.is("yes") && !words.is("no")) words.refuse_word("twisting must be yes or no");
    model.twisting = words.is("yes");
    words.skip();
  } else if (words.is("rolling")) {
    words.skip();
    model.theta_crit = words.number("rolling theta_crit", 0.0, true, 1.0);
    if (words.is_number()) model.zeta = words.number("rolling zeta", 0.0, true, infinity);
  } else if (words.is("break")) {
    words.skip();
    words.need(1, "break");
    if (words.is("displacement"))
      model.neck_end = apf::Break::displacement;
    else if (words.is("force"))
      model.neck_end = apf::Break::force;
    else if (words.is("touch"))
      model.neck_end = apf::Break::touch;
    else
      words.refuse_word("break must be displacement, force or touch");
    words.skip();
  } else if (words.is("scale_stiffness")) {
    words.skip();
    model.stiffness_scale = words.number("scale_stiffness", 0.0, false, 1.0);
  } else {
    return false;
  }
  return true;
}

// true at one of two words, which is then passed; keyword: what it belongs to
bool parse_choice(Words &words, const std::string &keyword, const char *first, const char *second)
{
  words.need(1, keyword);
  const bool is_first = words.is(first);
  if (!is_first && !words.is(second))
    words.refuse_word(fmt::format("{} must be {} or {}", keyword, first, second));
  words.skip();
  return is_first;
}

void parse_bridge(Words &words, apf::BridgeModel &bridge)
{
  bridge.volume_ratio = words.number("bridge volume ratio l", 0.0, false, 1.0);
  bridge.sigma = words.number("bridge surface tension sigma", 0.0, false, infinity);
  bridge.theta = words.number("bridge contact angle theta", 0.0, true, 89.0) * apf::pi / 180.0;
  bridge.mu = words.number("bridge viscosity mu", 0.0, true, infinity);
  if (words.is_number())
    bridge.roughness = words.number("bridge least gap hmin over R", 1e-12, true, 1.0);
}

double parse_wet_gamma(Words &words)
{
  const double x = words.number("wet_gamma x_ratio", 0.0, false, infinity);
  const double Ai = words.number("wet_gamma A_i", 0.0, false, infinity);
  const double Aj = words.number("wet_gamma A_j", 0.0, false, infinity);
  const double Af = words.number("wet_gamma A_f", 0.0, true, infinity);
  const double share = apf::wet_surface_energy(x, Ai, Aj, Af);
  if (share < 0.0)
    words.refuse(fmt::format("wet_gamma A_f = {} lies between A_i = {} and A_j = {}: surfaces that "
                             "repel each other in the liquid cannot be modelled",
                             Af, Ai, Aj));
  const double of_wetting = apf::largest_wetting_hamaker(Ai, Aj);
  if (Af > of_wetting * (1.0 + rounding))
    words.refuse(fmt::format("wet_gamma A_f must be in [0, (sqrt(A_i) + sqrt(A_j))^2 = {:.6g}], "
                             "got {}: a liquid of larger A_f does not wet the bodies",
                             of_wetting, Af));
  if (share > 1.0 + rounding)
    words.refuse(fmt::format("wet_gamma x_ratio must be >= {:.6g}, got {}: liquid would raise the "
                             "surface energy",
                             x * std::sqrt(share), x));
  return std::min(share, 1.0);
}

// true if the word was a keyword of liquid bridges
bool parse_liquid(Words &words, apf::BridgeModel &bridge)
{
  if (words.is("bridge")) {
    words.skip();
    parse_bridge(words, bridge);
  } else if (words.is("form")) {
    words.skip();
    bridge.forming = parse_choice(words, "form", "contact", "film") ? apf::Forming::contact
                                                                    : apf::Forming::film;
  } else if (words.is("capillary")) {
    words.skip();
    bridge.capillary = parse_choice(words, "capillary", "maugis", "willett")
        ? apf::Capillary::maugis
        : apf::Capillary::willett;
  } else if (words.is("tangential")) {
    words.skip();
    bridge.tangential = parse_choice(words, "tangential", "yes", "no");
  } else if (words.is("wet_gamma")) {
    words.skip();
    bridge.wet_share = parse_wet_gamma(words);
  } else if (words.is("inventory")) {
    words.skip();
    bridge.intake = words.number("inventory share", 0.0, false, 1.0);
    if (words.is("even") || words.is("origin"))
      bridge.sharing = parse_choice(words, "inventory split", "even", "origin")
          ? apf::Sharing::even
          : apf::Sharing::origin;
  } else {
    return false;
  }
  return true;
}

void check_bridge(const Words &words, const apf::BridgeModel &bridge)
{
  const apf::BridgeModel none;
  if (!bridge.present()) {
    const bool named = bridge.forming != none.forming || bridge.capillary != none.capillary ||
        bridge.tangential || bridge.wet_share != 1.0 || bridge.inventory();
    if (named)
      words.refuse("keywords form, capillary, tangential, wet_gamma and inventory need keyword "
                   "bridge l sigma theta mu");
    return;
  }
  if (bridge.capillary != apf::Capillary::willett) return;
  // of two equal spheres, the largest there is
  const double volume = bridge.largest_volume(1.0);
  if (volume > apf::largest_willett)
    words.refuse(fmt::format("capillary willett is fitted for bridge volumes up to {} r^3 between "
                             "equal spheres: bridge l must be <= {:.4g}, got {:.4g}",
                             apf::largest_willett,
                             bridge.volume_ratio * apf::largest_willett / volume,
                             bridge.volume_ratio));
  if (bridge.theta > apf::largest_willett_angle)
    words.refuse(fmt::format("capillary willett is fitted for contact angles up to 50 degrees: "
                             "bridge theta must be <= 50, got {:.4g}",
                             bridge.theta * 180.0 / apf::pi));
}

}    // namespace

/* ---------------------------------------------------------------------- */

bool LAMMPS_NS::is_contact_keyword(const char *word)
{
  const auto all = Tokenizer(contact_keywords, ", ").as_vector();
  return std::find(all.begin(), all.end(), word) != all.end();
}

/* ---------------------------------------------------------------------- */

ContactCoeff LAMMPS_NS::parse_contact(LAMMPS *lmp, const char *command, int narg, char **arg,
                                      int &iarg, int offset)
{
  Words words(lmp, command, narg, arg, iarg, offset);
  ContactCoeff coeff;
  words.need(1, "contact law");
  if (words.is("jkr")) {
    words.skip();
    coeff.material.E = words.number("Young's modulus E", 0.0, false, infinity);
    coeff.material.nu = words.number("Poisson's ratio nu", -1.0, false, 0.5);
    coeff.material.gamma = words.number("surface energy gamma", 0.0, true, infinity);
  } else if (words.is("material")) {
    words.skip();
    words.need(2, "material");
    const char *file = words.text("material FILE");
    const char *name = words.text("material NAME");
    coeff.material = apf::read_material(lmp, file, name, command, offset + iarg - 2);
  } else {
    words.refuse(fmt::format("contact law must be jkr or material, got {}", arg[iarg]));
  }

  GivenOnce given(lmp, command);
  bool known = true;
  while (known && !words.at_end()) {
    given.add(arg[iarg], offset + iarg);
    known = parse_keyword(words, coeff.model) || parse_liquid(words, coeff.bridge);
  }

  check_bridge(words, coeff.bridge);
  coeff.model.surface = apf::interface(coeff.material, coeff.material);
  coeff.model.surface.gamma *= coeff.bridge.wet_share;
  if (coeff.model.twisting && !coeff.model.sliding())
    words.refuse("twisting yes needs sliding mu > 0, which limits its torque");
  if (coeff.model.rolling() && !coeff.model.adhesive())
    words.refuse("rolling needs adhesion, surface energy gamma > 0: its moment is 4 F_C xi");
  return coeff;
}

/* ---------------------------------------------------------------------- */

ContactCoeff ContactCoeff::mixed(const ContactCoeff &i, const ContactCoeff &j)
{
  ContactCoeff c;
  c.material = i.material;    // not used: the surface is that of both
  c.bridge = apf::BridgeModel::mixed(i.bridge, j.bridge);
  c.model.surface = apf::interface(i.material, j.material);
  c.model.surface.gamma *= c.bridge.wet_share;
  c.model.alpha = std::sqrt(i.model.alpha * j.model.alpha);
  c.model.mu = std::sqrt(i.model.mu * j.model.mu);
  c.model.twisting = i.model.twisting && j.model.twisting;
  c.model.theta_crit = std::sqrt(i.model.theta_crit * j.model.theta_crit);
  if (!c.model.adhesive()) c.model.theta_crit = 0.0;
  c.model.zeta = std::sqrt(i.model.zeta * j.model.zeta);
  c.model.neck_end = std::max(i.model.neck_end, j.model.neck_end);
  c.model.stiffness_scale = std::sqrt(i.model.stiffness_scale * j.model.stiffness_scale);
  return c;
}

/* ---------------------------------------------------------------------- */

std::string ContactCoeff::words() const
{
  std::string text = fmt::format("jkr {:.16g} {:.16g} {:.16g} damping alpha {:.16g}", material.E,
                                 material.nu, material.gamma, model.alpha);
  if (model.sliding()) text += fmt::format(" sliding {:.16g}", model.mu);
  if (model.twisting) text += " twisting yes";
  if (model.rolling())
    text += fmt::format(" rolling {:.16g} {:.16g}", model.theta_crit, model.zeta);
  if (model.neck_end == apf::Break::force) text += " break force";
  if (model.neck_end == apf::Break::touch) text += " break touch";
  if (model.stiffness_scale != 1.0)
    text += fmt::format(" scale_stiffness {:.16g}", model.stiffness_scale);
  if (!bridge.present()) return text;
  text += fmt::format(" bridge {:.16g} {:.16g} {:.16g} {:.16g} {:.16g}", bridge.volume_ratio,
                      bridge.sigma, bridge.theta * 180.0 / apf::pi, bridge.mu, bridge.roughness);
  if (bridge.forming == apf::Forming::film) text += " form film";
  if (bridge.capillary == apf::Capillary::willett) text += " capillary willett";
  if (bridge.tangential) text += " tangential yes";
  // Hamaker constants that come to the same
  if (bridge.wet_share == 0.0)
    text += " wet_gamma 1 1 1 1";
  else if (bridge.wet_share != 1.0)
    text += fmt::format(" wet_gamma {:.16g} 1 1 0", std::sqrt(1.0 / bridge.wet_share));
  if (bridge.inventory())
    text += fmt::format(" inventory {:.16g} {}", bridge.intake,
                        bridge.sharing == apf::Sharing::even ? "even" : "origin");
  return text;
}
