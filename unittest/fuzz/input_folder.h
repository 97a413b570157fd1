// A folder in memory for the files of one input; it goes when the fuzzer ends.

#ifndef APF_FUZZ_INPUT_FOLDER_H
#define APF_FUZZ_INPUT_FOLDER_H

#include "require.h"

#include <cstdio>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace fuzz {

class InputFolder {
 public:
  InputFolder() : path("/dev/shm/apf-fuzz-" + std::to_string(getpid()))
  {
    std::filesystem::create_directories(path);
  }
  ~InputFolder() { std::filesystem::remove_all(path); }
  InputFolder(const InputFolder &) = delete;
  InputFolder &operator=(const InputFolder &) = delete;

  std::string operator/(const std::string &name) const { return path + "/" + name; }
  void enter() const { std::filesystem::current_path(path); }
  void clear() const
  {
    for (const auto &entry : std::filesystem::directory_iterator(path))
      std::filesystem::remove_all(entry);
  }
  std::string write(const std::string &name, const unsigned char *data, std::size_t size) const
  {
    std::string file = *this / name;
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    FILE *out = std::fopen(file.c_str(), "wb");
    require(out && std::fwrite(data, 1, size, out) == size, "room for the input");
    std::fclose(out);
    return file;
  }

 private:
  std::string path;
};

}    // namespace fuzz

#endif
