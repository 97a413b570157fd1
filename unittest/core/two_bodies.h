// Two bodies and the contact between them, driven through the contact kernel alone: what the tests
// of the contact core share. Body 0 is i, body 1 is j; the normal starts along +x. Body 1 may be a
// wall: the plane x = 0 of a body without radius, whose foot point follows body 0.

#ifndef APF_TEST_TWO_BODIES_H
#define APF_TEST_TWO_BODIES_H

#include "compare.h"
#include "contact/contact_kernel.h"

#include <algorithm>
#include <cmath>

namespace apf_test {

using apf::Vec3;

// The kernel on plain arrays [bodies][3]; forces and torques are added to.
inline int run_kernel(apf::ContactKernel kernel, bool planar, apf::ContactList &list, int n,
                      const double *x, const double *v, const double *omega, double *f,
                      double *torque, apf::ContactTimes times, apf::ContactParts *parts)
{
  apf::Bodies bodies(planar);
  bodies.resize(n);
  for (int b = 0; b < n; b++) {
    bodies.place(b, x + 3 * b);
    bodies.set_motion(b, v + 3 * b, omega + 3 * b);
  }
  struct To : apf::ContactReader {
    explicit To(apf::ContactParts *array) : to(array) {}
    void read(int k, const apf::ContactParts &p) override { to[k] = p; }
    apf::ContactParts *to;
  } reader(parts);
  const int ended = kernel(list, bodies, times, parts ? &reader : nullptr);
  for (int b = 0; b < n; b++) bodies.add_load_to(b, f + 3 * b, torque + 3 * b);
  return ended;
}

// A glass-like material that is sticky enough for all parts of the law to matter: a0/R = 0.12.
inline apf::ContactModel sticky_model()
{
  apf::ContactModel model;
  model.surface = {2.0e9, 0.45e9, 0.12};
  return model;
}

inline apf::ContactModel hertz_model(double E, double G)
{
  apf::ContactModel model;
  model.surface = {E, G, 0.0};
  return model;
}

struct TwoBodies {
  apf::ContactModel model;
  double mass[2], inertia[2];    // 0 = held
  double x[6]{}, v[6]{}, omega[6]{}, f[6]{}, torque[6]{};
  double load[6]{}, load_torque[6]{};    // external
  apf::ContactBodies bodies;
  apf::ContactConstants constants;
  apf::ContactList list;
  apf::ContactParts parts{};
  apf::ContactKernel kernel;
  bool wall, planar = false;

  static TwoBodies spheres(const apf::ContactModel &model, double ri, double rj,
                           double rho_i = 2500.0, double rho_j = 2500.0)
  {
    const double mi = ball(ri, rho_i), mj = ball(rj, rho_j);
    const double Ii = 0.4 * mi * ri * ri, Ij = 0.4 * mj * rj * rj;
    return {model, mi, mj,
            Ii,    Ij, apf::ContactBodies::pair(ri, rj, mi * mj / (mi + mj), Ii * Ij / (Ii + Ij)),
            false};
  }

  static TwoBodies at_wall(const apf::ContactModel &model, double r, double rho = 2500.0)
  {
    const double m = ball(r, rho), I = 0.4 * m * r * r;
    return {model, m, 0.0, I, 0.0, apf::ContactBodies::wall(r, m, I), true};
  }

  TwoBodies(const apf::ContactModel &model, double mi, double mj, double Ii, double Ij,
            const apf::ContactBodies &bodies, bool wall) :
      model(model),
      mass{mi, mj}, inertia{Ii, Ij}, bodies(bodies),
      constants(apf::ContactConstants::make(model, bodies)), wall(wall)
  {
    live_in_plane(false);
  }

  static double ball(double r, double rho) { return 4.0 / 3.0 * apf::pi * r * r * r * rho; }

  void live_in_plane(bool yes)
  {
    apf::KernelChoice choice;
    choice.include(model);
    choice.planar = planar = yes;
    kernel = apf::contact_kernel(choice);
  }

  apf::JKR normal() const { return model.normal(bodies.R); }
  double effective_mass() const { return bodies.m; }

  // F_C and delta_C from eq (38) and (41), not from the code
  double pulloff_force() const { return 3.0 * apf::pi * model.surface.gamma * bodies.R; }
  double a0() const
  {
    const double R = bodies.R;
    return std::cbrt(9.0 * apf::pi * model.surface.gamma * R * R / model.surface.E);
  }
  double pulloff_overlap() const { return a0() * a0() / (2.0 * std::cbrt(6.0) * bodies.R); }
  double equilibrium_overlap() const { return a0() * a0() / (3.0 * bodies.R); }
  double sticking_speed() const
  {
    return std::sqrt(2.0 * 0.935503 * pulloff_force() * pulloff_overlap() / bodies.m);
  }

