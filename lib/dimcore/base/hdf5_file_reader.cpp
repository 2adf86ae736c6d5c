#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <optional>

#include "base/file_layout.hpp"
#include "base/hdf5_file.hpp"
#include "base/hdf5_file_internal.hpp"
#include "base/hdf5_file_structure.hpp"
#include "base/hdf5_file_verify.hpp"
#include "base/input_file.hpp"

namespace dim {

using hdf5::Handle;

namespace {

struct TypeTraits {
  bool is_float;
  bool is_signed;
  int digits;  ///< bits of value: mantissa, or integer without its sign
};

TypeTraits traits(ElementType type) {
  switch (type) {
    case ElementType::kUint8:
      return {false, false, 8};
    case ElementType::kUint16:
      return {false, false, 16};
    case ElementType::kUint32:
      return {false, false, 32};
    case ElementType::kUint64:
      return {false, false, 64};
    case ElementType::kInt32:
      return {false, true, 31};
    case ElementType::kInt64:
      return {false, true, 63};
    case ElementType::kFloat32:
      return {true, true, 24};
    case ElementType::kFloat64:
      return {true, true, 53};
  }
  throw InternalError("element type of no name");
}

bool fits(ElementType from, ElementType to) {
  const TypeTraits a = traits(from);
  const TypeTraits b = traits(to);
  return (!a.is_float || b.is_float) && (!a.is_signed || b.is_signed) && a.digits <= b.digits;
}

bool agrees(const Shape& found, const Shape& expected) {
  return std::ranges::equal(found, expected,
                            [](std::size_t f, std::size_t e) { return e == kAnySize || e == f; });
}

std::vector<hsize_t> sizes_of(hid_t space) {
  std::vector<hsize_t> sizes(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return sizes;
}

}  // namespace

struct Hdf5Reader::Impl {
  std::string path;
  VerifiedFile content;  // before `file`, which may read from its memory until it is closed
  Handle file;
  std::optional<FileLayout> layout;

  [[noreturn]] void fail(const std::string& what) const { throw IoError(path, what); }
  bool has(const std::string& object) const;
  Handle open_dataset(const std::string& name) const;
  ElementType type(const std::string& name, hid_t dataset) const;
  Shape shape(hid_t dataset) const;
  void require_fit(const std::string& name, hid_t dataset, ElementType wanted) const;
  Handle open_attribute(const std::string& object, const std::string& name) const;
};

bool Hdf5Reader::Impl::has(const std::string& object) const {
  return std::ranges::all_of(hdf5::levels(object), [&](const std::string& level) {
    return H5Lexists(file.get(), level.c_str(), H5P_DEFAULT) > 0;
  });
}

Handle Hdf5Reader::Impl::open_dataset(const std::string& name) const {
  Handle set(has(name) ? H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT) : H5I_INVALID_HID, H5Dclose);
  if (!set) fail("holds no dataset '" + name + "'");
  return set;
}

ElementType Hdf5Reader::Impl::type(const std::string& name, hid_t dataset) const {
  using enum ElementType;
  const Handle stored(H5Dget_type(dataset), H5Tclose);
  for (const auto known : {kUint8, kUint16, kUint32, kUint64, kInt32, kInt64, kFloat32, kFloat64}) {
    if (H5Tequal(stored.get(), hdf5::file_type(known)) > 0) return known;
  }
  fail("dataset '" + name + "' holds no numbers that DIM writes");
}

Shape Hdf5Reader::Impl::shape(hid_t dataset) const {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const auto sizes = sizes_of(space.get());
  return {sizes.begin(), sizes.end()};
}

void Hdf5Reader::Impl::require_fit(const std::string& name, hid_t dataset, ElementType wanted) const {
  const ElementType stored = type(name, dataset);
  if (fits(stored, wanted)) return;
  fail(fmt::format("dataset '{}' holds {}, expected {}", name, hdf5::name_of(stored), hdf5::name_of(wanted)));
}

Handle Hdf5Reader::Impl::open_attribute(const std::string& object, const std::string& name) const {
  Handle attribute(has(object)
                       ? H5Aopen_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT)
                       : H5I_INVALID_HID,
                   H5Aclose);
  if (!attribute) fail("holds no attribute '" + name + "' of '" + object + "'");
  // One value goes into the room of one.
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (H5Sget_simple_extent_type(space.get()) != H5S_SCALAR)
    fail("attribute '" + name + "' of '" + object + "' is not a single value");
  return attribute;
}

