// Where a wall that moves as a rigid body is: positions in space against those in its own frame,
// in which its shape was given.

#ifndef APF_WALL_POSE_H
#define APF_WALL_POSE_H

#include "../contact/vector.h"

namespace apf {

class WallPose {
 public:
  Vec3 velocity{0.0, 0.0, 0.0};    // of the centre                             [velocity]
  Vec3 spin{0.0, 0.0, 0.0};        // about the centre                            [1/time]
  bool moves = false;              // else space and frame are the same

  // point about which the wall turns, at first [length]
  void set_centre(const Vec3 &x) { start = centre = x; }

  // moves on with the present velocity and spin; exact for any time
  void advance(double dt)
  {
    centre = centre + dt * velocity;
    const double w = std::sqrt(norm2(spin)), angle = w * dt;
    if (angle == 0.0) return;
    const Vec3 axis = (1.0 / w) * spin;
    const double c = std::cos(angle), s = std::sin(angle);
    for (Vec3 &e : axes) e = c * e + s * cross(axis, e) + ((1.0 - c) * dot(axis, e)) * axis;
    orthonormalize();
  }

  void to_frame(const double *x, double *y) const
  {
    const Vec3 d{x[0] - centre.x, x[1] - centre.y, x[2] - centre.z};
    y[0] = start.x + dot(axes[0], d);
    y[1] = start.y + dot(axes[1], d);
    y[2] = start.z + dot(axes[2], d);
  }
  void to_space(const double *y, double *x) const
  {
    const Vec3 p = centre + (y[0] - start.x) * axes[0] + (y[1] - start.y) * axes[1] +
        (y[2] - start.z) * axes[2];
    x[0] = p.x;
    x[1] = p.y;
    x[2] = p.z;
  }
  // of the wall's material at x
  Vec3 velocity_at(const double *x) const
  {
    return velocity + cross(spin, Vec3{x[0] - centre.x, x[1] - centre.y, x[2] - centre.z});
  }

  // Forces are computed with the velocity and spin of the step before them. A run that goes on from
  // the end of another computes the last forces again, as they were.
  void remember_motion()
  {
    last_velocity = velocity;
    last_spin = spin;
  }
  void recall_motion()
  {
    velocity = last_velocity;
    spin = last_spin;
  }

  static constexpr int state_size = 18;
  void write(double *state) const
  {
    for (const Vec3 &v : {centre, axes[0], axes[1], axes[2], last_velocity, last_spin}) {
      *state++ = v.x;
      *state++ = v.y;
      *state++ = v.z;
    }
  }
  // false if they are none of a rigid body
  bool read(const double *state)
  {
    for (Vec3 *v : {&centre, &axes[0], &axes[1], &axes[2], &last_velocity, &last_spin}) {
      *v = {state[0], state[1], state[2]};
      state += 3;
    }
    constexpr double rounding = 1e-12;
    const Vec3 third = cross(axes[0], axes[1]) - axes[2];
    return std::fabs(norm2(axes[0]) - 1.0) < rounding &&
        std::fabs(norm2(axes[1]) - 1.0) < rounding && std::fabs(dot(axes[0], axes[1])) < rounding &&
        norm2(third) < rounding * rounding;
  }

 private:
  Vec3 start{0.0, 0.0, 0.0}, centre{0.0, 0.0, 0.0};
  Vec3 last_velocity{0.0, 0.0, 0.0}, last_spin{0.0, 0.0, 0.0};
  Vec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};    // of the frame, in space

  // rounding adds up over many steps
  void orthonormalize()
  {
    axes[0] = (1.0 / std::sqrt(norm2(axes[0]))) * axes[0];
    axes[1] = axes[1] - dot(axes[0], axes[1]) * axes[0];
    axes[1] = (1.0 / std::sqrt(norm2(axes[1]))) * axes[1];
    axes[2] = cross(axes[0], axes[1]);
  }
};

}    // namespace apf

#endif
