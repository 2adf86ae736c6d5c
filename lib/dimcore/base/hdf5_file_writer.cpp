#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/atomic_file.hpp"
#include "base/hdf5_file.hpp"
#include "base/hdf5_file_header.hpp"
#include "base/hdf5_file_internal.hpp"
#include "base/input_file.hpp"
#include "base/version.hpp"

namespace dim {

using hdf5::dataspace;
using hdf5::Handle;
using hdf5::require;
using hdf5::timeless;

namespace {

constexpr std::size_t kIncrement_bytes = std::size_t{256} << 10;

std::size_t product(const Shape& shape, const std::string& path) {
  std::size_t n = 1;
  for (const std::size_t size : shape) {
    if (__builtin_mul_overflow(n, size, &n)) throw InternalError("dataset '" + path + "': too many elements");
  }
  return n;
}

Handle utf8_links() {
  Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_char_encoding(properties.get(), H5T_CSET_UTF8);
  return properties;
}

}  // namespace

struct Hdf5Writer::Impl {
  std::string kind;
  int version = 0;
  Handle file;
  Handle links = utf8_links();
  Handle groups = timeless(H5P_GROUP_CREATE);
  Handle datasets = timeless(H5P_DATASET_CREATE);

  void make_group(const std::string& path) const;
  Handle make_dataset(const std::string& path, hid_t type, const Handle& space) const;
  std::span<std::byte> image() const;
};

void Hdf5Writer::Impl::make_group(const std::string& path) const {
  for (const auto& level : hdf5::levels(path)) {
    if (H5Lexists(file.get(), level.c_str(), H5P_DEFAULT) > 0) continue;
    const Handle group(H5Gcreate2(file.get(), level.c_str(), links.get(), groups.get(), H5P_DEFAULT),
                       H5Gclose);
    require(bool(group), level);
  }
}

Handle Hdf5Writer::Impl::make_dataset(const std::string& path, hid_t type, const Handle& space) const {
  if (path.size() < 2 || path.front() != '/' || path.back() == '/') {
    throw InternalError("dataset '" + path + "': its path must read /group/name");
  }
  require(bool(space), path);
  make_group(path.substr(0, path.rfind('/')));
  Handle set(
      H5Dcreate2(file.get(), path.c_str(), type, space.get(), links.get(), datasets.get(), H5P_DEFAULT),
      H5Dclose);
  require(bool(set), path);
  return set;
}

/// The whole file as the core driver holds it, its first bytes the still empty user block.
std::span<std::byte> Hdf5Writer::Impl::image() const {
  void* handle = nullptr;
  require(H5Fflush(file.get(), H5F_SCOPE_GLOBAL) >= 0, "/");
  // Without a buffer this only tells the size, from the end of the user block on.
  const ssize_t body_bytes = H5Fget_file_image(file.get(), nullptr, 0);
  require(body_bytes > 0 && H5Fget_vfd_handle(file.get(), H5P_DEFAULT, &handle) >= 0 && handle != nullptr,
          "/");
  return {*static_cast<std::byte**>(handle), kHeader_bytes + static_cast<std::size_t>(body_bytes)};
}

Hdf5Writer::Hdf5Writer(const std::string& kind, int version) : impl_(std::make_unique<Impl>()) {
  hdf5::silence();
  impl_->kind = kind;
  impl_->version = version;
  H5Pset_layout(impl_->datasets.get(), H5D_CONTIGUOUS);
  H5Pset_fill_time(impl_->datasets.get(), H5D_FILL_TIME_NEVER);  // all of it is written at once

  const Handle creation = timeless(H5P_FILE_CREATE);
  H5Pset_userblock(creation.get(), kHeader_bytes);
  const Handle access = hdf5::memory_access(kIncrement_bytes);
  // The format of HDF5 1.8: checksums on its structures, no times, readable by everything since 2008.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  const std::string name = hdf5::memory_name(impl_.get());
  impl_->file = Handle(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  require(bool(impl_->file), "/");

  attribute("/", "dim_format", kind);
  attribute("/", "dim_version", version);
  attribute("/", "dim_program", dim::version());
}

Hdf5Writer::~Hdf5Writer() = default;
Hdf5Writer::Hdf5Writer(Hdf5Writer&&) noexcept = default;
Hdf5Writer& Hdf5Writer::operator=(Hdf5Writer&&) noexcept = default;

namespace {

Handle open_object(const Handle& file, const std::string& path) {
  Handle object(H5Oopen(file.get(), path.c_str(), H5P_DEFAULT), H5Oclose);
  require(bool(object), path);
  return object;
}

}  // namespace

void Hdf5Writer::attribute(const std::string& path, const std::string& name, const std::string& value) {
  impl_->make_group(path);
  hdf5::write_text(open_object(impl_->file, path).get(), path, name, value);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, const char* value) {
  attribute(path, name, std::string(value));
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, double value) {
  impl_->make_group(path);
  hdf5::write_value(open_object(impl_->file, path).get(), path, name, H5T_IEEE_F64LE, &value);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, std::int64_t value) {
  impl_->make_group(path);
  hdf5::write_value(open_object(impl_->file, path).get(), path, name, H5T_STD_I64LE, &value);
}

void Hdf5Writer::write_array(const std::string& path, ElementType type, const void* data,
                             std::size_t n_elements, const Shape& shape, const std::string& unit,
                             const std::string& description) {
  if (product(shape, path) != n_elements) {
    throw InternalError(fmt::format("dataset '{}': {} elements do not fill {}", path, n_elements,
                                    hdf5::shape_in_words(shape)));
  }
  const Handle set = impl_->make_dataset(path, hdf5::file_type(type), dataspace(shape));
  if (n_elements > 0 &&
      H5Dwrite(set.get(), hdf5::memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    const std::size_t size = n_elements * H5Tget_size(hdf5::memory_type(type));
    throw LimitError(fmt::format("dataset '{}': not enough memory for its {}{}", path, size_in_words(size),
                                 hdf5::reason()));
  }
  hdf5::write_text(set.get(), path, "unit", unit);
  if (!description.empty()) hdf5::write_text(set.get(), path, "description", description);
}

void Hdf5Writer::strings(const std::string& path, const std::vector<std::string>& values) {
  std::size_t width = 1;  // HDF5 has no strings of no length
  for (const auto& value : values) {
    if (value.find('\0') != std::string::npos) throw InternalError("'" + path + "' holds a NUL");
    width = std::max(width, value.size());
  }
  std::vector<char> bytes(values.size() * width, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) std::ranges::copy(values[i], bytes.begin() + static_cast<std::ptrdiff_t>(i * width));
  const Handle type = hdf5::fixed_string_type(width);
  const Handle set = impl_->make_dataset(path, type.get(), dataspace({values.size()}));
  require(bytes.empty() || H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0, path);
  hdf5::write_text(set.get(), path, "unit", "1");
}

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  // HDF5 has no string type of no length; an empty text is a dataset without a value.
  const Handle type = hdf5::fixed_string_type(std::max<std::size_t>(value.size(), 1));
  const Handle space(H5Screate(value.empty() ? H5S_NULL : H5S_SCALAR), H5Sclose);
  const Handle set = impl_->make_dataset(path, type.get(), space);
  require(value.empty() || H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) >= 0,
          path);
  hdf5::write_text(set.get(), path, "unit", "1");
}

std::string Hdf5Writer::write(const std::string& path, const Job& job) && {
  AtomicFile file(path, job);
  const std::span<std::byte> image = impl_->image();
  BodyHash hash;
  hash.add(image.subspan(kHeader_bytes));
  std::string hex = hash.hex();
  const auto header = make_header({impl_->kind, impl_->version, image.size(), hex, dim::version()});
  // The user block of the image is ours to fill, which spares a copy of the image.
  std::ranges::copy(std::as_bytes(std::span(header)), image.begin());
  file.write(image);
  file.commit();
  impl_.reset();
  return hex;
}

}  // namespace dim
