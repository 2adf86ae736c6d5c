#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/job.hpp"

/// DIM's binary files (.rays, .lum): HDF5 that h5py, h5dump and MATLAB open, with a header and a checksum of
/// the whole in the HDF5 user block (docs/formats-container.md). One object for writing, one for reading;
/// neither may be used by two threads at once, nor two of them at the same time by two threads (HDF5).
///
/// Paths inside a file are written "/group/name".
namespace dim {

/// Element types of datasets, little-endian in the file.
enum class ElementType { kUint8, kUint16, kUint32, kUint64, kInt32, kInt64, kFloat32, kFloat64 };

template <class T>
concept Element = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::uint64_t> || std::same_as<T, std::int32_t> ||
    std::same_as<T, std::int64_t> || std::same_as<T, float> || std::same_as<T, double>;

template <Element T>
consteval ElementType element_type() {
  if constexpr (std::is_floating_point_v<T>) {
    return sizeof(T) == 4 ? ElementType::kFloat32 : ElementType::kFloat64;
  } else if constexpr (std::is_signed_v<T>) {
    return sizeof(T) == 4 ? ElementType::kInt32 : ElementType::kInt64;
  } else {
    switch (sizeof(T)) {
      case 1:
        return ElementType::kUint8;
      case 2:
        return ElementType::kUint16;
      case 4:
        return ElementType::kUint32;
      default:
        return ElementType::kUint64;
    }
  }
}

struct FileSchema;

/// Sizes of a dataset's dimensions, the slowest first; empty for a single value.
using Shape = std::vector<std::size_t>;

/// In an expected shape: any size will do.
inline constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();

/// Builds a file in memory and writes it at once. The same content gives the same bytes: no times, no
/// addresses, no machine in it.
class Hdf5Writer {
 public:
  /// @param kind     "rays" or "lum"; also the root attribute `dim_format`
  /// @param version  of that format, >= 1; also the root attribute `dim_version`
  Hdf5Writer(const std::string& kind, int version);
  ~Hdf5Writer();
  Hdf5Writer(Hdf5Writer&&) noexcept;
  Hdf5Writer& operator=(Hdf5Writer&&) noexcept;

  /// An attribute of a group (made if absent) or of a dataset (written before); text is UTF-8.
  /// @throws InternalError  written twice
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, const char* value);
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);
  template <std::integral Integer>
  void attribute(const std::string& path, const std::string& name, Integer value) {
    if (!std::in_range<std::int64_t>(value)) throw InternalError("attribute '" + name + "' exceeds 64 bits");
    attribute(path, name, static_cast<std::int64_t>(value));
  }

  /// An array, row-major, contiguous in the file; the groups of its path are made on the way.
  ///
  /// @param data         as many elements as the product of `shape`
  /// @param unit         "m", "W/m2", …; "1" for none. Attribute `unit`
  /// @param description  attribute `description`, none when empty
  /// @throws InternalError  sizes that disagree, a path written twice
  /// @throws LimitError     not enough memory
  template <Element T>
  void dataset(const std::string& path, std::span<const T> data, const Shape& shape, const std::string& unit,
               const std::string& description = "") {
    write_array(path, element_type<T>(), data.data(), data.size(), shape, unit, description);
  }

  /// A list of UTF-8 strings, in the file as long as the longest and filled up with NUL.
  /// @throws InternalError  one of them holds a NUL, which HDF5 takes for its end
  void strings(const std::string& path, const std::vector<std::string>& values);

  /// One long text, kept byte for byte.
  void text(const std::string& path, const std::string& value);

  /// Puts the header in place and writes the file whole or not at all (AtomicFile); the writer is spent.
  /// @param path  a file, or `-` for standard output
  /// @param job   its stop flag ends the writing
  /// @returns     hash of the content, as Hdf5Reader::hash
  /// @throws IoError, Interrupted
  std::string write(const std::string& path, const Job& job = {}) &&;

 private:
  struct Impl;
  void write_array(const std::string& path, ElementType type, const void* data, std::size_t n_elements,
                   const Shape& shape, const std::string& unit, const std::string& description);
  std::unique_ptr<Impl> impl_;
};

