// What may be opened for reading: a pipe to which nobody writes would be waited for, a device has
// no end, and a folder gives no sense.

#ifndef APF_REGULAR_FILE_H
#define APF_REGULAR_FILE_H

#include <filesystem>
#include <string>
#include <system_error>

namespace apf {

// Why a path is not to be opened; empty for a regular file, or a link to one, and for what is not
// there, of which opening knows more.
inline std::string why_not_a_file(const std::string &path)
{
  namespace fs = std::filesystem;
  std::error_code none;
  const auto status = fs::status(path, none);
  if (fs::is_directory(status)) return "is a folder, not a file";
  if (fs::exists(status) && !fs::is_regular_file(status)) return "is not a regular file";
  return {};
}

}    // namespace apf

#endif
