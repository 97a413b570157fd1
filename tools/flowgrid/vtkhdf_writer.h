// Writes point arrays on a Cartesian grid as VTKHDF ImageData, steady or a series in time.
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/index.html
// A grid of one layer along z is written as two equal ones: VTK 9.1 cannot open a single one.

#ifndef FLOWGRID_VTKHDF_WRITER_H
#define FLOWGRID_VTKHDF_WRITER_H

#include "mapping.h"
#include "output_file.h"

#include <hdf5.h>

#include <string>
#include <vector>

namespace flowgrid {

class VtkhdfWriter {
 public:
  // times: empty for a steady file. Throws std::runtime_error.
  VtkhdfWriter(const std::string &path, const Grid &grid, const std::vector<double> &times,
               bool compress);
  ~VtkhdfWriter();
  VtkhdfWriter(const VtkhdfWriter &) = delete;
  VtkhdfWriter &operator=(const VtkhdfWriter &) = delete;

  // `components` numbers per node, of frame 0, 1, ...
  void write(const std::string &name, int components, int frame, const std::vector<double> &values);
  // Signed distances, the same at all times; surface_error: largest known distance between what the
  // wall was given by and its true surface                                           [length]
  void write_distance(const std::string &name, const std::vector<double> &values,
                      double surface_error);
  // all has been written, and the file is there; an error of the disk is thrown here
  void close();

 private:
  Grid grid;
  int layers, frames;
  bool compress;
  OutputFile output;
  hid_t file = -1, root = -1, points = -1, offsets = -1;

  void attribute(hid_t at, const char *name, hid_t type, hsize_t count, const void *values);
  hid_t create(const std::string &name, int components, bool steady);
  void put(hid_t set, int frame, const std::vector<double> &values);
  void check(bool good, const char *what) const;
};

}    // namespace flowgrid

#endif
