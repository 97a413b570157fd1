// Contacts that are closed now: a structure of arrays, one entry per contact.
//
// Bodies are rows of the arrays that the kernel is given (Bodies, contact_kernel.h). Order has no
// meaning: an ended contact is replaced by the last one. The list knows nothing of neighbour lists,
// ranks or walls.

#ifndef APF_CONTACT_LIST_H
#define APF_CONTACT_LIST_H

#include "bodies.h"
#include "contact_kind.h"

#include <array>
#include <cstddef>
#include <vector>

namespace apf {

// Sliding, rolling and twisting displacement and the last normal. In the plane only sliding[0] and
// rolling[0] are used, along the tangent (-n_y, n_x).
struct ContactHistory {
  double sliding[3] = {0.0, 0.0, 0.0};    // [length]
  double rolling[3] = {0.0, 0.0, 0.0};    // [length]
  double twisting = 0.0;                  // [rad]
  double normal[3] = {0.0, 0.0, 0.0};     // unit normal from i to j at the last update; 0 if new

  static constexpr int size = 10;

  // the same contact seen from j; in the plane the tangent turns with the normal
  ContactHistory swapped(bool planar) const
  {
    ContactHistory h = *this;
    for (double &component : h.normal) component = -component;
    if (planar)
      h.rolling[0] = -rolling[0];
    else
      for (double &component : h.sliding) component = -component;
    return h;
  }
};

// What a contact exerts now, by part; written when the kernel is asked to.
struct ContactParts {
  double overlap;            // r_i + r_j - distance                               [length]
  double contact_radius;     // a                                                  [length]
  double elastic;            // along the normal, > 0 repels                       [force]
  double damping;            // along the normal, > 0 repels                       [force]
  double sliding[3];         // tangential force on i                              [force]
  double rolling[3];         // rolling torque on i                                [force length]
  double twisting;           // torque on i along the normal                       [force length]
  double force[3];           // total force on i                                   [force]
  double elastic_energy;     // of the normal law, JKR::energy                     [energy]
  double sliding_energy;     // of the sliding spring                              [energy]
  double rolling_energy;     // of the rolling spring                              [energy]
  double twisting_energy;    // of the twisting spring                             [energy]
};

class ContactList {
 public:
  static constexpr int n_constants = sizeof(ContactConstants) / sizeof(double);

  std::vector<int> i, j;                                            // rows of the two bodies
  std::array<std::vector<double>, n_constants> constants;           // ContactConstants
  std::array<std::vector<double>, ContactHistory::size> history;    // ContactHistory
  std::vector<double> overlap;                                      // at the last update
  std::vector<int> source;    // caller's mark: candidate or wall the contact came from
  std::vector<StiffestMode> mode;

  int size() const { return static_cast<int>(i.size()); }

  int add(int body_i, int body_j, int mark, const ContactKind &kind, const ContactHistory &h)
  {
    i.push_back(body_i);
    j.push_back(body_j);
    source.push_back(mark);
    mode.push_back(kind.mode);
    overlap.push_back(0.0);
    const double *value = reinterpret_cast<const double *>(&kind.constants);
    for (int n = 0; n < n_constants; n++) constants[n].push_back(value[n]);
    value = reinterpret_cast<const double *>(&h);
    for (int n = 0; n < ContactHistory::size; n++) history[n].push_back(value[n]);
    return size() - 1;
  }

  void remove(int k)
  {
    for_each_array([k](auto &array) {
      array[k] = array.back();
      array.pop_back();
    });
  }

  void clear()
  {
    for_each_array([](auto &array) {
      array.clear();
    });
  }

  // what the springs of normal and sliding hold above their least energy
  double energy_above_rest(int k) const
  {
    const auto c = constants_of(k);
    const JKR normal{c.R, c.K, c.neck};
    const double s = jkr_root(overlap[k], c.inv_R, c.neck);
    const double least = normal.energy(std::cbrt(6.0) * c.neck);    // where the force is 0
    double sliding2 = 0.0;
    for (int n = 0; n < 3; n++) sliding2 += history[n][k] * history[n][k];
    return normal.energy(s) - least + 0.5 * c.kt * s * s * sliding2;
  }

  // which contact demands the finest step, with the bodies as they move now
  // acceleration(k): largest that the surfaces in contact k have relative to each other
  template <class Row, class Acceleration>
  void find_stiffest(const Row *rows, Stiffest &stiffest, Acceleration acceleration) const
  {
    const auto &radius_sum = constants[offsetof(ContactConstants, radius_sum) / sizeof(double)];
    const auto &radius_i = constants[offsetof(ContactConstants, radius_i) / sizeof(double)];
    const bool adaptive = stiffest.rule.tolerance > 0.0;
    for (int k = 0; k < size(); k++) {
      double speed2 = 0.0;
      if (adaptive) {
        const double ri = radius_i[k], rj = radius_sum[k] - ri;
        speed2 = stiffest.fastest2(contact_speed2(rows[i[k]], rows[j[k]], ri, rj),
                                   energy_above_rest(k) / mode[k].mass, acceleration(k));
      }
      stiffest.include(mode[k], overlap[k], speed2);
    }
  }

  ContactConstants constants_of(int k) const
  {
    ContactConstants c;
    double *value = reinterpret_cast<double *>(&c);
    for (int n = 0; n < n_constants; n++) value[n] = constants[n][k];
    return c;
  }

  ContactHistory history_of(int k) const
  {
    ContactHistory h;
    double *value = reinterpret_cast<double *>(&h);
    for (int n = 0; n < ContactHistory::size; n++) value[n] = history[n][k];
    return h;
  }

  // other contacts of the two bodies have come or gone
  void set_crowding(int k, const ContactBodies &bodies)
  {
    constants[offsetof(ContactConstants, crowd_mass) / sizeof(double)][k] =
        bodies.m / bodies.crowding;
    constants[offsetof(ContactConstants, crowd_roll) / sizeof(double)][k] =
        bodies.I / (bodies.R * bodies.crowding);
  }

  // the last update found the neck beyond its end
  bool ended(int k) const { return overlap[k] < break_overlap(k); }

  // [bytes]
  double memory_usage() const
  {
    return i.capacity() *
        (3.0 * sizeof(int) + sizeof(StiffestMode) +
         (1.0 + n_constants + ContactHistory::size) * sizeof(double));
  }

 private:
  double break_overlap(int k) const
  {
    constexpr int n = offsetof(ContactConstants, break_overlap) / sizeof(double);
    return constants[n][k];
  }

  template <class Action> void for_each_array(Action action)
  {
    action(i);
    action(j);
    action(source);
    action(mode);
    action(overlap);
    for (auto &array : constants) action(array);
    for (auto &array : history) action(array);
  }
};

static_assert(sizeof(ContactConstants) == ContactList::n_constants * sizeof(double),
              "doubles only");
static_assert(sizeof(ContactHistory) == ContactHistory::size * sizeof(double), "doubles only");

}    // namespace apf

#endif
