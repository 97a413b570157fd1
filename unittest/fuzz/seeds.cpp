// Writes the first inputs of fuzz_vtkhdf into a folder: small right files and some wrong ones.

#include "vtkhdf_writer.h"

int main(int argc, char **argv)
{
  if (argc != 2) return 1;
  const std::string folder = std::string(argv[1]) + "/";
  auto flow = [](const double *x, double t, double *u) {
    u[0] = x[1] + t;
    u[1] = x[2];
    u[2] = 0.5;
  };
  auto write = [&](const std::string &name, VtkhdfWriter::Counts nodes, auto fill) {
    VtkhdfWriter file(folder + name, nodes, {0, 0, 0}, {1, 0.5, 0.25});
    fill(file);
  };
  write("steady.vtkhdf", {3, 4, 2}, [&](VtkhdfWriter &file) {
    file.field("velocity", 3, flow);
    file.field("distance", 1, flow);
  });
  write("series.vtkhdf", {3, 2, 2}, [&](VtkhdfWriter &file) {
    file.field("velocity", 3, flow, {0.0, 1.0, 2.0});
    file.steps({0.0, 1.0, 2.0});
    file.offsets("velocity", {0, 1, 1});
  });
  write("planar.vtkhdf", {4, 3, 1}, [&](VtkhdfWriter &file) {
    file.field("velocity", 3, flow, {}, H5T_NATIVE_FLOAT);
    file.mostly_missing("pressure", {1, 3, 4}, {1, 1, 2});
  });
  write("huge.vtkhdf", {3, 3, 3}, [&](VtkhdfWriter &file) {
    file.integers("WholeExtent", {0, 1000000, 0, 1000000, 0, 0});
    file.mostly_missing("velocity", {1, 1000001, 1000001, 3}, {1, 1, 1, 3});
  });
  return 0;
}
