// What tests of walls share: distances in a file, and surfaces of triangles.

#ifndef FLOWGRID_TEST_WALLS_H
#define FLOWGRID_TEST_WALLS_H

#include "flow/vtkhdf_file.h"
#include "vector.h"

#include "gtest/gtest.h"

#include <hdf5.h>

#include <fstream>

namespace flowgrid {

constexpr double pi = 3.14159265358979323846;

// arrays of a file, at their places
struct Distances {
  apf::VtkhdfFile file;
  int layers;

  explicit Distances(const std::string &path) : file(path), layers(file.grid().n[2])
  {
    if (layers == 2) layers = 1;
  }
  // Calls f(x, distance) for all nodes with |distance| <= most, which are exact; how many.
  template <class F> int for_near(const std::string &name, double most, F f) const
  {
    const auto &g = file.grid();
    const auto values = file.read(name, 1, 0, layers);
    int count = 0;
    for (size_t node = 0; node < values.size(); node++) {
      if (std::fabs(values[node]) > most) continue;
      const size_t at[3] = {node % g.n[0], node / g.n[0] % g.n[1], node / g.n[0] / g.n[1]};
      Point x;
      for (int c = 0; c < 3; c++) x[c] = g.origin[c] + at[c] * g.spacing[c];
      f(x, values[node]);
      count++;
    }
    return count;
  }
  template <class F> int expect(const std::string &name, double most, double error, F exact) const
  {
    return for_near(name, most, [&](const Point &x, double d) {
      EXPECT_NEAR(d, exact(x), error) << name << " at " << x[0] << " " << x[1] << " " << x[2];
    });
  }
};

inline double surface_error(const std::string &path, const std::string &array)
{
  double value = -1.0;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t at = H5Aopen_by_name(file, ("VTKHDF/PointData/" + array).c_str(), "surface_error",
                                   H5P_DEFAULT, H5P_DEFAULT);
  H5Aread(at, H5T_NATIVE_DOUBLE, &value);
  H5Aclose(at);
  H5Fclose(file);
  return value;
}

using Triangle = std::array<Point, 3>;

inline void write_stl(const std::string &path, const std::vector<Triangle> &triangles)
{
  std::ofstream out(path);
  out.precision(9);
  out << "solid s\n";
  for (const auto &t : triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const auto &p : t) out << "vertex " << p[0] << " " << p[1] << " " << p[2] << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid s\n";
}

// the unit cube, normals outward
inline std::vector<Triangle> cube()
{
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::vector<Triangle> result;
  for (const auto &q : quads) {
    Point x[4];
    for (int k = 0; k < 4; k++) x[k] = {double(q[k] & 1), double(q[k] >> 1 & 1), double(q[k] >> 2)};
    result.push_back({x[0], x[1], x[2]});
    result.push_back({x[0], x[2], x[3]});
  }
  return result;
}

// a sphere of radius 0.5, of 2 n x n facets on meridians and circles
inline std::vector<Triangle> sphere(int n)
{
  const auto at = [&](int i, int j) {
    const double a = pi * i / n, b = pi * (j % (2 * n)) / n;
    const double s = i == 0 || i == n ? 0.0 : std::sin(a);
    return Point{0.5 * s * std::cos(b), 0.5 * s * std::sin(b), 0.5 * std::cos(a)};
  };
  std::vector<Triangle> result;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < 2 * n; j++) {
      if (i > 0) result.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i < n - 1) result.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return result;
}

inline double outside_cube(const Point &x)
{
  double out = 0.0, in = -1e300;
  for (const double c : x) {
    const double over = std::max(-c, c - 1.0);
    in = std::max(in, over);
    out += over > 0.0 ? over * over : 0.0;
  }
  return in > 0.0 ? std::sqrt(out) : in;
}

}    // namespace flowgrid

#endif
