// A file that comes into being once it is whole: it is written beside its place, as NAME.part, and
// moved there at the end. A disk that is full, or an error on the way, costs nothing that was there
// before.

#ifndef FLOWGRID_OUTPUT_FILE_H
#define FLOWGRID_OUTPUT_FILE_H

#include <filesystem>
#include <stdexcept>
#include <string>

namespace flowgrid {

class OutputFile {
 public:
  explicit OutputFile(const std::string &path) : path(path), place(path)
  {
    namespace fs = std::filesystem;
    std::error_code none;
    if (fs::exists(place, none)) {
      if (!fs::is_regular_file(place, none)) fail("is not a file that can be written");
      place = fs::canonical(place, none);    // where a link leads to
    }
    part = place.string() + ".part";
  }
  ~OutputFile()
  {
    std::error_code none;
    std::filesystem::remove(part, none);    // gone if it was kept
  }
  OutputFile(const OutputFile &) = delete;
  OutputFile &operator=(const OutputFile &) = delete;

  const std::string &while_written() const { return part; }
  void keep() const
  {
    std::error_code error;
    std::filesystem::rename(part, place, error);
    if (error) fail("cannot be written: " + error.message());
  }
  [[noreturn]] void fail(const std::string &why) const
  {
    throw std::runtime_error(path + ": " + why);
  }

 private:
  std::string path;    // as the user names it
  std::filesystem::path place;
  std::string part;
};

}    // namespace flowgrid

#endif
