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

// What the numbers of a law may be, in scripts and in restart files.
namespace range {
  constexpr Range modulus = Range::above(0.0);
  constexpr Range poisson = Range::above(-1.0, 0.5);
  constexpr Range surface_energy = Range::from(0.0);
  constexpr Range damping = Range::from(0.0);
  constexpr Range friction = Range::from(0.0);
  constexpr Range rolling_angle = Range::from(0.0, 1.0);
  constexpr Range rolling_damping = Range::from(0.0);
  constexpr Range share = Range::above(0.0, 1.0);    // of stiffness, volume, liquid
  constexpr Range share_or_none = Range::from(0.0, 1.0);
  constexpr Range tension = Range::above(0.0);
  constexpr Range contact_angle = Range::from(0.0, 89.0);    // [degrees]
  constexpr Range viscosity = Range::from(0.0);
  constexpr Range least_gap = Range::from(1e-12, 1.0);
}    // namespace range

double radians(double degrees)
{
  return degrees * apf::pi / 180.0;
}

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
      model.alpha = words.number("damping alpha", range::damping);
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
    model.mu = words.number("sliding mu", range::friction);
  } else if (words.is("twisting")) {
    words.skip();
    model.twisting = words.yes("twisting");
  } else if (words.is("rolling")) {
    words.skip();
    model.theta_crit = words.number("rolling theta_crit", range::rolling_angle);
    if (words.is_number()) model.zeta = words.number("rolling zeta", range::rolling_damping);
  } else if (words.is("break")) {
    words.skip();
    constexpr apf::Break ends[] = {apf::Break::displacement, apf::Break::force, apf::Break::touch};
    model.neck_end = ends[words.choice("break", {"displacement", "force", "touch"})];
  } else if (words.is("scale_stiffness")) {
    words.skip();
    model.stiffness_scale = words.number("scale_stiffness", range::share);
  } else {
    return false;
  }
  return true;
}

void parse_bridge(Words &words, apf::BridgeModel &bridge)
{
  bridge.volume_ratio = words.number("bridge volume ratio l", range::share);
  bridge.sigma = words.number("bridge surface tension sigma", range::tension);
  bridge.theta = radians(words.number("bridge contact angle theta", range::contact_angle));
  bridge.mu = words.number("bridge viscosity mu", range::viscosity);
  if (words.is_number())
    bridge.roughness = words.number("bridge least gap hmin over R", range::least_gap);
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
    bridge.intake = words.number("inventory share", range::share);
    if (words.is("even") || words.is("origin"))
      bridge.sharing = words.choice("inventory split", {"even", "origin"}) == 0
          ? apf::Sharing::even
          : apf::Sharing::origin;
  } else {
    return false;
  }
  return true;
}

// what is wrong with the numbers together; empty if nothing is
std::string contradiction(const apf::BridgeModel &bridge)
{
  const apf::BridgeModel none;
  if (!bridge.present()) {
    const bool named = bridge.forming != none.forming || bridge.capillary != none.capillary ||
        bridge.tangential || bridge.wet_share != 1.0 || bridge.inventory();
    return named ? "keywords form, capillary, tangential, wet_gamma and inventory need keyword "
                   "bridge l sigma theta mu"
                 : "";
  }
  if (bridge.capillary != apf::Capillary::willett) return "";
  // of two equal spheres, the largest there is
  const double volume = bridge.largest_volume(1.0);
  if (volume > apf::largest_willett)
    return fmt::format("capillary willett is fitted for bridge volumes up to {} r^3 between "
                       "equal spheres: bridge l must be <= {:.4g}, got {:.4g}",
                       apf::largest_willett, bridge.volume_ratio * apf::largest_willett / volume,
                       bridge.volume_ratio);
  if (bridge.theta > apf::largest_willett_angle)
    return fmt::format("capillary willett is fitted for contact angles up to 50 degrees: "
                       "bridge theta must be <= 50, got {:.4g}",
                       bridge.theta * 180.0 / apf::pi);
  return "";
}

std::string contradiction(const ContactCoeff &coeff)
{
  auto of_liquid = contradiction(coeff.bridge);
  if (!of_liquid.empty()) return of_liquid;
  if (coeff.model.twisting && !coeff.model.sliding())
    return "twisting yes needs sliding mu > 0, which limits its torque";
  if (coeff.model.rolling() && !coeff.model.adhesive())
    return "rolling needs adhesion, surface energy gamma > 0: its moment is 4 F_C xi";
  return "";
}

apf::Interface with_itself(const ContactCoeff &coeff)
{
  auto surface = apf::interface(coeff.material, coeff.material);
  surface.gamma *= coeff.bridge.wet_share;
  return surface;
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
    coeff.material.E = words.number("Young's modulus E", range::modulus);
    coeff.material.nu = words.number("Poisson's ratio nu", range::poisson);
    coeff.material.gamma = words.number("surface energy gamma", range::surface_energy);
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

  coeff.model.surface = with_itself(coeff);
  const auto wrong = contradiction(coeff);
  if (!wrong.empty()) words.refuse(wrong);
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

bool ContactCoeff::sound() const
{
  bool all = true;
  auto number = [&](double x, const Range &may_be) {
    all = all && std::isfinite(x) && may_be.holds(x);
  };
  auto one_of = [&](auto choice, int n) {
    all = all && static_cast<int>(choice) >= 0 && static_cast<int>(choice) < n;
  };
  auto yes_or_no = [&](const bool &choice) {
    unsigned char byte;
    std::memcpy(&byte, &choice, sizeof(byte));
    all = all && byte <= 1;
  };
  auto same = [&](double x, double y) {
    all = all && std::fabs(x - y) <= rounding * y;
  };
  number(material.E, range::modulus);
  number(material.nu, range::poisson);
  number(material.gamma, range::surface_energy);
  number(model.alpha, range::damping);
  number(model.mu, range::friction);
  number(model.theta_crit, range::rolling_angle);
  number(model.zeta, range::rolling_damping);
  number(model.stiffness_scale, range::share);
  yes_or_no(model.twisting);
  one_of(model.neck_end, 3);
  number(bridge.volume_ratio, range::share_or_none);
  number(bridge.sigma, bridge.present() ? range::tension : Range());
  number(bridge.theta, Range::from(0.0, radians(range::contact_angle.high)));
  number(bridge.mu, range::viscosity);
  number(bridge.roughness, range::least_gap);
  number(bridge.intake, range::share_or_none);
  number(bridge.wet_share, range::share_or_none);
  yes_or_no(bridge.tangential);
  one_of(bridge.capillary, 2);
  one_of(bridge.forming, 2);
  one_of(bridge.sharing, 2);
  const auto surface = with_itself(*this);
  same(model.surface.E, surface.E);
  same(model.surface.G, surface.G);
  same(model.surface.gamma, surface.gamma);
  return all && contradiction(*this).empty();
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