  // A time in which the contact changes by much: of the neck, or of an impact at this speed.
  double contact_time(double speed) const
  {
    const double E = model.surface.E * model.stiffness_scale;
    const double hertz = std::pow(bodies.m * bodies.m / (bodies.R * E * E * speed), 0.2);
    const double Fc = pulloff_force() * std::pow(model.stiffness_scale, 0.4);
    const double dc = pulloff_overlap() * std::pow(model.stiffness_scale, -0.4);
    return Fc > 0.0 ? std::min(hertz, std::sqrt(bodies.m * dc / Fc)) : hertz;
  }

  // Sets the two apart by the overlap, at rest, in contact.
  void place(double overlap)
  {
    for (double *u : {x, v, omega}) std::fill(u, u + 6, 0.0);
    x[0] = -(bodies.radius_i + bodies.radius_j - overlap);
    list.clear();
    touch();
  }

  void touch(const apf::ContactHistory &history = {})
  {
    list.add(0, 1, 0, list.kinds.add({constants, {}}), history);
  }

  // Sees the same contact from the other body.
  void swap()
  {
    const bool forwards = list.i[0] == 0;
    const apf::ContactHistory history = list.history_of(0).swapped(planar);
    std::swap(bodies.radius_i, bodies.radius_j);
    constants = apf::ContactConstants::make(model, bodies);
    list.clear();
    list.add(forwards, !forwards, 0, list.kinds.add({constants, {}}), history);
  }

  // The kernel alone; velocities are older than positions by `behind`.
  void contact_forces(double dt, double behind = 0.0)
  {
    if (wall) std::copy(x + 1, x + 3, x + 4);
    std::fill(f, f + 6, 0.0);
    std::fill(torque, torque + 6, 0.0);
    if (list.size())
      run_kernel(kernel, planar, list, 2, x, v, omega, f, torque, {dt, behind, dt}, &parts);
  }

  bool ended() const { return list.size() == 0 || list.ended(0); }

  // One step of velocity Verlet. The kernel sees the velocities of half a step before, as LAMMPS
  // has them then. An ended contact is left to the caller.
  void step(double dt)
  {
    kick(0.5 * dt);
    for (int c = 0; c < 6; c++) x[c] += dt * v[c];
    contact_forces(dt, 0.5 * dt);
    kick(0.5 * dt);
  }

  // along the normal, > 0 while they approach
  double closing_speed() const
  {
    const Vec3 d = separation();
    return dot(vec(v, 0) - vec(v, 1), d) / std::sqrt(dot(d, d));
  }

  static Vec3 vec(const double *u, int body)
  {
    return {u[3 * body], u[3 * body + 1], u[3 * body + 2]};
  }
  static void set(double *u, int body, const Vec3 &w)
  {
    u[3 * body] = w.x;
    u[3 * body + 1] = w.y;
    u[3 * body + 2] = w.z;
  }

  Vec3 separation() const { return vec(x, 1) - vec(x, 0); }
  Vec3 momentum() const { return mass[0] * vec(v, 0) + mass[1] * vec(v, 1); }
  Vec3 angular_momentum() const
  {
    Vec3 L{0.0, 0.0, 0.0};
    for (int b = 0; b < 2; b++)
      L = L + mass[b] * cross(vec(x, b), vec(v, b)) + inertia[b] * vec(omega, b);
    return L;
  }
  double kinetic_energy() const
  {
    double E = 0.0;
    for (int b = 0; b < 2; b++)
      E += 0.5 * mass[b] * norm2(vec(v, b)) + 0.5 * inertia[b] * norm2(vec(omega, b));
    return E;
  }

 private:
  void kick(double dt)
  {
    for (int b = 0; b < 2; b++)
      for (int c = 3 * b; c < 3 * b + 3; c++) {
        if (mass[b] > 0.0) v[c] += dt * (f[c] + load[c]) / mass[b];
        if (inertia[b] > 0.0) omega[c] += dt * (torque[c] + load_torque[c]) / inertia[b];
      }
  }
};

struct Rebound {
  double restitution = 0.0;    // 0 where the bodies stick
  double duration = 0.0, max_force = 0.0, max_overlap = 0.0;
};

// From first touch, with the velocities that the bodies have, until they part, or until they have
// been pulled back by their neck.
inline Rebound collide(TwoBodies &two, double dt)
{
  Rebound r;
  const double speed = two.closing_speed();
  two.contact_forces(0.0);
  for (bool returning = false; !two.ended(); r.duration += dt) {
    two.step(dt);
    r.max_force = apf_test::larger(r.max_force, std::sqrt(norm2(TwoBodies::vec(two.f, 0))));
    r.max_overlap = apf_test::larger(r.max_overlap, two.list.overlap(0));
    const bool closes = two.closing_speed() > 0.0;
    if (returning && closes) return r;
    returning = !closes;
  }
  r.restitution = -two.closing_speed() / speed;
  return r;
}

// Head-on along x at the relative speed V, `steps` steps per contact time.
inline Rebound head_on(TwoBodies &two, double V, int steps = 2000)
{
  two.place(0.0);
  const double share = two.wall ? 1.0 : two.mass[1] / (two.mass[0] + two.mass[1]);
  two.v[0] = V * share;
  two.v[3] = -V * (1.0 - share);
  return collide(two, two.contact_time(V) / steps);
}

}    // namespace apf_test

#endif
