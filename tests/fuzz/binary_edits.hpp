#pragma once

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "unit/forged_file.hpp"

namespace dim {

/// A good binary file and edits of it: what a fuzzer's bytes ask for, the checksum made right again, so that everything
/// behind the checksum is reached. Most edits give an element of a dataset a value that readers get wrong; the rest
/// change any byte (attributes, HDF5's own structures).
class BinaryEdits {
 public:
  explicit BinaryEdits(const std::string& path) : path_(path), good_(files_test::contents(path)) { find_datasets(); }

  /// Writes the edited file to the path it came from. Eight bytes an edit, at most 16 of them.
  void write(const unsigned char* data, std::size_t size) const {
    std::string bytes = good_;
    for (std::size_t i = 0; i + 8 <= size && i < 16 * 8; i += 8) edit(bytes, data + i);
    files_test::put(path_, bytes);
    files_test::seal(path_);
  }

 private:
  struct Dataset {
    std::size_t offset = 0, n_elements = 0, element_bytes = 0;
    bool real = false;
  };

  void find_datasets() {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    H5Ovisit2(
        file, H5_INDEX_NAME, H5_ITER_INC,
        [](hid_t root, const char* name, const H5O_info_t* info, void* self) -> herr_t {
          if (info->type == H5O_TYPE_DATASET) static_cast<BinaryEdits*>(self)->note(root, name);
          return 0;
        },
        this, H5O_INFO_BASIC);
    H5Fclose(file);
  }

  void note(hid_t root, const char* name) {
    const hid_t set = H5Dopen2(root, name, H5P_DEFAULT), type = H5Dget_type(set), space = H5Dget_space(set);
    const haddr_t at = H5Dget_offset(set);
    const auto n = H5Sget_simple_extent_npoints(space);
    if (at != HADDR_UNDEF && n > 0)
      datasets_.push_back({at, static_cast<std::size_t>(n), H5Tget_size(type), H5Tget_class(type) == H5T_FLOAT});
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
  }

  void edit(std::string& bytes, const unsigned char* code) const {
    std::uint32_t where = 0;
    std::memcpy(&where, code + 2, sizeof where);
    if (code[0] % 4 == 0 || datasets_.empty()) {
      const std::size_t body = bytes.size() - kHeader_bytes;
      bytes[kHeader_bytes + where % body] = static_cast<char>(code[6]);
      return;
    }
    const Dataset& set = datasets_[code[1] % datasets_.size()];
    const std::string value = set.real ? real(code, set.element_bytes) : whole(code, set.element_bytes);
    std::memcpy(&bytes[set.offset + where % set.n_elements * set.element_bytes], value.data(), value.size());
  }

  static std::string real(const unsigned char* code, std::size_t n_bytes) {
    static constexpr double kValues[] = {0.0, -0.0, 1.0, -1.0, 1e300, -1e300, 1e38, 1e-300, 1e9, 0.5};
    double value = code[6] % 12 == 10   ? std::numeric_limits<double>::quiet_NaN()
                   : code[6] % 12 == 11 ? std::numeric_limits<double>::infinity()
                                        : kValues[code[6] % 12];
    value += static_cast<signed char>(code[7]);
    const auto single = static_cast<float>(value);
    return n_bytes == 4 ? std::string(reinterpret_cast<const char*>(&single), 4)
                        : std::string(reinterpret_cast<const char*>(&value), 8).substr(0, n_bytes);
  }

  static std::string whole(const unsigned char* code, std::size_t n_bytes) {
    static constexpr std::int64_t kValues[] = {0, 1, -1, 255, 65535, 2147483647, -2147483648LL, 1000000, 2, 7};
    const std::int64_t value = kValues[code[6] % 10] + static_cast<signed char>(code[7]);
    return std::string(reinterpret_cast<const char*>(&value), 8).substr(0, std::min<std::size_t>(n_bytes, 8));
  }

  std::string path_, good_;
  std::vector<Dataset> datasets_;
};

}  // namespace dim
