// Contacts that are closed now, in blocks for vector code.
//
// Constants are kept once for all contacts of a kind, and what a step changes in blocks of eight
// contacts, so that the kernel reads few bytes in few streams.
//
// Bodies are rows of the arrays that the kernel is given (Bodies, contact_kernel.h). Order has no
// meaning: an ended contact is replaced by the last one. The list knows nothing of neighbour lists,
// ranks or walls.

#ifndef APF_CONTACT_LIST_H
#define APF_CONTACT_LIST_H

#include "../timestep/look_ahead.h"
#include "bodies.h"
#include "contact_kind.h"

#include <vector>

namespace apf {

// Sliding, rolling and twisting displacement and the last normal. In the plane only sliding[0] and
// rolling[0] are used, along the tangent (-n_y, n_x).
struct ContactHistory {
  double sliding[3] = {0.0, 0.0, 0.0};    // [length]
  double rolling[3] = {0.0, 0.0, 0.0};    // [length]
  double twisting = 0.0;                  // [rad]
  double normal[3] = {0.0, 0.0, 0.0};     // unit normal from i to j at the last update; 0 if new

  static constexpr int size = 10, finite = 10;

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

  double energy() const
  {
    return elastic_energy + sliding_energy + rolling_energy + twisting_energy;
  }
};

class ContactList {
 public:
  static constexpr int width = 16;    // contacts of a block
  using Lanes = double[width];

  // what a step reads and writes of all contacts, and of those in space alone
  struct alignas(64) Block {
    Lanes overlap;                   // at the last update
    Lanes crowd_mass, crowd_roll;    // of ContactConstants
    Lanes sliding, rolling;          // [0] of ContactHistory
  };
  struct alignas(64) SpaceBlock {
    Lanes sliding[2], rolling[2];    // [1], [2] of ContactHistory
    Lanes twisting, normal[3];
  };

  std::vector<int> i, j;      // rows of the two bodies
  std::vector<int> source;    // caller's mark: candidate or wall the contact came from
  std::vector<int> kind;      // of `kinds`
  ContactKinds kinds;
  std::vector<Block> blocks;
  std::vector<SpaceBlock> space_blocks;

  int size() const { return static_cast<int>(i.size()); }

  // kind_of: a number of `kinds`
  int add(int body_i, int body_j, int mark, int kind_of, const ContactHistory &h)
  {
    const int k = append(body_i, body_j, mark, kind_of);
    kinds.use(kind_of);
    blocks[k / width].overlap[k % width] = 0.0;
    set_crowding(k, kinds[kind_of].crowd_mass, kinds[kind_of].crowd_roll);
    set_history(k, h);
    return k;
  }

  void remove(int k)
  {
    const int last = size() - 1;
    kinds.release(kind[k]);
    for (auto *array : {&i, &j, &source, &kind}) {
      (*array)[k] = array->back();
      array->pop_back();
    }
    take(k, *this, last);
    if (last % width == 0) {
      blocks.pop_back();
      space_blocks.pop_back();
    }
  }

  // A contact of another list that has the same kinds; its use of one is not counted.
  void copy(const ContactList &from, int k)
  {
    take(append(from.i[k], from.j[k], from.source[k], from.kind[k]), from, k);
  }

  // contact `to` becomes, but for its bodies and kind, what `k` of another list is
  void take(int to, const ContactList &from, int k)
  {
    take(blocks[to / width], to % width, from.blocks[k / width], k % width);
    take(space_blocks[to / width], to % width, from.space_blocks[k / width], k % width);
  }

  // all contacts go, without a word to their kinds
  void drop()
  {
    for (auto *array : {&i, &j, &source, &kind}) array->clear();
    blocks.clear();
    space_blocks.clear();
  }

  void clear()
  {
    drop();
    kinds.release_all();
  }

  // what the springs of normal and sliding hold above their least energy
  double energy_above_rest(int k) const
  {
    const auto &c = kinds.constants(kind[k]);
    const JKR normal{c.R, c.K, c.root_unit};
    const double s = normal.root(overlap(k));
    const double least = normal.energy(std::cbrt(6.0) * normal.neck);    // where the force is 0
    double sliding2 = 0.0;
    for (const double component : history_of(k).sliding) sliding2 += component * component;
    return normal.energy(s) - least + 0.5 * c.kt * s * s * sliding2;
  }

  // the fastest that the surfaces of contacts may come to move within a time step, and what their
  // springs add
  // acceleration(k): largest that the surfaces in contact k have relative to each other
  template <class Row, class Acceleration>
  void find_fastest(const Row *rows, double step, LookAhead &ahead, Acceleration acceleration)
  {
    speed2.resize(size());
    for (int k = 0; k < size(); k++) {
      const auto &c = kinds.constants(kind[k]);
      const double v2 = speed2[k] =
          contact_speed2(rows[i[k]], rows[j[k]], c.radius_i, c.radius_sum - c.radius_i);
      const double v = std::sqrt(v2) + acceleration(k) * step;
      if (v <= ahead.fastest && v - std::sqrt(v2) <= ahead.released) continue;
      const double of_springs = std::sqrt(v2 + 2.0 * energy_above_rest(k) / mode(k).mass);
      const double most = std::min(v, of_springs);
      ahead.may_move(most, most - std::sqrt(v2));
    }
  }