Hdf5Reader::Hdf5Reader(const std::string& path, const std::string& expected_kind, int max_version,
                       const Job& job, int min_version)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = name_for_messages(path);
  impl_->content = verify_file(path, expected_kind, {min_version, max_version}, job);
  hdf5::silence();
  impl_->file = open_verified(path, impl_->content);
  hdf5::check_structure(impl_->file, impl_->path, impl_->content.header.file_bytes);
  const FileHeader& header = impl_->content.header;
  if (text_attribute("/", "dim_format") != header.kind ||
      integer_attribute("/", "dim_version") != header.version) {
    impl_->fail("is altered: its header and its content say different formats");
  }
}

Hdf5Reader::~Hdf5Reader() = default;
Hdf5Reader::Hdf5Reader(Hdf5Reader&&) noexcept = default;
Hdf5Reader& Hdf5Reader::operator=(Hdf5Reader&&) noexcept = default;

int Hdf5Reader::version() const { return impl_->content.header.version; }
const std::string& Hdf5Reader::hash() const { return impl_->content.header.body_hash; }
std::uint64_t Hdf5Reader::file_bytes() const { return impl_->content.header.file_bytes; }
bool Hdf5Reader::has(const std::string& path) const { return impl_->has(path); }
Shape Hdf5Reader::shape(const std::string& path) const {
  return impl_->shape(impl_->open_dataset(path).get());
}
ElementType Hdf5Reader::type(const std::string& path) const {
  return impl_->type(path, impl_->open_dataset(path).get());
}

std::size_t Hdf5Reader::count_checked(const std::string& path, const Shape& expected) const {
  const Handle set = impl_->open_dataset(path);
  const Shape found = impl_->shape(set.get());
  if (!agrees(found, expected)) {
    impl_->fail(fmt::format("dataset '{}' has shape {}, expected {}", path, hdf5::shape_in_words(found),
                            hdf5::shape_in_words(expected)));
  }
  // Sizes are believed only as far as the file can hold them, so that no memory is asked for in vain.
  std::size_t n = 1;
  bool overflow = false;
  for (const std::size_t size : found) overflow = __builtin_mul_overflow(n, size, &n) || overflow;
  if (overflow || n > file_bytes()) impl_->fail("dataset '" + path + "' is larger than the file");
  return n;
}

void Hdf5Reader::read_array(const std::string& path, ElementType type, void* out) const {
  const Handle set = impl_->open_dataset(path);
  impl_->require_fit(path, set.get(), type);
  if (H5Dread(set.get(), hdf5::memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, out) < 0) {
    impl_->fail("dataset '" + path + "' cannot be read" + hdf5::reason());
  }
}

void Hdf5Reader::read_part(const std::string& path, ElementType type, std::size_t first_row,
                           std::size_t n_rows, void* out, std::size_t n_elements) const {
  const Handle set = impl_->open_dataset(path);
  impl_->require_fit(path, set.get(), type);
  const Handle in_file(H5Dget_space(set.get()), H5Sclose);
  std::vector<hsize_t> count = sizes_of(in_file.get());
  if (count.empty() || first_row > count[0] || n_rows > count[0] - first_row) {
    impl_->fail(fmt::format("dataset '{}' has {} rows; {} from row {} on were expected", path,
                            count.empty() ? 0 : count[0], n_rows, first_row));
  }
  count[0] = n_rows;
  const hsize_t n_expected = std::accumulate(count.begin(), count.end(), hsize_t{1}, std::multiplies<>());
  if (n_expected != n_elements) {
    throw InternalError(
        fmt::format("dataset '{}': {} elements into room for {}", path, n_expected, n_elements));
  }
  if (n_elements == 0) return;
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = first_row;
  H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const Handle in_memory(H5Screate_simple(1, &n_expected, nullptr), H5Sclose);
  if (H5Dread(set.get(), hdf5::memory_type(type), in_memory.get(), in_file.get(), H5P_DEFAULT, out) < 0) {
    impl_->fail("dataset '" + path + "' cannot be read" + hdf5::reason());
  }
}

