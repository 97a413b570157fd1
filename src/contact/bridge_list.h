// Liquid bridges that there are now, and their forces. A bridge is an object of its own, which may
// be there before, during and after a dry contact of the same two bodies: it is kept beside the
// ContactList, not in it, and a scene without bridges pays nothing.
//
// Bodies are rows, as for contacts; order has no meaning.

#ifndef APF_BRIDGE_LIST_H
#define APF_BRIDGE_LIST_H

#include "bridge.h"
#include "jump.h"
#include "stiffness.h"

#include <cmath>
#include <vector>

namespace apf {

// What a bridge keeps from step to step, and takes along when its bodies move to other ranks.
struct BridgeMemory {
  double volume_i = 0.0, volume_j = 0.0;    // liquid from either body                  [volume]
  double formed = INFINITY;    // gap at which it formed, in the step that saw that; else infinite

  static constexpr int size = 3;

  double volume() const { return volume_i + volume_j; }
  // the same bridge seen from j
  BridgeMemory swapped(bool /*planar*/) const { return {volume_j, volume_i, formed}; }
};

// What a bridge exerts now; written when asked for.
struct BridgeParts {
  double gap;              // between the surfaces                                       [length]
  double capillary;        // along the normal, > 0 attracts                              [force]
  double viscous;          // along the normal, > 0 repels                                [force]
  double tangential[3];    // on i                                                        [force]
  double force[3];         // total on i                                                  [force]
  double energy;           // of the capillary force: 0 at rupture, < 0 before it        [energy]
};

// The mode of the capillary force, whose strength changes over the length sqrt(b). Viscosity sets
// no limit to the step.
inline StiffestMode capillary_mode(const BridgeConstants &c)
{
  const double length = std::sqrt(c.b), force = c.attraction(c.h_min);
  StiffestMode mode;
  mode.frequency = std::sqrt(force / (length * c.m));
  mode.least = mode.overlap;
  mode.mass = c.m;
  mode.slow2 = 2.0 * force * length / c.m;
  mode.mode = NORMAL;
  return mode;
}

class BridgeList {
 public:
  std::vector<int> i, j;      // rows of the two bodies
  std::vector<int> source;    // caller's mark

  int size() const { return static_cast<int>(i.size()); }

  // is_new: it forms in this step; else it was there before
  int add(int body_i, int body_j, int mark, const BridgeConstants &constants,
          const BridgeMemory &memory, bool is_new)
  {
    i.push_back(body_i);
    j.push_back(body_j);
    source.push_back(mark);
    bridges.push_back({constants, memory, constants.m, is_new, false});
    return size() - 1;
  }
  void remove(int k)
  {
    for (auto *array : {&i, &j, &source}) {
      (*array)[k] = array->back();
      array->pop_back();
    }
    bridges[k] = bridges.back();
    bridges.pop_back();
  }
  void clear()
  {
    for (auto *array : {&i, &j, &source}) array->clear();
    bridges.clear();
  }

  const BridgeConstants &constants(int k) const { return bridges[k].constants; }
  const BridgeMemory &memory(int k) const { return bridges[k].memory; }
  bool ended(int k) const { return bridges[k].ended; }    // at the last forces
  // the effective mass that other contacts and bridges of the two bodies leave to this one
  void set_mass(int k, double mass) { bridges[k].mass = mass; }
  // the same bridge with another volume
  void refill(int k, const BridgeConstants &constants, const BridgeMemory &memory)
  {
    bridges[k].constants = constants;
    bridges[k].memory = memory;
  }