  // which contact demands the finest step, with the bodies as find_fastest() saw them
  template <class Acceleration>
  void find_stiffest(Stiffest &stiffest, Acceleration acceleration) const
  {
    const bool adaptive = stiffest.rule.tolerance > 0.0;
    for (int k = 0; k < size(); k++) {
      if (!adaptive) {
        stiffest.include(mode(k), overlap(k), 0.0);
        continue;
      }
      stiffest.include(mode(k), overlap(k), speed2[k], acceleration(k), [&] {
        return energy_above_rest(k) / mode(k).mass;
      });
    }
  }

  const StiffestMode &mode(int k) const { return kinds[kind[k]].mode; }

  double overlap(int k) const
  {
    return blocks[k / width].overlap[k % width];
  }    // at the last update

  ContactConstants constants_of(int k) const
  {
    const Block &block = blocks[k / width];
    return {kinds.constants(kind[k]), block.crowd_mass[k % width], block.crowd_roll[k % width]};
  }

  ContactHistory history_of(int k) const
  {
    ContactHistory h;
    const int l = k % width;
    const Block &block = blocks[k / width];
    const SpaceBlock &space = space_blocks[k / width];
    h.sliding[0] = block.sliding[l];
    h.rolling[0] = block.rolling[l];
    for (int c = 0; c < 2; c++) {
      h.sliding[c + 1] = space.sliding[c][l];
      h.rolling[c + 1] = space.rolling[c][l];
    }
    h.twisting = space.twisting[l];
    for (int c = 0; c < 3; c++) h.normal[c] = space.normal[c][l];
    return h;
  }

  // what a step changes
  void update(int k, double overlap, const ContactHistory &h)
  {
    blocks[k / width].overlap[k % width] = overlap;
    set_history(k, h);
  }

  void change_kind(int k, int kind_of)
  {
    kinds.use(kind_of);
    kinds.release(kind[k]);
    kind[k] = kind_of;
  }

  // other contacts of the two bodies have come or gone
  void set_crowding(int k, const ContactBodies &bodies)
  {
    set_crowding(k, bodies.m / bodies.crowding, bodies.I / (bodies.R * bodies.crowding));
  }

  // the last update found the neck beyond its end
  bool ended(int k) const { return overlap(k) < kinds.constants(kind[k]).break_overlap; }

  // [bytes]
  double memory_usage() const
  {
    return i.capacity() * 4.0 * sizeof(int) + speed2.capacity() * sizeof(double) +
        blocks.capacity() * (sizeof(Block) + sizeof(SpaceBlock)) + kinds.memory_usage();
  }

 private:
  std::vector<double> speed2;    // of the surfaces in contact, squared      [velocity^2]

  // Room for a quarter more: there may be millions, and doubling would leave half of it empty.
  template <class Value> static void append(std::vector<Value> &to, const Value &value)
  {
    if (to.size() == to.capacity()) to.reserve(to.size() + to.size() / 4 + width);
    to.push_back(value);
  }
  // room for one more contact; its number
  int append(int body_i, int body_j, int mark, int kind_of)
  {
    const int k = size();
    append(i, body_i);
    append(j, body_j);
    append(source, mark);
    append(kind, kind_of);
    if (k % width == 0) {
      append(blocks, {});
      append(space_blocks, {});
    }
    return k;
  }
  template <class AnyBlock>
  static void take(AnyBlock &to, int lane, const AnyBlock &from, int from_lane)
  {
    auto *lanes = reinterpret_cast<Lanes *>(&to);
    const auto *from_lanes = reinterpret_cast<const Lanes *>(&from);
    for (size_t n = 0; n < sizeof(AnyBlock) / sizeof(Lanes); n++)
      lanes[n][lane] = from_lanes[n][from_lane];
  }
  void set_crowding(int k, double mass, double roll)
  {
    blocks[k / width].crowd_mass[k % width] = mass;
    blocks[k / width].crowd_roll[k % width] = roll;
  }
  void set_history(int k, const ContactHistory &h)
  {
    const int l = k % width;
    Block &block = blocks[k / width];
    SpaceBlock &space = space_blocks[k / width];
    block.sliding[l] = h.sliding[0];
    block.rolling[l] = h.rolling[0];
    for (int c = 0; c < 2; c++) {
      space.sliding[c][l] = h.sliding[c + 1];
      space.rolling[c][l] = h.rolling[c + 1];
    }
    space.twisting[l] = h.twisting;
    for (int c = 0; c < 3; c++) space.normal[c][l] = h.normal[c];
  }
};

}    // namespace apf

#endif
