// Liquid bridges that there are now, in blocks for vector code. A bridge is an object of its own,
// which may be there before, during and after a dry contact of the same two bodies: it is kept
// beside the ContactList, not in it, and a scene without bridges pays nothing.
//
// Bodies are rows, as for contacts; order has no meaning: a bridge that is removed is replaced by
// the last one.

#ifndef APF_BRIDGE_LIST_H
#define APF_BRIDGE_LIST_H

#include "bridge_law.h"
#include "stiffness.h"

#include <cmath>
#include <vector>

namespace apf {

// What a bridge keeps from step to step, and takes along when its bodies move to other ranks.
struct BridgeMemory {
  double volume_i = 0.0, volume_j = 0.0;    // liquid from either body                  [volume]
  double formed = INFINITY;    // gap at which it formed, in the step that saw that; else infinite

  static constexpr int size = 3, finite = 2;

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

// Bridges of one kind differ in their volume only.
struct BridgeKind {
  struct Rest {
    BridgeModel liquid;
  };
  BridgeConstantsOf<double> constants;
  Rest rest;

  static BridgeKind make(const WetContact &wet, const ContactBodies &bodies)
  {
    return {BridgeConstants::between(wet, bodies), {wet.liquid}};
  }
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
  mode.mode = BRIDGE;
  return mode;
}
// Of a dry contact and of the bridge that its bodies will have, if any.
inline StiffestMode stiffest_mode(const WetContact &wet, const ContactBodies &bodies,
                                  double smaller_radius)
{
  const auto dry = stiffest_mode(wet.dry, bodies);
  if (!wet.liquid.present()) return dry;
  const double volume = wet.liquid.first_volume(smaller_radius);
  return std::max(dry, capillary_mode(BridgeConstants::make(wet, bodies, volume)));
}

class BridgeList {
 public:
  static constexpr int width = ContactList::width;    // bridges of a block
  using Lanes = ContactList::Lanes;

  // numbers of the bridges' volumes, of BridgeState, and what the kernel tells
  struct alignas(64) Block {
    Lanes b, rupture, inv_drag_min;    // of BridgeVolumeOf
    Lanes mass;                        // that others leave to this one
    Lanes formed, touching;            // of BridgeState
    Lanes gap, ended;                  // of BridgeOutput
  };
  struct alignas(64) FitBlock {
    Lanes f1, f2, f3, f4, fit_scale;
  };

  std::vector<int> i, j;      // rows of the two bodies
  std::vector<int> source;    // caller's mark
  std::vector<int> kind;      // of `kinds`
  Kinds<BridgeKind> kinds;
  std::vector<Block> blocks;
  std::vector<FitBlock> fit_blocks;

  int size() const { return static_cast<int>(i.size()); }

  // kind_of: a number of `kinds`. is_new: it forms in this step; else it was there before
  int add(int body_i, int body_j, int mark, int kind_of, const BridgeMemory &memory, bool is_new)
  {
    const int k = size();
    i.push_back(body_i);
    j.push_back(body_j);
    source.push_back(mark);
    kind.push_back(kind_of);
    kinds.use(kind_of);
    memories.push_back(memory);
    ages.push_back(is_new ? FRESH : std::isfinite(memory.formed) ? YOUNG : OLD);
    not_old += ages[k] != OLD;
    if (k % width == 0) {
      blocks.emplace_back();
      fit_blocks.emplace_back();
    }
    refill(k, memory);
    set_mass(k, kinds.constants(kind_of).m);
    set_touching(k, false);
    lane(k, &Block::ended) = 0.0;
    if (k % width == 0) fill_block(k / width);
    return k;
  }
  void remove(int k)
  {
    const int last = size() - 1;
    kinds.release(kind[k]);
    not_old -= ages[k] != OLD;
    for (auto *array : {&i, &j, &source, &kind}) move_last(*array, k);
    move_last(memories, k);
    move_last(ages, k);
    copy_lane(blocks, last, k);
    copy_lane(fit_blocks, last, k);
    if (last % width == 0) {
      blocks.pop_back();
      fit_blocks.pop_back();
    }
  }
  void clear()
  {
    for (auto *array : {&i, &j, &source, &kind}) array->clear();
    kinds.release_all();
    memories.clear();
    ages.clear();
    not_old = 0;
    blocks.clear();
    fit_blocks.clear();
  }

  BridgeConstants constants(int k) const { return constants(kind[k], memories[k].volume()); }
  // of a bridge that there is not yet
  BridgeConstants constants(int kind_of, double volume) const
  {
    const auto &c = kinds.constants(kind_of);
    return {c, BridgeConstants::filled(kinds[kind_of].liquid, c, volume)};
  }
  const BridgeMemory &memory(int k) const { return memories[k]; }
  double gap(int k) const { return blocks[k / width].gap[k % width]; }             // at last forces
  bool ended(int k) const { return blocks[k / width].ended[k % width] != 0.0; }    // at last forces
  // the effective mass that other contacts and bridges of the two bodies leave to this one
  void set_mass(int k, double mass) { lane(k, &Block::mass) = mass; }
  double mass_alone(int k) const { return kinds.constants(kind[k]).m; }
  // whether there is a dry contact beside it
  void set_touching(int k, bool yes) { lane(k, &Block::touching) = yes ? 1.0 : 0.0; }
  // the same bridge with another volume
  void refill(int k, const BridgeMemory &memory)
  {
    memories[k] = memory;
    const BridgeVolumeOf<double> v = constants(k);
    lane(k, &Block::b) = v.b;
    lane(k, &Block::rupture) = v.rupture;
    lane(k, &Block::inv_drag_min) = v.inv_drag_min;
    auto &fit = fit_blocks[k / width];
    const int l = k % width;
    fit.f1[l] = v.fit.f1;
    fit.f2[l] = v.fit.f2;
    fit.f3[l] = v.fit.f3;
    fit.f4[l] = v.fit.f4;
    fit.fit_scale[l] = v.fit_scale;
    set_formed(k, memory.formed);
  }

