#include "foam_case.h"

#include "mesh_walls.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkStaticPointLocator.h>

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace flowgrid {

namespace {

  // By hand, since words come from files: std::regex would take them for expressions, and calls
  // itself for each character.
  const char *const white = " \t\r\n\v\f";

  bool ends_word(char c)
  {
    return std::strchr(white, c) || std::strchr(";{}()\"", c);
  }

  // text between the braces that follow `word` in a dictionary, empty if it is not there
  std::string block_of(const std::string &text, const std::string &word)
  {
    for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; at++) {
      if (at > 0 && !ends_word(text[at - 1])) continue;
      size_t begin = at + word.size();
      if (text[begin] == '"') begin++;
      begin = text.find_first_not_of(white, begin);
      if (begin == std::string::npos || text[begin] != '{') continue;
      int depth = 1;
      size_t end = ++begin;
      for (; end < text.size() && depth > 0; end++)
        depth += text[end] == '{' ? 1 : text[end] == '}' ? -1 : 0;
      return text.substr(begin, end - begin - 1);
    }
    return {};
  }

  // the word that follows `type`, and is followed by a semicolon
  std::string type_of(const std::string &block)
  {
    const std::string key = "type";
    for (size_t at = 0; (at = block.find(key, at)) != std::string::npos; at += key.size()) {
      if (at > 0 && !ends_word(block[at - 1])) continue;
      const size_t begin = block.find_first_not_of(white, at + key.size());
      if (begin == std::string::npos || begin == at + key.size()) continue;
      size_t end = begin;
      while (std::isalnum(static_cast<unsigned char>(block[end])) || block[end] == '_') end++;
      const size_t after = block.find_first_not_of(white, end);
      if (end > begin && after != std::string::npos && block[after] == ';')
        return block.substr(begin, end - begin);
    }
    return {};
  }

  // of a file, or of the one that gzip made of it; empty if there is neither
  std::string contents(const std::string &path)
  {
    std::string text;
    gzFile in = gzopen(fs::exists(path) ? path.c_str() : (path + ".gz").c_str(), "rb");
    if (!in) return text;
    char part[4096];
    for (int n; (n = gzread(in, part, sizeof(part))) > 0;) text.append(part, n);
    gzclose(in);
    return text;
  }

}    // namespace

/* ---------------------------------------------------------------------- */

bool FoamCase::is_path_of_one(const std::string &path)
{
  std::string end = fs::path(path).extension().string();
  for (char &c : end) c = static_cast<char>(std::tolower(c));
  return fs::is_directory(path) || end == ".foam" || end == ".openfoam";
}

FoamCase::FoamCase(const std::string &path, const std::vector<std::string> &walls) :
    given(path), home(fs::is_directory(path) ? path : fs::path(path).parent_path().string()),
    wall_names(walls)
{
  if (home.empty()) home = ".";
  if (!fs::exists(home + "/system/controlDict"))
    throw std::runtime_error(path + ": is no OpenFOAM case: there is no system/controlDict");
}

void FoamCase::set_patch(size_t number, const std::string &name, vtkPolyData *faces)
{
  if (number == patches.size()) {
    patches.push_back({name, faces, {}, false});
    return;
  }
  auto &patch = patches[number];
  if (faces->GetNumberOfPoints() != patch.faces->GetNumberOfPoints())
    throw std::runtime_error(given + ": patch " + name + " has " +
                             std::to_string(faces->GetNumberOfPoints()) + " points at a time, " +
                             std::to_string(patch.faces->GetNumberOfPoints()) + " at another");
  patch.faces = faces;
}

