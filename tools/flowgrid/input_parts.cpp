#include "input_parts.h"

#include "../../src/flow/regular_file.h"
#include "foam_case.h"

#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLFileReadTester.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <vector>

namespace fs = std::filesystem;

namespace flowgrid {

namespace {

  [[noreturn]] void stop(const std::string &file, const std::string &why)
  {
    throw std::runtime_error(file + ": " + why);
  }

  // a pipe, a socket or a device
  bool is_special(const fs::file_status &status)
  {
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
  }

  // Whether VTK would read other files with a file: by the type that is written in it, as VTK does,
  // since its ending may say anything.
  bool may_name_files(const fs::path &path)
  {
    vtkNew<vtkXMLFileReadTester> tester;
    tester->SetFileName(path.c_str());
    if (!tester->TestReadFile() || !tester->GetFileDataType()) return false;
    for (const char *alone :
         {"ImageData", "RectilinearGrid", "StructuredGrid", "UnstructuredGrid", "PolyData"})
      if (std::strcmp(tester->GetFileDataType(), alone) == 0) return false;
    return true;
  }

  // As blocks have them (file="..."), and pieces of files that were written in parallel (Source).
  // By the parser of VTK: the same name may be written in many ways.
  std::vector<std::string> files_named_in(const fs::path &path)
  {
    std::vector<std::string> names;
    vtkNew<vtkXMLDataParser> parser;
    parser->SetFileName(path.c_str());
    if (!parser->Parse() || !parser->GetRootElement()) return names;    // nor does VTK read it
    std::vector<vtkXMLDataElement *> elements{parser->GetRootElement()};
    while (!elements.empty()) {
      auto *element = elements.back();
      elements.pop_back();
      for (const char *attribute : {"file", "Source"}) {
        const char *name = element->GetAttribute(attribute);
        if (name && name[0]) names.emplace_back(name);
      }
      for (int k = 0; k < element->GetNumberOfNestedElements(); k++)
        elements.push_back(element->GetNestedElement(k));
    }
    return names;
  }

  // Each file counts once, though a block may be named many times.
  class Parts {
   public:
    double bytes = 0.0;

    void add(const fs::path &path)
    {
      std::error_code none;
      const fs::path self = fs::canonical(path, none);
      if (std::find(above.begin(), above.end(), self) != above.end())
        stop(path, "is a block of itself");
      if (!known.insert(self).second) return;
      bytes += static_cast<double>(fs::file_size(path));
      if (!may_name_files(path)) return;
      above.push_back(self);
      for (const auto &name : files_named_in(path)) {
        if (!is_below(name))
          stop(path,
               "names the file " + name + ", which is not in its folder or below: it is not read");
        const fs::path other = (path.parent_path() / name).lexically_normal();
        const auto status = fs::status(other, none);
        if (is_special(status) || fs::is_directory(status))
          stop(path, "names " + name + ", which is not a regular file: it is not read");
        if (fs::is_regular_file(status)) add(other);
      }
      above.pop_back();
    }
    // Links to folders are followed, as VTK does: a mesh may be kept elsewhere. Of what is in the
    // folder itself VTK reads nothing.
    void add_folder(const fs::path &path)
    {
      const auto options = fs::directory_options::follow_directory_symlink |
          fs::directory_options::skip_permission_denied;
      std::error_code failed, none;
      fs::recursive_directory_iterator it(path, options, failed);
      for (; !failed && it != fs::end(it); it.increment(failed)) {
        if (it.depth() > 0 && is_special(it->status(none)))
          stop(it->path(), "is not a regular file: it is not read");
        const bool fresh = known.insert(fs::canonical(it->path(), none)).second;
        if (it->is_directory(none) && !fresh) it.disable_recursion_pending();
        if (it->is_regular_file(none) && fresh) bytes += static_cast<double>(it->file_size(none));
      }
      if (failed) bytes = INFINITY;    // what there is is not known
    }

   private:
    std::vector<fs::path> above;    // those that name the one that is looked at
    std::set<fs::path> known;
  };

}    // namespace

// VTK takes names with a slash, or with a colon as second character, as they are.
bool is_below(const std::string &name)
{
  if (name.empty() || std::strchr("/\\~", name[0]) || (name.size() > 1 && name[1] == ':'))
    return false;
  for (size_t begin = 0; begin <= name.size();) {
    const size_t end = std::min(name.find_first_of("/\\", begin), name.size());
    if (name.compare(begin, end - begin, "..") == 0) return false;
    begin = end + 1;
  }
  return true;
}

void check_is_file(const std::string &path)
{
  std::error_code none;
  if (!fs::exists(path, none)) stop(path, "does not exist");
  if (const auto why = apf::why_not_a_file(path); !why.empty()) stop(path, why);
}

double bytes_of_input(const std::string &path)
{
  Parts parts;
  if (FoamCase::is_path_of_one(path))
    parts.add_folder(fs::is_directory(path) ? fs::path(path) : fs::absolute(path).parent_path());
  else {
    check_is_file(path);
    parts.add(path);
  }
  return parts.bytes;
}

}    // namespace flowgrid