  // Before a step's forces: the gap at which a bridge has formed is of one step only.
  void grow_older()
  {
    for (int k = 0; not_old > 0 && k < size(); k++)
      if (ages[k] == YOUNG) {
        ages[k] = OLD;
        not_old--;
        set_formed(k, INFINITY);
      }
  }
  // After them: what bridges exert too much or too little that formed or ruptured between two steps
  // goes to the rows and to `due` (jump.h). n_ended: how many have ended
  template <class Row>
  void correct_jumps(Row *rows, double step, int n_ended, std::vector<DueLoad> &due)
  {
    if (n_ended == 0 && not_old == 0) return;
    for (int k = 0; k < size(); k++) {
      if (ended(k)) {
        correct_end(k, rows, step, due);
      } else if (ages[k] == FRESH) {
        correct_start(k, rows, step, due);
        ages[k] = YOUNG;
      }
    }
  }

  // the fastest that bodies joined by a bridge may come to move within a time step
  template <class Row, class Acceleration>
  double fastest(const Row *rows, double step, Acceleration acceleration) const
  {
    double most = 0.0;
    for (int k = 0; k < size(); k++) {
      const double radius_sum = kinds.constants(kind[k]).radius_sum;
      const auto approach = Approach::of(rows[i[k]], rows[j[k]], radius_sum);
      const double forced = approach.relative_speed + acceleration(k) * step;
      if (forced <= most) continue;
      const double v2 = approach.relative_speed * approach.relative_speed;
      const auto c = constants(k);
      most = std::max(most, std::min(forced, std::sqrt(v2 + 2.0 * c.work(c.h_min) / c.m)));
    }
    return most;
  }

  template <class Row> void find_stiffest(const Row *rows, Stiffest &stiffest) const
  {
    for (int k = 0; k < size(); k++) {
      const auto c = constants(k);
      const auto approach = Approach::of(rows[i[k]], rows[j[k]], c.radius_sum);
      stiffest.include(capillary_mode(c), 0.0, approach.relative_speed * approach.relative_speed);
    }
  }

  double memory_usage() const    // [bytes]
  {
    return i.capacity() * 4.0 * sizeof(int) + kinds.memory_usage() + ages.capacity() +
        memories.capacity() * sizeof(BridgeMemory) +
        blocks.capacity() * (sizeof(Block) + sizeof(FitBlock));
  }

 private:
  enum Age : char { FRESH, YOUNG, OLD };    // no step has been made with it; one; more
  std::vector<BridgeMemory> memories;
  std::vector<Age> ages;
  int not_old = 0;

  double &lane(int k, Lanes Block::*lanes) { return (blocks[k / width].*lanes)[k % width]; }
  void set_formed(int k, double gap)
  {
    memories[k].formed = gap;
    lane(k, &Block::formed) = std::isfinite(gap) ? gap : -INFINITY;
  }
  template <class Value> static void move_last(std::vector<Value> &array, int to)
  {
    array[to] = array.back();
    array.pop_back();
  }
  // a block of lanes is an array of them
  template <class Blocks> static void copy_lane(std::vector<Blocks> &from, int k, int to)
  {
    const auto *lanes = reinterpret_cast<const Lanes *>(&from[k / width]);
    auto *copies = reinterpret_cast<Lanes *>(&from[to / width]);
    for (size_t n = 0; n < sizeof(Blocks) / sizeof(Lanes); n++)
      copies[n][to % width] = lanes[n][k % width];
  }
  // lanes without a bridge have numbers with which the law can be evaluated, too
  void fill_block(int block)
  {
    for (int l = 1; l < width; l++) {
      copy_lane(blocks, block * width, block * width + l);
      copy_lane(fit_blocks, block * width, block * width + l);
    }
  }

  // capillary force since the bridge formed, or until it ruptured, as correct_touch() and
  // correct_end() do it for dry contacts
  template <class Row>
  void correct_start(int k, Row *rows, double step, std::vector<DueLoad> &due) const
  {
    const auto c = constants(k);
    const auto approach = Approach::of(rows[i[k]], rows[j[k]], c.radius_sum);
    const double formed = memories[k].formed;
    const double moved = step * approach.closing_speed, past = formed - approach.gap;
    if (!(moved > 0.0) || !(past <= moved)) return;
    push_apart(rows, i[k], j[k], -(past / moved - 0.5) * c.attraction(formed), due);
  }
  template <class Row>
  void correct_end(int k, Row *rows, double step, std::vector<DueLoad> &due) const
  {
    const auto c = constants(k);
    const auto approach = Approach::of(rows[i[k]], rows[j[k]], c.radius_sum);
    const double moved = -step * approach.closing_speed;
    const double beyond = approach.gap - c.rupture_at(approach.closing_speed);
    if (!(moved > 0.0) || beyond > moved) return;
    push_apart(rows, i[k], j[k], -(0.5 - beyond / moved) * c.attraction(approach.gap - beyond),
               due);
  }
};

}    // namespace apf

#endif
