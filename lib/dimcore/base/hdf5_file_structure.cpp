#include "base/hdf5_file_structure.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace dim::hdf5 {
namespace {

constexpr int kMostLevels = 8;
constexpr std::size_t kMostObjects = 10'000;

class StructureCheck {
 public:
  StructureCheck(const std::string& path, std::uint64_t file_bytes) : path_(path), file_bytes_(file_bytes) {}

  void group(hid_t group, const std::string& name, int level) {
    if (level > kMostLevels) fail("'" + name + "' lies deeper than DIM writes");
    for (const auto& link_name : names_in(group, name)) link(group, name, link_name, level);
  }

 private:
  void link(hid_t group, const std::string& group_name, const std::string& name, int level) {
    const std::string full = group_name + name;
    H5L_info_t info = {};
    if (H5Lget_info(group, name.c_str(), &info, H5P_DEFAULT) < 0) fail("'" + full + "' cannot be read");
    if (info.type != H5L_TYPE_HARD) fail("'" + full + "' is a link to elsewhere, which DIM never writes");
    const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object) fail("'" + full + "' cannot be opened" + reason());
    H5O_info_t about = {};
    if (H5Oget_info2(object.get(), &about, H5O_INFO_BASIC) < 0) fail("'" + full + "' cannot be read");
    if (!seen_.insert(about.addr).second || seen_.size() > kMostObjects)
      fail("'" + full + "' is a second name of another object, which DIM never writes");
    if (about.type == H5O_TYPE_GROUP)
      this->group(object.get(), full + "/", level + 1);
    else if (about.type == H5O_TYPE_DATASET)
      dataset(object.get(), full);
    else
      fail("'" + full + "' is neither a group nor a dataset");
  }

  // In native order: asked for an order, HDF5 1.10 makes a table of as many links as the file claims and, where they
  // cannot all be read, frees what it has not filled.
  std::vector<std::string> names_in(hid_t group, const std::string& group_name) const {
    std::vector<std::string> names;
    const auto note = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
      auto& list = *static_cast<std::vector<std::string>*>(out);
      list.emplace_back(name);
      return *name != '\0' && list.size() <= kMostObjects ? 0 : -1;
    };
    if (H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, note, &names) < 0)
      fail("a name in group '" + group_name + "' cannot be read" + reason());
    std::sort(names.begin(), names.end());
    return names;
  }

  void dataset(hid_t set, const std::string& name) {
    const Handle created(H5Dget_create_plist(set), H5Pclose);
    if (!created || H5Pget_layout(created.get()) != H5D_CONTIGUOUS || H5Pget_nfilters(created.get()) != 0 ||
        H5Pget_external_count(created.get()) != 0)
      fail("dataset '" + name + "' is chunked, compressed or stored elsewhere, which DIM never writes");
    const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
    const H5T_class_t kind = H5Tget_class(type.get());
    const bool variable = H5Tis_variable_str(type.get()) > 0;
    if ((kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_STRING) || variable)
      fail("dataset '" + name + "' is of a type that DIM never writes");
    const hssize_t n = H5Sget_simple_extent_npoints(space.get());
    std::uint64_t bytes = 0;
    if (n < 0 || __builtin_mul_overflow(static_cast<std::uint64_t>(n), H5Tget_size(type.get()), &bytes))
      fail("dataset '" + name + "' is larger than the file");
    if (bytes == 0 || H5Sget_simple_extent_type(space.get()) == H5S_NULL) return;
    const haddr_t at = H5Dget_offset(set);
    if (__builtin_add_overflow(stored_bytes_, bytes, &stored_bytes_) || stored_bytes_ > file_bytes_ ||
        at == HADDR_UNDEF || at > file_bytes_ || H5Dget_storage_size(set) != bytes)
      fail("dataset '" + name + "' is larger than the file");
  }

  [[noreturn]] void fail(const std::string& what) const { throw IoError(path_, what); }

  const std::string& path_;
  std::uint64_t file_bytes_;
  std::uint64_t stored_bytes_ = 0;
  std::set<haddr_t> seen_;
};

}  // namespace

void check_structure(const Handle& file, const std::string& path, std::uint64_t file_bytes) {
  const Handle root(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose);
  if (!root) throw IoError(path, "cannot be opened" + reason());
  StructureCheck(path, file_bytes).group(root.get(), "/", 0);
}

}  // namespace dim::hdf5