void FoamCase::find_points(vtkDataSet *mesh)
{
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  const std::string boundary = contents(home + "/constant/polyMesh/boundary");
  for (auto &patch : patches) {
    patch.wall = type_of(block_of(boundary, patch.name)) == "wall";
    for (const auto &name : wall_names) patch.wall |= name == patch.name;
    for (vtkIdType p = 0; p < patch.faces->GetNumberOfPoints(); p++) {
      const auto nearest = locator->FindClosestPoint(patch.faces->GetPoint(p));
      if (nearest < 0)
        throw std::runtime_error(given + ": patch " + patch.name +
                                 " has a point that is near none of the mesh");
      patch.point.push_back(static_cast<int>(nearest));
    }
  }
  for (const auto &name : wall_names)
    if (std::none_of(patches.begin(), patches.end(), [&](const Patch &patch) {
          return patch.name == name;
        }))
      throw std::runtime_error(given + ": has no patch " + name + ", which --wall names");
}

std::vector<int> FoamCase::wall_points() const
{
  std::set<int> points;
  for (const auto &patch : patches)
    if (patch.wall) points.insert(patch.point.begin(), patch.point.end());
  return {points.begin(), points.end()};
}

/* ---------------------------------------------------------------------- */

// The case's words on the borders of a field, from its last time: they do not change in time.
const std::string &FoamCase::boundary_of(const std::vector<double> &times,
                                         const std::string &name) const
{
  const auto [place, is_new] = boundaries.try_emplace(name);
  for (size_t k = times.size(); is_new && k > 0 && place->second.empty(); k--) {
    std::ostringstream time;
    time << times[k - 1];
    const std::string text = contents(home + "/" + time.str() + "/" + name);
    const size_t at = text.rfind("boundaryField");
    if (at != std::string::npos) place->second = text.substr(at);
  }
  return place->second;
}

void FoamCase::set_on_patches(const std::vector<double> &times, Field &field) const
{
  const int n = field.components;
  const std::string &boundary = boundary_of(times, field.name);
  for (const bool of_walls : {false, true}) {
    std::vector<double> sum(field.values.size(), 0.0);
    std::vector<int> faces(field.values.size() / n, 0);
    for (const auto &patch : patches) {
      if (patch.wall != of_walls || (patch.wall && n != 3)) continue;
      const std::string type = type_of(block_of(boundary, patch.name));
      if (type == "empty" || type == "cyclic" || type == "symmetryPlane" || type == "symmetry")
        continue;
      const bool rests = n == 3 && type == "noSlip";
      auto *array = patch.faces->GetCellData()->GetArray(field.name.c_str());
      if (!array && !rests) continue;
      for (vtkIdType f = 0; f < patch.faces->GetNumberOfCells(); f++) {
        auto *face = patch.faces->GetCell(f);
        for (vtkIdType k = 0; k < face->GetNumberOfPoints(); k++) {
          const int p = patch.point[face->GetPointId(static_cast<int>(k))];
          faces[p]++;
          for (int c = 0; c < n && !rests; c++)
            sum[static_cast<size_t>(p) * n + c] += array->GetComponent(f, c);
        }
      }
    }
    for (size_t p = 0; p < faces.size(); p++)
      for (int c = 0; c < n && faces[p]; c++) field.values[p * n + c] = sum[p * n + c] / faces[p];
  }
}

/* ---------------------------------------------------------------------- */

// A face is of the patch that all its corners are points of, and which has the fewest points.
Surface FoamCase::wall_surface(const Mesh &mesh, double half_width) const
{
  std::vector<std::string> names;
  std::vector<std::set<int>> points;
  for (const auto &patch : patches) {
    std::string name = patch.name;
    for (char &c : name)
      if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    names.push_back(name);
    points.emplace_back(patch.point.begin(), patch.point.end());
  }
  const auto patch_of = [&](const std::vector<int> &corners) {
    int found = -1;
    for (int k = 0; k < static_cast<int>(points.size()); k++) {
      const bool all = std::all_of(corners.begin(), corners.end(), [&](int p) {
        return points[k].count(p) > 0;
      });
      if (all && (found < 0 || points[k].size() < points[found].size())) found = k;
    }
    return found >= 0 && patches[found].wall ? found : -1;
  };
  return mesh_walls(mesh, names, patch_of, half_width);
}

}    // namespace flowgrid
