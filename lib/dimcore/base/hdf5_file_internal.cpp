#include "base/hdf5_file_internal.hpp"

#include <fmt/format.h>

namespace dim::hdf5 {

void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::string reason() {
  std::string words;
  // From the place of the failure outwards; the first entry is the cause.
  const auto keep_first = [](unsigned level, const H5E_error2_t* entry, void* out) -> herr_t {
    if (level == 0 && entry->desc) *static_cast<std::string*>(out) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &words);
  return words.empty() ? words : " (HDF5: " + words + ")";
}

hid_t file_type(ElementType type) {
  switch (type) {
    case ElementType::kUint8:
      return H5T_STD_U8LE;
    case ElementType::kUint16:
      return H5T_STD_U16LE;
    case ElementType::kUint32:
      return H5T_STD_U32LE;
    case ElementType::kUint64:
      return H5T_STD_U64LE;
    case ElementType::kInt32:
      return H5T_STD_I32LE;
    case ElementType::kInt64:
      return H5T_STD_I64LE;
    case ElementType::kFloat32:
      return H5T_IEEE_F32LE;
    case ElementType::kFloat64:
      return H5T_IEEE_F64LE;
  }
  throw InternalError("element type of no name");
}

hid_t memory_type(ElementType type) {
  switch (type) {
    case ElementType::kUint8:
      return H5T_NATIVE_UINT8;
    case ElementType::kUint16:
      return H5T_NATIVE_UINT16;
    case ElementType::kUint32:
      return H5T_NATIVE_UINT32;
    case ElementType::kUint64:
      return H5T_NATIVE_UINT64;
    case ElementType::kInt32:
      return H5T_NATIVE_INT32;
    case ElementType::kInt64:
      return H5T_NATIVE_INT64;
    case ElementType::kFloat32:
      return H5T_NATIVE_FLOAT;
    case ElementType::kFloat64:
      return H5T_NATIVE_DOUBLE;
  }
  throw InternalError("element type of no name");
}

const char* name_of(ElementType type) {
  switch (type) {
    case ElementType::kUint8:
      return "uint8";
    case ElementType::kUint16:
      return "uint16";
    case ElementType::kUint32:
      return "uint32";
    case ElementType::kUint64:
      return "uint64";
    case ElementType::kInt32:
      return "int32";
    case ElementType::kInt64:
      return "int64";
    case ElementType::kFloat32:
      return "float32";
    case ElementType::kFloat64:
      return "float64";
  }
  throw InternalError("element type of no name");
}

Handle fixed_string_type(std::size_t n_bytes) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), n_bytes);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  return type;
}

void require(bool success, const std::string& path) {
  if (!success) throw InternalError("'" + path + "' cannot be written into the file" + reason());
}

Handle dataspace(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> sizes(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose};
}

Handle timeless(hid_t property_class) {
  Handle properties(H5Pcreate(property_class), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

void write_value(hid_t object, const std::string& path, const std::string& name, hid_t type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle made(H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(made && H5Awrite(made.get(), type, value) >= 0, path + "@" + name);
}

void write_text(hid_t object, const std::string& path, const std::string& name, const std::string& value) {
  if (value.find('\0') != std::string::npos) throw InternalError("'" + path + "@" + name + "' holds a NUL");
  const std::size_t width = std::max<std::size_t>(value.size(), 1);
  std::string padded = value;
  padded.resize(width, '\0');
  write_value(object, path, name, fixed_string_type(width).get(), padded.data());
}

std::vector<std::string> levels(const std::string& path) {
  std::vector<std::string> found;
  for (std::size_t at = 0; at < path.size(); ++at) {
    if (at > 0 && path[at] == '/') found.push_back(path.substr(0, at));
  }
  if (path != "/" && !path.empty()) found.push_back(path);
  return found;
}

std::string shape_in_words(const Shape& shape) {
  std::string words = "[";
  for (const std::size_t size : shape) {
    if (words.size() > 1) words += ", ";
    words += size == kAnySize ? "*" : std::to_string(size);
  }
  return words + "]";
}

Handle memory_access(std::size_t increment_bytes) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), increment_bytes, /*backing_store=*/false);
  return access;
}

std::string memory_name(const void* owner) { return fmt::format("/dev/null/{}", owner); }

}  // namespace dim::hdf5