std::vector<std::string> Hdf5Reader::strings(const std::string& path) const {
  const std::size_t n = count_checked(path, {kAnySize});
  const Handle set = impl_->open_dataset(path);
  const Handle stored(H5Dget_type(set.get()), H5Tclose);
  if (H5Tget_class(stored.get()) != H5T_STRING || H5Tis_variable_str(stored.get()) != 0)
    impl_->fail("dataset '" + path + "' is no list of strings");
  const std::size_t width = H5Tget_size(stored.get());
  if (n > file_bytes() / width) impl_->fail("dataset '" + path + "' is larger than the file");
  std::vector<std::string> values(n);
  std::vector<char> bytes(n * width);
  if (n > 0 && H5Dread(set.get(), stored.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    impl_->fail("dataset '" + path + "' cannot be read" + hdf5::reason());
  for (std::size_t i = 0; i < n; ++i) {
    const char* value = bytes.data() + i * width;
    values[i].assign(value, strnlen(value, width));
  }
  return values;
}

std::string Hdf5Reader::text(const std::string& path) const {
  const Handle set = impl_->open_dataset(path);
  const Handle stored(H5Dget_type(set.get()), H5Tclose);
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const H5S_class_t extent = H5Sget_simple_extent_type(space.get());
  const bool is_text = H5Tget_class(stored.get()) == H5T_STRING && H5Tis_variable_str(stored.get()) == 0;
  if (!is_text || extent == H5S_SIMPLE) impl_->fail("dataset '" + path + "' is no text");
  if (extent == H5S_NULL) return "";
  const std::size_t n_bytes = H5Tget_size(stored.get());
  if (n_bytes > file_bytes()) impl_->fail("dataset '" + path + "' is larger than the file");
  std::string value(n_bytes, '\0');
  if (H5Dread(set.get(), stored.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) {
    impl_->fail("dataset '" + path + "' cannot be read" + hdf5::reason());
  }
  return value;
}

void Hdf5Reader::lay_against(const FileSchema& schema, std::size_t memory_limit_bytes) {
  impl_->layout.emplace(*this, schema, impl_->path, memory_limit_bytes);
}

std::size_t Hdf5Reader::size(std::string_view name) const {
  if (!impl_->layout) throw InternalError("a size is asked of a file that was laid against no schema");
  return impl_->layout->size(name);
}

template <Element T>
void Hdf5Reader::check_values(const std::string& path, std::span<const T> values, std::size_t first) const {
  if (impl_->layout) impl_->layout->check(path, values, first);
}

template void Hdf5Reader::check_values(const std::string&, std::span<const std::uint8_t>, std::size_t) const;
template void Hdf5Reader::check_values(const std::string&, std::span<const std::uint16_t>, std::size_t) const;
template void Hdf5Reader::check_values(const std::string&, std::span<const std::uint32_t>, std::size_t) const;
template void Hdf5Reader::check_values(const std::string&, std::span<const std::uint64_t>, std::size_t) const;
template void Hdf5Reader::check_values(const std::string&, std::span<const std::int32_t>, std::size_t) const;
template void Hdf5Reader::check_values(const std::string&, std::span<const std::int64_t>, std::size_t) const;
template void Hdf5Reader::check_values(const std::string&, std::span<const float>, std::size_t) const;
template void Hdf5Reader::check_values(const std::string&, std::span<const double>, std::size_t) const;

bool Hdf5Reader::has_attribute(const std::string& path, const std::string& name) const {
  return has(path) && H5Aexists_by_name(impl_->file.get(), path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5Reader::text_attribute(const std::string& path, const std::string& name) const {
  const Handle attribute = impl_->open_attribute(path, name);
  const Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const std::size_t width = H5Tget_size(stored.get());
  const bool is_text = H5Tget_class(stored.get()) == H5T_STRING && H5Tis_variable_str(stored.get()) == 0;
  std::string text(is_text && width <= file_bytes() ? width : 0, '\0');
  if (text.empty() || H5Aread(attribute.get(), stored.get(), text.data()) < 0)
    impl_->fail("attribute '" + name + "' of '" + path + "' is no text");
  text.resize(strnlen(text.data(), text.size()));
  return text;
}

double Hdf5Reader::number_attribute(const std::string& path, const std::string& name) const {
  const Handle attribute = impl_->open_attribute(path, name);
  const Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const H5T_class_t type = H5Tget_class(stored.get());
  double value = 0;
  if ((type != H5T_FLOAT && type != H5T_INTEGER) || H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0) {
    impl_->fail("attribute '" + name + "' of '" + path + "' is no number");
  }
  return value;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& path, const std::string& name) const {
  const Handle attribute = impl_->open_attribute(path, name);
  const Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  std::int64_t value = 0;
  if (H5Tget_class(stored.get()) != H5T_INTEGER || H5Aread(attribute.get(), H5T_NATIVE_INT64, &value) < 0) {
    impl_->fail("attribute '" + name + "' of '" + path + "' is no integer");
  }
  return value;
}

}  // namespace dim
