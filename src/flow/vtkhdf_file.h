// Reads point arrays of a VTKHDF file of type ImageData: a grid of equal cells, steady or a series
// in time. Sizes are checked against each other before anything is read or allocated; whatever is
// wrong is thrown as a std::runtime_error whose text says what, without the name of the file.
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/index.html

#ifndef APF_VTKHDF_FILE_H
#define APF_VTKHDF_FILE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace apf {

struct ImageGrid {
  int n[3];             // nodes along x, y, z
  double origin[3];     // coordinates of the first node               [length]
  double spacing[3];    // > 0                                         [length]

  std::size_t nodes() const { return std::size_t(n[0]) * n[1] * n[2]; }
};

class VtkhdfFile {
 public:
  explicit VtkhdfFile(const std::string &path);
  ~VtkhdfFile();
  VtkhdfFile(const VtkhdfFile &) = delete;
  VtkhdfFile &operator=(const VtkhdfFile &) = delete;

  const ImageGrid &grid() const { return image; }
  // of the frames of a series, ascending; empty if the file is steady     [time]
  const std::vector<double> &times() const { return step_times; }
  bool has(const std::string &array) const;
  std::vector<std::string> arrays() const;    // names of all point arrays, ascending

  // That an array is there, of float or double with so many components at each node of grid().
  void check(const std::string &array, int components) const;

  // Reads a frame (0 if the file is steady) of an array of float or double with so many components
  // per node: the lowest layers along z, components fastest, then x, y, z. All are within +-1e100.
  std::vector<double> read(const std::string &array, int components, int frame, int layers) const;

 private:
  // Which part of an array in the file a frame is: dimensions before those of the nodes
  struct Shape {
    bool has_time = false, flat = false;    // a dimension for time; none for z
    std::uint64_t offset = 0;               // of the frame, along time
  };

  std::string path;
  mutable std::array<long long, 4> stamp{};    // of the file as it was opened
  struct Read {
    std::string array;
    int components = 0, frame = 0, layers = 0;
    std::uint64_t hash = 0;    // of the numbers
  };
  mutable Read last;                      // what was read last
  std::int64_t file = -1, points = -1;    // of HDF5: the file, its group PointData
  ImageGrid image;
  std::vector<double> step_times;
  std::size_t nsteps = 0;    // of group Steps, 0 without it

  void open();
  std::vector<std::string> names() const;
  void check_unchanged() const;
  std::vector<double> values(std::int64_t data, const Read &what) const;
  void close();
  void read_grid();
  void read_steps();
  std::int64_t find(const std::string &array) const;
  Shape checked(std::int64_t data, const std::string &array, int components, int frame) const;
  std::uint64_t frame_offset(const std::string &array, int frame) const;
  Shape shape(const std::string &array, const std::vector<std::uint64_t> &dims, int components,
              int frame) const;
  void check_values(const std::string &array, int components, int frame,
                    const std::vector<double> &values) const;
};

}    // namespace apf

#endif