/// Checks a file to its last bit, then opens it. A regular file is then read from the disk as asked for; a
/// pipe is held in memory.
class Hdf5Reader {
 public:
  /// @param path           a file, a fifo by name, or `-` for standard input
  /// @param expected_kind  "rays" or "lum"
  /// @param max_version    the newest version of it that the caller reads
  /// @param job            its stop flag ends the check of the whole file
  /// @param min_version    the oldest; the refusal says which program wrote the file and how to replace it
  /// @throws IoError  one line that says which: missing, a directory, empty, foreign, another kind, older or
  ///                  newer version, cut short, altered
  /// @throws Interrupted
  Hdf5Reader(const std::string& path, const std::string& expected_kind, int max_version, const Job& job = {},
             int min_version = 1);
  ~Hdf5Reader();
  Hdf5Reader(Hdf5Reader&&) noexcept;
  Hdf5Reader& operator=(Hdf5Reader&&) noexcept;

  int version() const;
  /// XXH3 128-bit of the content, 32 hex digits: two files of the same hash hold the same.
  const std::string& hash() const;
  std::uint64_t file_bytes() const;

  /// Lays the file against the layout of its kind: types, ranks and sizes at once, values as they are read.
  /// Every dataset read from then on must be in it.
  /// @param schema  lives as long as the reader
  /// @throws IoError, LimitError  as FileLayout; so do `dataset` and `read_rows` where a value is not allowed
  void lay_against(const FileSchema& schema, std::size_t memory_limit_bytes);
  /// A size that the layout names, as found in the file: "cells".
  std::size_t size(std::string_view name) const;

  /// Whether there is a dataset or group of this path.
  bool has(const std::string& path) const;
  /// @throws IoError  no such dataset
  Shape shape(const std::string& path) const;
  /// @throws IoError  no such dataset, or not of numbers
  ElementType type(const std::string& path) const;

  /// A whole dataset. Converted where the type of the file fits T without loss (uint16 → uint32 → double).
  /// @param expected  its shape, `kAnySize` where any size will do: {kAnySize, 3}
  /// @throws IoError  no such dataset, another type, another shape; names the dataset
  template <Element T>
  std::vector<T> dataset(const std::string& path, const Shape& expected) const {
    std::vector<T> values(count_checked(path, expected));
    read_array(path, element_type<T>(), values.data());
    check_values(path, std::span<const T>(values), 0);
    return values;
  }

  /// Part of a dataset: `n_rows` of its first dimension from `first_row` on, into the caller's memory.
  /// @param out  exactly as many elements as the rows hold
  /// @throws IoError        no such dataset, another type, fewer rows
  /// @throws InternalError  `out` of another size
  template <Element T>
  void read_rows(const std::string& path, std::size_t first_row, std::size_t n_rows, std::span<T> out) const {
    read_part(path, element_type<T>(), first_row, n_rows, out.data(), out.size());
    check_values(path, std::span<const T>(out), n_rows ? first_row * (out.size() / n_rows) : 0);
  }

  /// @throws IoError  no such dataset, or not a list of strings
  std::vector<std::string> strings(const std::string& path) const;
  /// @throws IoError  no such dataset, or not a text
  std::string text(const std::string& path) const;

  bool has_attribute(const std::string& path, const std::string& name) const;
  /// @throws IoError  no such attribute, or of another type
  std::string text_attribute(const std::string& path, const std::string& name) const;
  double number_attribute(const std::string& path, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& path, const std::string& name) const;

 private:
  struct Impl;
  std::size_t count_checked(const std::string& path, const Shape& expected) const;
  void read_array(const std::string& path, ElementType type, void* out) const;
  void read_part(const std::string& path, ElementType type, std::size_t first_row, std::size_t n_rows,
                 void* out, std::size_t n_elements) const;
  template <Element T>
  void check_values(const std::string& path, std::span<const T> values, std::size_t first) const;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dim
