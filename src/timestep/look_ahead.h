// Which bodies may touch within the next particle step. A pair found only when it overlaps, at the
// end of a step, would start with an overlap that no impact brings about, and fly apart too fast.
//
//   gap < reach (closing speed + extra) + margin
//
// decides for a pair by itself. A body that touches or approaches another ("active") may be struck
// in the course of the step and then move as fast as any of these; for its pairs the largest
// relative speed of all of them stands in for the closing speed, and what it may strike in turn is
// looked at in the same way, to the end of the chain. A light body that a heavy one strikes leaves
// with up to twice its speed.

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

  // v, and what differs from it by no more than that along each axis
  void include(const double *v, double by = 0.0)
  {
    for (int c = 0; c < 3; c++) {
      most[c] = std::max(most[c], v[c] + by);
      most[3 + c] = std::max(most[3 + c], by - v[c]);
    }
  }
  // no two of them differ by more, nor one of them and one of these others
  double spread(const VelocityRange &others) const
  {
    if (most[0] == none) return 0.0;
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
      const double d = std::max(
          {most[c] + most[3 + c], most[c] + others.most[3 + c], others.most[c] + most[3 + c]});
      sum += d * d;
    }
    return std::sqrt(sum);
  }
  double fastest() const    // none of them is larger
  {
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
      const double along = most[c] > none ? std::max(most[c], most[3 + c]) : 0.0;
      sum += along * along;
    }
    return std::sqrt(sum);
  }
};

struct LookAhead {
  double reach = 0.0;      // safety factor x particle step                            [time]
  double struck = 0.0;     // the same for a body that another has struck               [time]
  double extra = 0.0;      // speed that forces can add to an approach               [velocity]
  double margin = 0.0;     // added to every distance                                  [length]
  double fastest = 0.0;    // largest relative speed of bodies that touch or approach [velocity]
  double limit = 0.0;      // no relative speed of two bodies is larger                [velocity]
  std::vector<char> activity;          // Activity of each body
  std::vector<double> acceleration;    // of its surface, by all forces    [velocity/time]
  std::vector<char> used;              // bodies that a pair here has made active

  void begin(int bodies)
  {
    activity.assign(bodies, FREE);
    acceleration.assign(bodies, 0.0);
    used.assign(bodies, 0);
    fastest = 0.0;
  }

  double distance(double speed) const { return reach * (std::max(speed, 0.0) + extra) + margin; }

  double distance_if_struck() const { return struck * (fastest + extra) + margin; }
  double farthest() const { return std::max(reach, struck) * (limit + extra) + margin; }

  void meet(int i, double relative_speed)
  {
    activity[i] = ACTIVE;
    used[i] = 1;
    fastest = std::max(fastest, relative_speed);
  }
  void come_near(int i)
  {
    activity[i] = std::max<char>(activity[i], NEAR);
    used[i] = 1;
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

}    // namespace apf

#endif
