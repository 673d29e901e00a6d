#include "tables/hdf5_handle.hpp"

#include <algorithm>
#include <cstring>

namespace flexspline::data {
namespace {

constexpr std::size_t kLongestText = 4096;

Hdf5Handle attribute_of(hid_t object, const char* name) {
  const bool there = H5Aexists(object, name) > 0;
  return {there ? H5Aopen(object, name, H5P_DEFAULT) : -1, H5Aclose};
}

}  // namespace

std::string hdf5_text(hid_t object, const char* name) {
  const Hdf5Handle attribute = attribute_of(object, name);
  if (!attribute) return {};
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Sget_simple_extent_npoints(space.id()) != 1)
    return {};
  if (H5Tis_variable_str(type.id()) > 0) {
    char* text = nullptr;
    const Hdf5Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory.id(), H5T_VARIABLE);
    H5Tset_cset(memory.id(), H5Tget_cset(type.id()));
    if (H5Aread(attribute.id(), memory.id(), static_cast<void*>(&text)) < 0 || text == nullptr)
      return {};
    std::string result(text, std::min(std::strlen(text), kLongestText));
    H5Dvlen_reclaim(memory.id(), space.id(), H5P_DEFAULT, static_cast<void*>(&text));
    return result;
  }
  const std::size_t size = H5Tget_size(type.id());
  if (size == 0 || size > kLongestText) return {};
  std::string result(size, '\0');
  if (H5Aread(attribute.id(), type.id(), result.data()) < 0) return {};
  return result.substr(0, result.find('\0'));
}

double hdf5_number(hid_t object, const char* name, double fallback) {
  const Hdf5Handle attribute = attribute_of(object, name);
  if (!attribute) return fallback;
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type.id());
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || H5Sget_simple_extent_npoints(space.id()) != 1) {
    return fallback;
  }
  double value = fallback;
  return H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0 ? fallback : value;
}

}  // namespace flexspline::data
