#include "contact_keywords.h"

#include "argument_reader.h"
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

constexpr double rounding = 1.0e-12;

// Reads words one after another; errors name command, keyword, value and range.
class Words {
 public:
  Words(LAMMPS *lmp, const char *command, int narg, char **arg, int &iarg, int offset) :
      lmp(lmp), command(command), reader(lmp, command, arg, offset), narg(narg), arg(arg),
      iarg(iarg), offset(offset)
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

  double number(const std::string &keyword, const Range &range)
  {
    if (at_end()) refuse(fmt::format("{} is missing; it must be {}", keyword, range.words()));
    return reader.number(iarg++, keyword, range);
  }

  int choice(const std::string &keyword, std::initializer_list<const char *> words)
  {
    need(1, keyword);
    return reader.choice(iarg++, keyword, words);
  }
  bool yes(const std::string &keyword)
  {
    need(1, keyword);
    return reader.yes(iarg++, keyword);
  }

  [[noreturn]] void refuse(const std::string &message) const
  {
    lmp->error->all(FLERR, offset + (at_end() ? narg - 1 : iarg), "{} {}", command, message);
  }

 private:
  LAMMPS *lmp;
  const char *command;
  ArgumentReader reader;
  int narg;
  char **arg;
  int &iarg;
  int offset;
};

void parse_damping(Words &words, apf::ContactModel &model)
{
  switch (words.choice("damping", {"tsuji", "alpha", "none"})) {
    case 0:
      model.alpha = apf::damping_from_restitution(
          words.number("damping tsuji restitution", Range::above(0.0, 1.0)));
      break;
    case 1:
      model.alpha = words.number("damping alpha", Range::from(0.0));
      break;
    default:
      model.alpha = 0.0;
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
    model.mu = words.number("sliding mu", Range::from(0.0));
  } else if (words.is("twisting")) {
    words.skip();
    model.twisting = words.yes("twisting");
  } else if (words.is("rolling")) {
    words.skip();
    model.theta_crit = words.number("rolling theta_crit", Range::from(0.0, 1.0));
    if (words.is_number()) model.zeta = words.number("rolling zeta", Range::from(0.0));
  } else if (words.is("break")) {
    words.skip();
    constexpr apf::Break ends[] = {apf::Break::displacement, apf::Break::force, apf::Break::touch};
    model.neck_end = ends[words.choice("break", {"displacement", "force", "touch"})];
  } else if (words.is("scale_stiffness")) {
    words.skip();
    model.stiffness_scale = words.number("scale_stiffness", Range::above(0.0, 1.0));
  } else {
    return false;
  }
  return true;
}

void parse_bridge(Words &words, apf::BridgeModel &bridge)
{
  bridge.volume_ratio = words.number("bridge volume ratio l", Range::above(0.0, 1.0));
  bridge.sigma = words.number("bridge surface tension sigma", Range::above(0.0));
  bridge.theta =
      words.number("bridge contact angle theta", Range::from(0.0, 89.0)) * apf::pi / 180.0;
  bridge.mu = words.number("bridge viscosity mu", Range::from(0.0));
  if (words.is_number())
    bridge.roughness = words.number("bridge least gap hmin over R", Range::from(1e-12, 1.0));
}

double parse_wet_gamma(Words &words)
{
  const double x = words.number("wet_gamma x_ratio", Range::above(0.0));
  const double Ai = words.number("wet_gamma A_i", Range::above(0.0));
  const double Aj = words.number("wet_gamma A_j", Range::above(0.0));
  const double Af = words.number("wet_gamma A_f", Range::from(0.0));
  const double share = apf::wet_surface_energy(x, Ai, Aj, Af);
  if (share < 0.0)
    words.refuse(fmt::format("wet_gamma A_f = {} lies between A_i = {} and A_j = {}: surfaces that "
                             "repel each other in the liquid cannot be modelled",
                             Af, Ai, Aj));
  const double of_wetting = apf::largest_wetting_hamaker(Ai, Aj);
  if (Af > of_wetting * (1.0 + rounding))
    words.refuse(fmt::format("wet_gamma A_f must be in [0, (sqrt(A_i) + sqrt(A_j))^2 = {:.6g}], "
                             "got {} with A_i = {} and A_j = {}: a liquid of larger A_f does not "
                             "wet the bodies",
                             of_wetting, Af, Ai, Aj));
  if (share > 1.0 + rounding)
    words.refuse(fmt::format("wet_gamma x_ratio must be >= {:.6g}, got {} with A_i = {}, A_j = {} "
                             "and A_f = {}: liquid would raise the surface energy",
                             x * std::sqrt(share), x, Ai, Aj, Af));
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
    bridge.forming = words.choice("form", {"contact", "film"}) == 0 ? apf::Forming::contact
                                                                    : apf::Forming::film;
  } else if (words.is("capillary")) {
    words.skip();
    bridge.capillary = words.choice("capillary", {"maugis", "willett"}) == 0
        ? apf::Capillary::maugis
        : apf::Capillary::willett;
  } else if (words.is("tangential")) {
    words.skip();
    bridge.tangential = words.yes("tangential");
  } else if (words.is("wet_gamma")) {
    words.skip();
    bridge.wet_share = parse_wet_gamma(words);
  } else if (words.is("inventory")) {
    words.skip();
    bridge.intake = words.number("inventory share", Range::above(0.0, 1.0));
    if (words.is("even") || words.is("origin"))
      bridge.sharing = words.choice("inventory split", {"even", "origin"}) == 0
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
    coeff.material.E = words.number("Young's modulus E", Range::above(0.0));
    coeff.material.nu = words.number("Poisson's ratio nu", Range::above(-1.0, 0.5));
    coeff.material.gamma = words.number("surface energy gamma", Range::from(0.0));
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
