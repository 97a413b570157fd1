// Which bodies may touch within the next particle step. A pair found only when it overlaps, at the
// end of a step, would start with an overlap that no impact brings about, and fly apart too fast.
//
//   gap < reach (closing speed + extra) + margin
//
// decides for a pair by itself. A body that touches or approaches another ("active") may be struck
// in the course of the step and fly in any direction. How fast, is bounded in a frame in which the
// walls rest (if there are none, in the middle of all velocities): there an elastic impact of equal
// bodies hands on no more than the larger of their speeds, and a wall gives it back. So the fastest
// active body bounds them all. For its pairs
//
//   gap < step (speed after impacts + the other's towards it, or after impacts, + extra) + margin
//
// and what it may strike in turn is looked at in the same way, to the end of the chain. Light
// bodies that heavy ones strike leave faster, by a factor `amplify` at most.

#ifndef APF_LOOK_AHEAD_H
#define APF_LOOK_AHEAD_H

#include <algorithm>
#include <cmath>
#include <vector>

namespace apf {

// in this order, so that of two findings about a body the larger holds
enum Activity : char { FREE, NEAR, ACTIVE };

// Velocities of bodies: the largest along each axis and against it.
struct VelocityRange {
  static constexpr double none = -1.0e300;
  double most[6] = {none, none, none, none, none, none};

  bool empty() const { return most[0] == none; }

  // v, and what differs from it by no more than that along each axis
  void include(const double *v, double by = 0.0)
  {
    for (int c = 0; c < 3; c++) {
      most[c] = std::max(most[c], v[c] + by);
      most[3 + c] = std::max(most[3 + c], by - v[c]);
    }
  }
  void include(const VelocityRange &others)
  {
    for (int c = 0; c < 6; c++) most[c] = std::max(most[c], others.most[c]);
  }
  // no two of them differ by more, nor one of them and one of these others
  double spread(const VelocityRange &others) const
  {
    if (empty()) return 0.0;
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
      const double d = std::max(
          {most[c] + most[3 + c], most[c] + others.most[3 + c], others.most[c] + most[3 + c]});
      sum += d * d;
    }
    return std::sqrt(sum);
  }
  void middle(double *v) const
  {
    for (int c = 0; c < 3; c++) v[c] = empty() ? 0.0 : 0.5 * (most[c] - most[3 + c]);
  }
  // none of them differs from v by more
  double farthest_from(const double *v) const
  {
    if (empty()) return 0.0;
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
      const double d = std::max(most[c] - v[c], most[3 + c] + v[c]);
      sum += d * d;
    }
    return std::sqrt(sum);
  }
};

// Two bodies that see each other along a line.
struct Approach {
  double gap;               // between the surfaces                                  [length]
  double closing_speed;     // < 0 when they part                                    [velocity]
  double relative_speed;    // of the centres, >= 0                                  [velocity]

  template <class Row> static Approach of(const Row &i, const Row &j, double radius_sum)
  {
    double d2 = 0.0, dv = 0.0, v2 = 0.0;
    for (int c = 0; c < Row::dim; c++) {
      const double d = j.x[c] - i.x[c], v = i.v[c] - j.v[c];
      d2 += d * d;
      dv += d * v;
      v2 += v * v;
    }
    const double distance = std::sqrt(d2);
    return {distance - radius_sum, dv / distance, std::sqrt(v2)};
  }
};

// Speed after impacts over that of who struck: the larger of what one impact and a row of impacts
// can do, of bodies that meet head-on, and of masses that fall by a small factor from each to the
// next. What is not counted on: rows of more than three within a step, the most of which is a
// factor of eight.
inline double amplification(double heaviest, double lightest)
{
  constexpr double most = 8.0;
  if (heaviest <= 0.0) return 1.0;
  const double head_on = (3.0 * heaviest - lightest) / (heaviest + lightest);
  return std::min(most, std::max(head_on, std::sqrt(heaviest / lightest)));
}

struct LookAhead {
  double step = 0.0;        // particle step                                               [time]
  double reach = 0.0;       // safety factor x particle step                               [time]
  double extra = 0.0;       // speed that forces can add to an approach                [velocity]
  double margin = 0.0;      // added to every distance                                   [length]
  double fastest = 0.0;     // largest relative speed of bodies that touch or approach [velocity]
  double striking = 0.0;    // largest of surfaces that touch, or will as they fly     [velocity]

  // speeds in the frame
  double frame[3] = {0.0, 0.0, 0.0};    // its velocity                               [velocity]
  double walls = 0.0;       // none of them is faster                                 [velocity]
  double limit = 0.0;       // no body is faster, now                                 [velocity]
  double swiftest = 0.0;    // of active bodies, now                                  [velocity]
  double released = 0.0;    // what springs of contacts can add                       [velocity]
  double amplify = 1.0;     // speed after impacts over that of who struck                   [-]

  const double *radius = nullptr;      // of each body                                [length]
  std::vector<char> activity;          // Activity of each body
  std::vector<double> acceleration;    // of its surface, by all forces    [velocity/time]
  std::vector<char> used;              // bodies that a pair here has made active

  void begin(int bodies)
  {
    activity.assign(bodies, FREE);
    acceleration.assign(bodies, 0.0);
    used.assign(bodies, 0);
    fastest = striking = swiftest = released = 0.0;
  }

  bool free(int i) const { return activity[i] == FREE; }

  // Speed that a body has, or an impact with friction can make of its spin: the tangential part of
  // an impulse is at most 2/7 of what turns both surfaces round.
  template <class Row> double speed_of(const Row *rows, int i) const
  {
    const Row &row = rows[i];
    double v2 = 0.0, w2 = 0.0;
    for (int c = 0; c < Row::dim; c++) v2 += (row.v[c] - frame[c]) * (row.v[c] - frame[c]);
    for (const double w : row.omega) w2 += w * w;
    return std::sqrt(v2) + spin_share * radius[i] * std::sqrt(w2);
  }
  static constexpr double spin_share = 4.0 / 7.0;

  double after_impacts() const { return bounded(swiftest); }
  // what strikes on both of its bodies may add to an approach
  double strike() const { return 2.0 * amplify * striking; }

  double distance(double closing) const
  {
    return reach * (std::max(closing, 0.0) + extra) + margin;
  }
  double distance_if_struck(double speed_i, double speed_j) const
  {
    return step * (std::max(speed_i + speed_j, 0.0) + extra) + margin;
  }
  double farthest() const    // no distance is larger
  {
    return std::max(reach * (2.0 * limit + extra), step * (2.0 * bounded(limit) + extra)) + margin;
  }

  // a contact whose bodies may come to have that relative speed, of which its springs add a part
  void may_move(double relative_speed, double added)
  {
    fastest = std::max(fastest, relative_speed);
    striking = std::max(striking, relative_speed);
    released = std::max(released, added);
  }
  // bodies that do not touch, but may within the step
  void approach(const Approach &pair)
  {
    if (pair.gap <= step * (pair.closing_speed + extra))
      striking = std::max(striking, pair.relative_speed);
  }
  void meet(int i, double relative_speed, double speed)
  {
    activity[i] = ACTIVE;
    used[i] = 1;
    fastest = std::max(fastest, relative_speed);
    swiftest = std::max(swiftest, speed);
  }
  void come_near(int i, double speed)
  {
    activity[i] = std::max<char>(activity[i], NEAR);
    used[i] = 1;
    swiftest = std::max(swiftest, speed);
  }

 private:
  double bounded(double speed) const { return amplify * (speed + released) + 2.0 * walls; }
};

}    // namespace apf

#endif
