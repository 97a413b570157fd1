// Reading of HDF5 files that are not trusted: handles that close themselves, attributes and arrays
// of the kind and size that is wanted, nothing from other files. What is wrong is thrown as a
// std::runtime_error.

#ifndef APF_HDF5_INPUT_H
#define APF_HDF5_INPUT_H

#include <hdf5.h>

#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace apf::hdf5 {

using Dims = std::vector<std::uint64_t>;

constexpr double best_compression = 1e5;

[[noreturn]] inline void fail(const std::string &text)
{
  throw std::runtime_error(text);
}

// a handle of HDF5 and what closes it
class Handle {
 public:
  Handle(hid_t value, herr_t (*closer)(hid_t)) : id(value), close(closer) {}
  ~Handle()
  {
    if (id >= 0) close(id);
  }
  Handle(const Handle &) = delete;
  Handle &operator=(const Handle &) = delete;
  operator hid_t() const { return id; }
  explicit operator bool() const { return id >= 0; }

 private:
  hid_t id;
  herr_t (*close)(hid_t);
};

// HDF5 prints its errors unless told not to.
class Quiet {
 public:
  Quiet()
  {
    H5Eget_auto2(H5E_DEFAULT, &print, &data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print, data); }

 private:
  H5E_auto2_t print;
  void *data;
};

inline Dims dims_of(hid_t space)
{
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || H5Sget_simple_extent_type(space) == H5S_NULL) return {0};
  std::vector<hsize_t> dims(rank);
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

inline std::string text_of(const Dims &dims)
{
  std::string text;
  for (const auto n : dims) text += "[" + std::to_string(n) + "]";
  return text.empty() ? "of a single number" : text;
}

inline std::string text_of(double a)
{
  std::ostringstream text;
  text.precision(10);
  text << a;
  return text.str();
}

inline bool is_number(hid_t type)
{
  const auto kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

// `count` numbers of an attribute
template <class T>
inline void read_attribute(hid_t group, const char *name, hid_t type, std::uint64_t count,
                           T *values)
{
  const Handle attribute(H5Aopen(group, name, H5P_DEFAULT), H5Aclose);
  if (!attribute) fail(std::string("attribute ") + name + " is missing");
  const Handle space(H5Aget_space(attribute), H5Sclose), stored(H5Aget_type(attribute), H5Tclose);
  std::uint64_t n = 1;
  for (const auto d : dims_of(space)) n = d > count ? 0 : n * d;
  if (n != count || !is_number(stored))
    fail(std::string("attribute ") + name + " must be " + std::to_string(count) +
         (count == 1 ? " number" : " numbers"));
  if (H5Aread(attribute, type, values) < 0) fail(std::string("cannot read attribute ") + name);
}

inline std::string read_text(hid_t group, const char *name)
{
  const Handle attribute(H5Aopen(group, name, H5P_DEFAULT), H5Aclose);
  if (!attribute) fail(std::string("attribute ") + name + " is missing");
  const Handle space(H5Aget_space(attribute), H5Sclose), type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
    fail(std::string("attribute ") + name + " must be a word");
  if (H5Tis_variable_str(type) > 0) {
    char *text = nullptr;
    if (H5Aread(attribute, type, &text) < 0 || !text)
      fail(std::string("cannot read attribute ") + name);
    std::string result = text;
    H5free_memory(text);
    return result;
  }
  const std::size_t size = H5Tget_size(type);
  if (size > 256) fail(std::string("attribute ") + name + " must be a word");
  std::string result(size, '\0');
  if (H5Aread(attribute, type, result.data()) < 0)
    fail(std::string("cannot read attribute ") + name);
  return result.substr(0, std::strlen(result.c_str()));
}

// What opens groups and arrays: a file must hold its data itself, so links to other files are not
// followed, which could be any that the user may read.
class SameFile {
 public:
  SameFile() : list(H5Pcreate(H5P_GROUP_ACCESS), H5Pclose)
  {
    H5Pset_elink_cb(
        list,
        [](const char *, const char *, const char *, const char *, unsigned *, hid_t, void *) {
          return -1;
        },
        nullptr);
  }
  operator hid_t() const { return list; }

 private:
  Handle list;
};

inline bool exists(hid_t group, const char *name)
{
  return H5Lexists(group, name, SameFile()) > 0;
}

inline void check_link(hid_t at, const std::string &name)
{
  H5L_info_t link;
  if (H5Lget_info(at, name.c_str(), &link, SameFile()) >= 0 && link.type == H5L_TYPE_EXTERNAL)
    fail(name + " is a link to another file: the file must hold its data itself");
}

inline hid_t open_group(hid_t at, const char *name)
{
  check_link(at, name);
  return H5Gopen2(at, name, SameFile());
}

// an array whose numbers are in this file; `called`: in errors
inline hid_t open_array(hid_t at, const std::string &name, const std::string &called)
{
  check_link(at, name);
  const hid_t data = H5Oopen(at, name.c_str(), SameFile());
  if (data < 0 || H5Iget_type(data) != H5I_DATASET) {
    if (data >= 0) H5Oclose(data);
    fail(called + " must be a dataset of HDF5");
  }
  const Handle list(H5Dget_create_plist(data), H5Pclose);
  if (H5Pget_external_count(list) != 0 || H5Pget_layout(list) == H5D_VIRTUAL) {
    H5Oclose(data);
    fail(called + " has its numbers in another file: the file must hold its data itself");
  }
  return data;
}

// before there is memory for `count` numbers of a file that may say anything
inline void check_storage(hid_t data, double count, const std::string &called)
{
  const Handle type(H5Dget_type(data), H5Tclose);
  const double stored = static_cast<double>(H5Dget_storage_size(data));
  if (stored == 0.0) fail(called + " has no data");
  const Handle list(H5Dget_create_plist(data), H5Pclose);
  const double most = H5Pget_nfilters(list) == 0 ? 1.0 : best_compression;
  if (stored * most < count * static_cast<double>(H5Tget_size(type)))
    fail(called + " has " + text_of(stored) + " bytes of data for " + text_of(count) +
         " numbers: it is not complete");
}

}    // namespace apf::hdf5

#endif