  // Adds the forces of all bridges to the rows. dry(k, overlap, closing speed): force of the dry
  // contact of the same bodies along their normal, > 0 repels, 0 if there is none. What a bridge
  // formed or ruptured between two steps exerts too much or too little goes to `due` as well
  // (jump.h). Returns how many have ruptured: these exert nothing, the caller removes them.
  template <class Row, class Dry>
  int add_forces(Row *rows, const ContactTimes &times, Dry dry, std::vector<DueLoad> &due,
                 BridgeParts *parts = nullptr)
  {
    int ended = 0;
    for (int k = 0; k < size(); k++) {
      auto &bridge = bridges[k];
      if (times.advance > 0.0 && !bridge.fresh) bridge.memory.formed = INFINITY;
      const Meeting<Row> pair(rows[i[k]], rows[j[k]], bridge.constants);
      if (parts) parts[k] = BridgeParts{};
      bridge.ended = bridge.constants.ruptures(pair.gap, pair.closing);
      if (bridge.ended) {
        ended++;
        if (times.advance > 0.0) correct_end(bridge, k, rows, pair, times.advance, due);
        continue;
      }
      const double force_of_contact = dry(k, -pair.gap, pair.closing);
      add_force(bridge, k, rows, pair, times, force_of_contact, parts ? parts + k : nullptr);
      if (times.advance > 0.0) {
        if (bridge.fresh) correct_start(bridge, k, rows, pair, times.advance, due);
        bridge.fresh = false;
      }
    }
    return ended;
  }

  // the fastest that bodies joined by a bridge may come to move within a time step
  template <class Row, class Acceleration>
  double fastest(const Row *rows, double step, Acceleration acceleration) const
  {
    double most = 0.0;
    for (int k = 0; k < size(); k++) {
      const auto &c = bridges[k].constants;
      const auto approach = Approach::of(rows[i[k]], rows[j[k]], c.radius_sum);
      const double v2 = approach.relative_speed * approach.relative_speed;
      const double forced = approach.relative_speed + acceleration(k) * step;
      if (forced <= most) continue;
      most = std::max(most, std::min(forced, std::sqrt(v2 + 2.0 * c.work(c.h_min) / c.m)));
    }
    return most;
  }

  template <class Row> void find_stiffest(const Row *rows, Stiffest &stiffest) const
  {
    for (int k = 0; k < size(); k++) {
      const auto approach = Approach::of(rows[i[k]], rows[j[k]], bridges[k].constants.radius_sum);
      stiffest.include(capillary_mode(bridges[k].constants), 0.0,
                       approach.relative_speed * approach.relative_speed);
    }
  }

  double memory_usage() const    // [bytes]
  {
    return i.capacity() * 3.0 * sizeof(int) + bridges.capacity() * sizeof(Bridge);
  }

 private:
  struct Bridge {
    BridgeConstants constants;
    BridgeMemory memory;
    double mass;    // see set_mass
    bool fresh;     // no step has been made with it
    bool ended;
  };
  std::vector<Bridge> bridges;

  // Two bodies as a bridge sees them; velocities are i minus j.
  template <class Row> struct Meeting {
    double n[3] = {}, v[3] = {}, distance = 0.0, gap, closing = 0.0, across2 = 0.0;

    Meeting(const Row &a, const Row &b, const BridgeConstants &c)
    {
      for (int d = 0; d < Row::dim; d++) {
        n[d] = b.x[d] - a.x[d];
        v[d] = a.v[d] - b.v[d];
        distance += n[d] * n[d];
        across2 += v[d] * v[d];
      }
      distance = std::sqrt(distance);
      for (double &component : n) component /= distance;
      for (int d = 0; d < Row::dim; d++) closing += v[d] * n[d];
      across2 = std::max(0.0, across2 - closing * closing);
      gap = distance - c.radius_sum;
    }
  };

  template <class Row>
  void add_force(Bridge &bridge, int k, Row *rows, const Meeting<Row> &pair,
                 const ContactTimes &times, double dry, BridgeParts *parts)
  {
    const auto &c = bridge.constants;
    const double kick = times.behind + 0.5 * times.step;
    const double capillary = c.attraction(pair.gap);
    const double viscous = viscous_force(bridge, pair, times, kick, (capillary - dry) / c.m);
    double on_i[3], slip_force[3] = {};
    for (int d = 0; d < 3; d++) on_i[d] = (capillary - viscous) * pair.n[d];
    if (c.film > 0.0) {
      add_tangential(bridge, k, rows, pair, kick, slip_force);
      for (int d = 0; d < 3; d++) on_i[d] += slip_force[d];
    }
    for (int d = 0; d < Row::dim; d++) {
      rows[i[k]].f[d] += on_i[d];
      rows[j[k]].f[d] -= on_i[d];
    }
    if (!parts) return;
    *parts = {pair.gap, capillary, viscous, {}, {}, -c.work(pair.gap)};
    std::copy_n(slip_force, 3, parts->tangential);
    std::copy_n(on_i, 3, parts->force);
  }

