// Compiled once per instruction set (CMakeLists.txt); APF_ISA names the namespace of this copy.

#include "contact_kernel.h"

#include <type_traits>

#ifndef APF_ISA
#define APF_ISA baseline
#endif

namespace apf::APF_ISA {

constexpr int width = 8;    // contacts per block: one AVX-512 register, two AVX2, four SSE2

// One block of contacts, transposed: [component][lane], so that each line is one vector register.
struct Block {
  double d[3][width], v[3][width], spin_i[3][width], spin_j[3][width];
  double force[3][width], torque_i[3][width], torque_j[3][width];
};

template <class Frame> struct Access;

template <> struct Access<SpaceFrame> {
  static APF_INLINE Vec3 vector(const double (*a)[width], int l)
  {
    return {a[0][l], a[1][l], a[2][l]};
  }
  static APF_INLINE Vec3 spin(const double (*a)[width], int l) { return vector(a, l); }
  static APF_INLINE void set(double (*a)[width], int l, const Vec3 &u)
  {
    a[0][l] = u.x;
    a[1][l] = u.y;
    a[2][l] = u.z;
  }
  static APF_INLINE void set_spin(double (*a)[width], int l, const Vec3 &u) { set(a, l, u); }
  static APF_INLINE Vec3 load(double *const *h, int k) { return {h[0][k], h[1][k], h[2][k]}; }
  static APF_INLINE void store(double *const *h, int k, const Vec3 &u)
  {
    h[0][k] = u.x;
    h[1][k] = u.y;
    h[2][k] = u.z;
  }
  static APF_INLINE void copy(double *to, const Vec3 &u)
  {
    to[0] = u.x;
    to[1] = u.y;
    to[2] = u.z;
  }
};

template <> struct Access<PlaneFrame> {
  static APF_INLINE Vec2 vector(const double (*a)[width], int l) { return {a[0][l], a[1][l]}; }
  static APF_INLINE double spin(const double (*a)[width], int l) { return a[2][l]; }
  static APF_INLINE void set(double (*a)[width], int l, const Vec2 &u)
  {
    a[0][l] = u.x;
    a[1][l] = u.y;
  }
  static APF_INLINE void set_spin(double (*a)[width], int l, double u) { a[2][l] = u; }
  static APF_INLINE double load(double *const *h, int k) { return h[0][k]; }
  static APF_INLINE void store(double *const *h, int k, double u) { h[0][k] = u; }
};

// Where the list's arrays start, taken once per call.
struct Arrays {
  double *constants[ContactList::n_constants];
  double *sliding[3], *rolling[3], *normal[3], *twisting, *overlap;

  explicit Arrays(ContactList &list)
  {
    for (int n = 0; n < ContactList::n_constants; n++) constants[n] = list.constants[n].data();
    for (int n = 0; n < 3; n++) {
      sliding[n] = list.history[n].data();
      rolling[n] = list.history[3 + n].data();
      normal[n] = list.history[7 + n].data();
    }
    twisting = list.history[6].data();
    overlap = list.overlap.data();
  }

