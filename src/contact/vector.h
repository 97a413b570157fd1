// Small vectors whose components the compiler keeps in registers, and plain numbers that answer to
// the same names, so that a law is written once for the plane and for space. A Real is a double, or
// a Pack of them (pack.h): the law is also written once for one contact and for a block.

#ifndef APF_VECTOR_H
#define APF_VECTOR_H

#include <cmath>

// Laws are inlined into the kernel's loop whatever the compiler thinks of their size: a call that
// is left over would take numbers out of their registers. With sanitizers gcc needs more than six
// minutes and Gbytes for such a loop, and 25 s for calls.
#ifdef __SANITIZE_ADDRESS__
#define APF_INLINE inline
#else
#define APF_INLINE inline __attribute__((always_inline))
#endif

namespace apf {

constexpr double pi = 3.14159265358979323846;

APF_INLINE double norm2(double a)
{
  return a * a;
}
APF_INLINE double smaller(double a, double b)
{
  return a < b ? a : b;
}
APF_INLINE double larger(double a, double b)
{
  return a > b ? a : b;
}
APF_INLINE double magnitude(double a)
{
  return std::fabs(a);
}
APF_INLINE double select(bool yes, double a, double b)
{
  return yes ? a : b;
}
APF_INLINE bool any(bool yes)
{
  return yes;
}

template <class Real> struct Vector2 {
  Real x, y;

  friend APF_INLINE Vector2 operator+(const Vector2 &a, const Vector2 &b)
  {
    return {a.x + b.x, a.y + b.y};
  }
  friend APF_INLINE Vector2 operator-(const Vector2 &a, const Vector2 &b)
  {
    return {a.x - b.x, a.y - b.y};
  }
  friend APF_INLINE Vector2 operator*(const Real &c, const Vector2 &a)
  {
    return {c * a.x, c * a.y};
  }
  friend APF_INLINE Real dot(const Vector2 &a, const Vector2 &b) { return a.x * b.x + a.y * b.y; }
};

template <class Real> struct Vector3 {
  Real x, y, z;

  friend APF_INLINE Vector3 operator+(const Vector3 &a, const Vector3 &b)
  {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend APF_INLINE Vector3 operator-(const Vector3 &a, const Vector3 &b)
  {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend APF_INLINE Vector3 operator-(const Vector3 &a) { return {-a.x, -a.y, -a.z}; }
  friend APF_INLINE Vector3 operator*(const Real &c, const Vector3 &a)
  {
    return {c * a.x, c * a.y, c * a.z};
  }
  friend APF_INLINE Real dot(const Vector3 &a, const Vector3 &b)
  {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend APF_INLINE Vector3 cross(const Vector3 &a, const Vector3 &b)
  {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend APF_INLINE Real norm2(const Vector3 &a) { return dot(a, a); }
  template <class Mask>
  friend APF_INLINE Vector3 select(const Mask &mask, const Vector3 &a, const Vector3 &b)
  {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
  }
};

using Vec2 = Vector2<double>;
using Vec3 = Vector3<double>;

// Roots and reciprocals where four digits do, or twelve; a Pack may have quicker ones.
APF_INLINE double rough_root(double a)
{
  return std::sqrt(a);
}
APF_INLINE double rough_inverse(double a)
{
  return 1.0 / a;
}
APF_INLINE double close_inverse(double a)
{
  return 1.0 / a;
}
APF_INLINE double inverse(double a)
{
  return 1.0 / a;
}
APF_INLINE double inverse_root(double a)
{
  return 1.0 / std::sqrt(a);
}

// Reciprocals of all at once by one division: that costs as much as a dozen products, and binds the
// kernel.
template <class Real> APF_INLINE void invert(Real &a, Real &b)
{
  const Real both = 1.0 / (a * b), old = a;
  a = both * b;
  b = both * old;
}
template <class Real> APF_INLINE void invert(Real &a, Real &b, Real &c)
{
  const Real ab = a * b, all = 1.0 / (ab * c), both = all * c, old = a;
  c = all * ab;
  a = both * b;
  b = both * old;
}

}    // namespace apf

#endif
