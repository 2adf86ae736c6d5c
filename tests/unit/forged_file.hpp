#pragma once

#include <hdf5.h>

#include <span>
#include <string>
#include <vector>

#include "base/hdf5_file_header.hpp"
#include "unit/files_support.hpp"

/// A binary file of DIM opened with HDF5 itself, changed as DIM would not, and given a right checksum again.
namespace files_test {

inline void seal(const std::string& path) {
  std::string bytes = contents(path);
  const std::string text = bytes.substr(0, bytes.find('\0'));
  const auto field = [&](const std::string& name) {
    const auto at = text.find("\n" + name + " ") + name.size() + 2;
    return text.substr(at, text.find('\n', at) - at);
  };
  dim::BodyHash hash;
  hash.add(std::as_bytes(std::span(bytes).subspan(dim::kHeader_bytes)));
  const auto header = dim::make_header({field("kind"), std::stoi(field("version")), bytes.size(), hash.hex()});
  std::copy(header.begin(), header.end(), bytes.begin());
  put(path, bytes);
}

class ForgedFile {
 public:
  explicit ForgedFile(const std::string& path)
      : path_(path), file_(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)) {}
  ForgedFile(const ForgedFile&) = delete;
  ForgedFile& operator=(const ForgedFile&) = delete;
  ~ForgedFile() {
    H5Fclose(file_);
    seal(path_);
  }
  hid_t id() const { return file_; }

  void remove(const std::string& name) const { H5Ldelete(file_, name.c_str(), H5P_DEFAULT); }

  void replace(const std::string& name, const std::vector<double>& values, const std::vector<hsize_t>& shape,
               hid_t type = H5T_IEEE_F64LE, hid_t properties = H5P_DEFAULT) const {
    remove(name);
    const hid_t space = shape.empty() ? H5Screate(H5S_SCALAR)
                                      : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t set = H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    if (!values.empty()) H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
    H5Sclose(space);
  }

  std::string text(const std::string& name) const {
    const hid_t set = H5Dopen2(file_, name.c_str(), H5P_DEFAULT), type = H5Dget_type(set);
    std::string value(H5Tget_size(type), '\0');
    H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data());
    H5Tclose(type);
    H5Dclose(set);
    return value;
  }

  void replace_text(const std::string& name, const std::string& text) const {
    remove(name);
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, text.size());
    H5Tset_cset(type, H5T_CSET_UTF8);
    const hid_t set = H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
  }

  /// A single number, or an array of `n` equal ones.
  void replace_attribute(const std::string& object, const std::string& name, double value, hsize_t n = 0) const {
    H5Adelete_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT);
    const std::vector<double> values(n ? n : 1, value);
    const hid_t space = n ? H5Screate_simple(1, &n, nullptr) : H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate_by_name(file_, object.c_str(), name.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT,
                                              H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data());
    H5Aclose(attribute);
    H5Sclose(space);
  }

 private:
  std::string path_;
  hid_t file_;
};

}  // namespace files_test