  // spelled out, because a loop over members would go through memory and stop vectorisation
  APF_INLINE ContactConstants at(int k) const
  {
    return {constants[0][k],  constants[1][k],  constants[2][k],  constants[3][k],
            constants[4][k],  constants[5][k],  constants[6][k],  constants[7][k],
            constants[8][k],  constants[9][k],  constants[10][k], constants[11][k],
            constants[12][k], constants[13][k], constants[14][k], constants[15][k],
            constants[16][k], constants[17][k], constants[18][k]};
  }
};
static_assert(ContactList::n_constants == 19, "Arrays::at lists every constant");

template <class Frame> using RowOf = std::conditional_t<Frame::planar, PlaneRow, SpaceRow>;

template <class Frame>
void gather(const ContactList &list, const RowOf<Frame> *rows, int first, int n, Block &block)
{
  constexpr int spin0 = 3 - RowOf<Frame>::spin_dim;
  for (int l = 0; l < width; l++) {
    const int k = first + (l < n ? l : n - 1);    // an incomplete block repeats its last contact
    const auto &i = rows[list.i[k]], &j = rows[list.j[k]];
    for (int c = 0; c < i.dim; c++) {
      block.d[c][l] = j.x[c] - i.x[c];
      block.v[c][l] = i.v[c] - j.v[c];
    }
    for (int c = 0; c < i.spin_dim; c++) {
      block.spin_i[spin0 + c][l] = i.omega[c];
      block.spin_j[spin0 + c][l] = j.omega[c];
    }
  }
}

template <class Frame, bool torques>
void scatter(const ContactList &list, RowOf<Frame> *rows, int first, int n, const Block &block)
{
  constexpr int spin0 = 3 - RowOf<Frame>::spin_dim;
  for (int l = 0; l < n; l++) {
    const int k = first + l;
    auto &i = rows[list.i[k]], &j = rows[list.j[k]];
    for (int c = 0; c < i.dim; c++) {
      i.f[c] += block.force[c][l];
      j.f[c] -= block.force[c][l];
    }
    if constexpr (torques)
      for (int c = 0; c < i.spin_dim; c++) {
        i.torque[c] += block.torque_i[spin0 + c][l];
        j.torque[c] += block.torque_j[spin0 + c][l];
      }
  }
}

template <class Frame>
ContactParts report(const ContactConstants &c, const Arrays &arrays, const Block &block, int k,
                    int l, const ContactOutput<Frame> &out)
{
  ContactParts p{};
  p.overlap = out.overlap;
  p.contact_radius = c.R * out.s * out.s;
  p.elastic = out.elastic;
  p.damping = out.damping;
  p.twisting = out.twisting;
  const double s3 = out.s * out.s * out.s;
  const double kt = c.kt * out.s * out.s;
  double sliding2, rolling2;
  if constexpr (Frame::planar) {
    const Vec2 d{block.d[0][l], block.d[1][l]};
    const Vec2 t = Frame{(1.0 / std::sqrt(dot(d, d))) * d}.force(out.sliding);
    p.sliding[0] = t.x;
    p.sliding[1] = t.y;
    p.rolling[2] = out.rolling;
    p.force[0] = out.force.x;
    p.force[1] = out.force.y;
    sliding2 = norm2(arrays.sliding[0][k]);
    rolling2 = norm2(arrays.rolling[0][k]);
  } else {
    Access<Frame>::copy(p.sliding, out.sliding);
    Access<Frame>::copy(p.rolling, out.rolling);
    Access<Frame>::copy(p.force, out.force);
    sliding2 = norm2(Access<Frame>::load(arrays.sliding, k));
    rolling2 = norm2(Access<Frame>::load(arrays.rolling, k));
  }
  if (out.overlap >= c.break_overlap) {
    const double twist2 = arrays.twisting[k] * arrays.twisting[k];
    p.elastic_energy = JKR{c.R, c.K, c.neck}.energy(out.s);
    p.sliding_energy = 0.5 * kt * sliding2;
    p.rolling_energy = 0.5 * c.roll_k * s3 * rolling2 * c.inv_R;
    p.twisting_energy = 0.25 * kt * p.contact_radius * p.contact_radius * twist2;
  }
  return p;
}

// Everything that belongs to one lane. It must not share local structures with the loop around it:
// "omp simd" would put those into memory, one per lane, and nothing would become vector code.
template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling, bool reports>
APF_INLINE void lane(const Arrays &arrays, Block &block, int k, int l, ContactTimes times,
                     ContactParts *parts)
{
  using A = Access<Frame>;
  const ContactInput<Frame> in{A::vector(block.d, l), A::vector(block.v, l),
                               A::spin(block.spin_i, l), A::spin(block.spin_j, l)};
  ContactMemory<Frame> memory;
  if constexpr (sliding) memory.sliding = A::load(arrays.sliding, k);
  if constexpr (rolling) memory.rolling = A::load(arrays.rolling, k);
  if constexpr (twisting && !Frame::planar) memory.twisting = arrays.twisting[k];
  if constexpr ((sliding || rolling) && !Frame::planar)
    memory.normal = Access<SpaceFrame>::load(arrays.normal, k);

  const auto out =
      contact_law<Frame, adhesion, sliding, twisting, rolling>(arrays.at(k), in, times, memory);

  if (!reports || times.advance > 0.0) {    // a look at the parts must not change the run
    if constexpr (sliding) A::store(arrays.sliding, k, memory.sliding);
    if constexpr (rolling) A::store(arrays.rolling, k, memory.rolling);
    if constexpr (twisting && !Frame::planar) arrays.twisting[k] = memory.twisting;
    if constexpr ((sliding || rolling) && !Frame::planar)
      Access<SpaceFrame>::store(arrays.normal, k, memory.normal);
  }
  arrays.overlap[k] = out.overlap;
  A::set(block.force, l, out.force);
  A::set_spin(block.torque_i, l, out.torque_i);
  A::set_spin(block.torque_j, l, out.torque_j);
  if constexpr (reports) parts[k] = report<Frame>(arrays.at(k), arrays, block, k, l, out);
}

template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling>
int kernel(ContactList &list, Bodies &bodies, ContactTimes times, ContactParts *parts)
{
  auto *rows = bodies.rows<RowOf<Frame>>();
  const Arrays arrays(list);
  Block block;
  const int size = list.size();
  for (int first = 0; first < size; first += width) {
    const int n = (size - first < width) ? size - first : width;
    gather<Frame>(list, rows, first, n, block);
    if (n == width && !parts) {
#pragma omp simd
      for (int l = 0; l < width; l++)
        lane<Frame, adhesion, sliding, twisting, rolling, false>(arrays, block, first + l, l, times,
                                                                 nullptr);
    } else if (!parts) {
      for (int l = 0; l < n; l++)
        lane<Frame, adhesion, sliding, twisting, rolling, false>(arrays, block, first + l, l, times,
                                                                 nullptr);
    } else {
      for (int l = 0; l < n; l++)
        lane<Frame, adhesion, sliding, twisting, rolling, true>(arrays, block, first + l, l, times,
                                                                parts);
    }
    scatter<Frame, sliding || twisting || rolling>(list, rows, first, n, block);
  }
  int ended = 0;
  for (int k = 0; k < size; k++) ended += list.ended(k);
  return ended;
}

template <class Frame, bool adhesion, bool sliding, bool twisting>
ContactKernel with_rolling(const KernelChoice &c)
{
  return c.rolling ? kernel<Frame, adhesion, sliding, twisting, true>
                   : kernel<Frame, adhesion, sliding, twisting, false>;
}

template <class Frame, bool adhesion, bool sliding>
ContactKernel with_twisting(const KernelChoice &c)
{
  if constexpr (sliding &&
                !Frame::planar)    // its limit is the friction limit: none without sliding
    if (c.twisting) return with_rolling<Frame, adhesion, sliding, true>(c);
  return with_rolling<Frame, adhesion, sliding, false>(c);
}

template <class Frame, bool adhesion> ContactKernel with_sliding(const KernelChoice &c)
{
  return c.sliding ? with_twisting<Frame, adhesion, true>(c)
                   : with_twisting<Frame, adhesion, false>(c);
}

template <class Frame> ContactKernel with_adhesion(const KernelChoice &c)
{
  return c.adhesion ? with_sliding<Frame, true>(c) : with_sliding<Frame, false>(c);
}

ContactKernel contact_kernel(const KernelChoice &choice)
{
  return choice.planar ? with_adhesion<PlaneFrame>(choice) : with_adhesion<SpaceFrame>(choice);
}

}    // namespace apf::APF_ISA
