#include "cgns_links.h"

#include "../../src/flow/hdf5_input.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace hdf5 = apf::hdf5;

namespace flowgrid {

namespace {

  struct Found {
    std::string elsewhere;    // a link to another file, empty if there is none
    std::vector<std::string> objects;
  };

  herr_t note(hid_t, const char *name, const H5L_info_t *link, void *into)
  {
    auto *found = static_cast<Found *>(into);
    if (link->type == H5L_TYPE_HARD)
      found->objects.emplace_back(name);
    else if (link->type != H5L_TYPE_SOFT) {
      found->elsewhere = name;
      return 1;
    }
    return 0;
  }

  void check_hdf5(const std::string &path)
  {
    const hdf5::Quiet quiet;
    if (H5Fis_hdf5(path.c_str()) <= 0) return;
    const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file) return;    // nor does CGNS's library read it
    Found found;
    if (H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, note, &found) < 0)
      hdf5::fail("is a damaged or truncated HDF5 file");
    if (!found.elsewhere.empty())
      hdf5::fail(found.elsewhere + " is a link to another file: it is not read");
    for (const auto &name : found.objects) {
      const hdf5::Handle object(H5Oopen(file, name.c_str(), hdf5::SameFile()), H5Oclose);
      if (object && H5Iget_type(object) == H5I_DATASET)
        H5Oclose(hdf5::open_array(file, name, name));
    }
  }

  // A node is a header of 246 characters, tag, name, label, numbers, and from the 97th on its type
  // of data, which is LK for a link. ADF reads no node that lacks the tag.
  void check_adf(const std::string &path)
  {
    constexpr std::size_t part = std::size_t(1) << 20, type = 96, header = 246;
    const std::string tag = "NoDe", version = "ADF Database Version";
    std::ifstream in(path, std::ios::binary);
    std::string text;
    const auto letter = [&text](std::size_t at) {
      return std::toupper(static_cast<unsigned char>(text[at]));
    };
    for (bool begin = true; in; begin = false) {
      const std::size_t before = text.size();
      text.resize(before + part);
      in.read(text.data() + before, part);
      text.resize(before + static_cast<std::size_t>(in.gcount()));
      if (begin &&
          text.compare(std::min<std::size_t>(4, text.size()), version.size(), version) != 0)
        return;
      for (std::size_t at = 0; (at = text.find(tag, at)) != std::string::npos; at++)
        if (at + type + 1 < text.size() && letter(at + type) == 'L' && letter(at + type + 1) == 'K')
          hdf5::fail("has a node that is a link, to another file or within it: it is not read");
      if (text.size() > header) text.erase(0, text.size() - header);
    }
  }

}    // namespace

void check_cgns_links(const std::string &path)
{
  try {
    check_hdf5(path);
    check_adf(path);
  } catch (const std::runtime_error &error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}    // namespace flowgrid
