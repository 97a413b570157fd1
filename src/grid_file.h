// A VTKHDF file whose grid covers the box: opened on one rank of each node, checked, and put into
// memory that the ranks of the node share. What is in the file is the business of derived classes.

#ifndef LMP_GRID_FILE_H
#define LMP_GRID_FILE_H

#include "flow/word_hash.h"
#include "node_memory.h"
#include "pointers.h"

#include "flow/lattice.h"
#include "flow/vtkhdf_file.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class GridFile : protected Pointers {
 public:
  // All ranks call these.
  void check_box(int iarg) const;    // that it is still the box that the grid was made for
  std::string extent() const;        // for errors
  const std::string &name() const { return path; }

 protected:
  // command: for errors, as "Fix flow/field"; iarg: the file's word in it
  GridFile(LAMMPS *, const char *command, const std::string &path, int iarg);
  ~GridFile() override { close(); }
  GridFile(const GridFile &) = delete;
  GridFile &operator=(const GridFile &) = delete;

  std::string command, path;
  int position;                             // of the file's word while the command is parsed
  std::unique_ptr<apf::VtkhdfFile> file;    // of the rank that reads
  NodeMemory numbers;
  apf::ImageGrid image{};
  apf::Lattice lattice{};
  apf::WordHash
      digest;    // of what this rank has read from the file, to be compared with other nodes

  // Lets the ranks that read do so; an error of one of them is one of all, and so is a node that
  // has read something else than the others.
  void attempt(const std::function<void()> &work);
  // the same, of work that looks at names and attributes of the file only
  void look(const std::function<void()> &work);
  // what an attempt may call: the numbers of an array
  std::vector<double> read(const std::string &array, int components, int frame = 0);
  void close();
  // Memory for so many numbers. Errors if there is not enough.
  void allocate(std::size_t count);
  // The lattice of the file in the box, which it must cover unless it may be continued; advice:
  // what the error says to do then.
  void make_lattice(bool continued, const char *advice);
  // An array of the file, with so many components per node, at the different nodes of the lattice.
  std::vector<double> nodes_of(const std::vector<double> &values, int components) const;
  int layers() const { return lattice.dims == 2 ? 1 : image.n[2]; }

 private:
  bool goes_on = false;    // beyond the grid as at its border
  std::string advice;

  bool periodic(int axis, int iarg) const;
};

}    // namespace LAMMPS_NS

#endif
