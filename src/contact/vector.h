// Small vectors whose components the compiler keeps in registers, and plain numbers that answer to
// the same names, so that a law is written once for the plane and for space.

#ifndef APF_VECTOR_H
#define APF_VECTOR_H

#include <cmath>

// Laws are inlined into the kernel's loop whatever the compiler thinks of their size: a call that
// is left over would keep the loop from becoming vector code.
#define APF_INLINE inline __attribute__((always_inline))

namespace apf {

struct Vec2 {
  double x, y;
};

struct Vec3 {
  double x, y, z;
};

APF_INLINE Vec2 operator+(const Vec2 &a, const Vec2 &b)
{
  return {a.x + b.x, a.y + b.y};
}
APF_INLINE Vec2 operator-(const Vec2 &a, const Vec2 &b)
{
  return {a.x - b.x, a.y - b.y};
}
APF_INLINE Vec2 operator*(double c, const Vec2 &a)
{
  return {c * a.x, c * a.y};
}
APF_INLINE double dot(const Vec2 &a, const Vec2 &b)
{
  return a.x * b.x + a.y * b.y;
}

APF_INLINE Vec3 operator+(const Vec3 &a, const Vec3 &b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
APF_INLINE Vec3 operator-(const Vec3 &a, const Vec3 &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
APF_INLINE Vec3 operator-(const Vec3 &a)
{
  return {-a.x, -a.y, -a.z};
}
APF_INLINE Vec3 operator*(double c, const Vec3 &a)
{
  return {c * a.x, c * a.y, c * a.z};
}
APF_INLINE double dot(const Vec3 &a, const Vec3 &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
APF_INLINE Vec3 cross(const Vec3 &a, const Vec3 &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

APF_INLINE double norm2(double a)
{
  return a * a;
}
APF_INLINE double norm2(const Vec3 &a)
{
  return dot(a, a);
}

}    // namespace apf

#endif
