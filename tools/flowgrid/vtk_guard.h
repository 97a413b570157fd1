// VTK's readers trust what they read: a damaged file may make them crash, or ask for any amount of
// memory. Here is what can be checked of what they give, and what the program does about the rest.

#ifndef FLOWGRID_VTK_GUARD_H
#define FLOWGRID_VTK_GUARD_H

#include "input_parts.h"

#include <new>
#include <stdexcept>
#include <string>

#include <sys/resource.h>

class vtkDataSet;

namespace flowgrid {

// That the corners of cells are points of the mesh, and as many as the types of the cells have,
// which VTK knows: it follows what is in the file. Throws std::runtime_error.
void check_cells(const std::string &file, vtkDataSet *set);

// Once in main(): a crash or exit while VTK reads ends the program with status 1 and a message that
// names the file, and memory beyond what the machine has is refused to the program, as
// std::bad_alloc, instead of given until the kernel kills it.
void guard_against_files();

// Until it is destroyed: notes the file that is read, and bounds the time that it may take; from
// limit_for() on memory and time of so many bytes of files.
class ReadByVtk {
 public:
  explicit ReadByVtk(const std::string &file);
  ~ReadByVtk();
  void limit_for(double bytes) const;
  ReadByVtk(const ReadByVtk &) = delete;
  ReadByVtk &operator=(const ReadByVtk &) = delete;

 private:
  const char *name_before;    // of one within another
  rlim_t limit_before;
};

// Does the work that reads a file by VTK; std::bad_alloc, and what VTK throws at numbers that it
// trusted, become errors with its name; ours are std::runtime_error. What the file names is looked
// at before, in the time that the file alone may take.
template <class Work> void by_vtk(const std::string &file, const Work &work)
{
  const ReadByVtk reading(file);
  try {
    reading.limit_for(bytes_of_input(file));
    work();
  } catch (const std::bad_alloc &) {
    throw std::runtime_error(file + ": asks for more memory than there is, or is damaged");
  } catch (const std::logic_error &error) {
    throw std::runtime_error(file + ": is damaged; VTK says: " + error.what());
  }
}

}    // namespace flowgrid

#endif