  // acceleration: of closing, by the other forces between the two bodies
  template <class Row>
  static double viscous_force(const Bridge &bridge, const Meeting<Row> &pair,
                              const ContactTimes &times, double kick, double acceleration)
  {
    const auto &c = bridge.constants;
    if (c.drag == 0.0) return 0.0;
    if (kick == 0.0) return c.resistance(c.gap(pair.gap)) * pair.closing;
    const double share = ViscousStep::share(bridge.mass, c.drag_min, times.step);
    const double ahead = share * times.step, back = 2.0 * (1.0 - share) * times.behind;
    // the distance of two bodies that pass each other grows by the square of time
    const double turn = 0.5 * c.turning * pair.across2 / pair.distance;
    const double last = pair.gap + back * pair.closing + turn * back * back;
    const double formed = bridge.memory.formed;
    const ViscousStep step{std::isfinite(formed) ? std::max(formed, last) : last,
                           pair.gap + turn * ahead * ahead, ahead, bridge.mass,
                           pair.closing + kick * acceleration};
    return bridge.mass * (step.speed - step.new_speed(c)) / kick;
  }

  // Resistance to the sliding of the two surfaces, which moves them as if they had 2/7 of the mass;
  // backward Euler, stable for any step.
  template <class Row>
  void add_tangential(const Bridge &bridge, int k, Row *rows, const Meeting<Row> &pair, double kick,
                      double (&force)[3])
  {
    const auto &c = bridge.constants;
    Row &a = rows[i[k]], &b = rows[j[k]];
    const double arm_i = c.radius_i + c.arm_share * pair.gap, arm_j = pair.distance - arm_i;
    constexpr int first = 3 - Row::spin_dim;
    double spin[3] = {}, torque[3];
    for (int d = 0; d < Row::spin_dim; d++)
      spin[first + d] = arm_i * a.omega[d] + arm_j * b.omega[d];
    const double resistance = c.tangential_resistance(c.gap(pair.gap));
    const double scale = resistance / (1.0 + resistance * kick / (2.0 / 7.0 * bridge.mass));
    for (int d = 0; d < 3; d++) {
      const int e = (d + 1) % 3, g = (d + 2) % 3;
      const double slip =
          pair.v[d] - pair.closing * pair.n[d] + spin[e] * pair.n[g] - spin[g] * pair.n[e];
      force[d] = -scale * slip;
    }
    for (int d = 0; d < 3; d++) {
      const int e = (d + 1) % 3, g = (d + 2) % 3;
      torque[d] = pair.n[e] * force[g] - pair.n[g] * force[e];
    }
    for (int d = 0; d < Row::spin_dim; d++) {
      a.torque[d] += arm_i * torque[first + d];
      b.torque[d] += arm_j * torque[first + d];
    }
  }

  // capillary force since the bridge formed, or until it ruptured, as correct_touch() and
  // correct_end() do it for dry contacts
  template <class Row>
  void correct_start(const Bridge &bridge, int k, Row *rows, const Meeting<Row> &pair, double step,
                     std::vector<DueLoad> &due)
  {
    const double moved = step * pair.closing, past = bridge.memory.formed - pair.gap;
    if (!(moved > 0.0) || !(past <= moved)) return;
    const double force = bridge.constants.attraction(bridge.memory.formed);
    push_apart(rows, i[k], j[k], -(past / moved - 0.5) * force, due);
  }
  template <class Row>
  void correct_end(const Bridge &bridge, int k, Row *rows, const Meeting<Row> &pair, double step,
                   std::vector<DueLoad> &due)
  {
    const double moved = -step * pair.closing;
    const auto &c = bridge.constants;
    const double Ca = std::min(c.inv_speed * std::fabs(pair.closing), largest_Ca);
    const double beyond = pair.gap - c.rupture * (1.0 + std::sqrt(Ca));
    if (!(moved > 0.0) || beyond > moved) return;
    push_apart(rows, i[k], j[k], -(0.5 - beyond / moved) * c.attraction(pair.gap - beyond), due);
  }
};

}    // namespace apf

#endif
