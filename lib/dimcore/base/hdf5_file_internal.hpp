#pragma once

// Shared by the writer and the reader, and by nothing else: the only header that shows HDF5 itself.

#include <hdf5.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/hdf5_file.hpp"

namespace dim::hdf5 {

/// One identifier of the HDF5 library, closed with its owner.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Stops the library's own printing of errors, which the callers turn into exceptions.
void silence();

/// The library's words for its last failure, in brackets after a space, or nothing.
std::string reason();

hid_t file_type(ElementType type);
hid_t memory_type(ElementType type);
const char* name_of(ElementType type);

/// UTF-8 text of exactly `n_bytes` >= 1.
Handle fixed_string_type(std::size_t n_bytes);

/// A text attribute of an object. @param path  of the object, for messages
/// @throws InternalError  written twice, or a NUL in it
void write_text(hid_t object, const std::string& path, const std::string& name, const std::string& value);
/// A single value. @throws InternalError  written twice
void write_value(hid_t object, const std::string& path, const std::string& name, hid_t type, const void* value);

/// Without times, so that equal content gives equal bytes.
Handle timeless(hid_t property_class);
Handle dataspace(const Shape& shape);

/// @throws InternalError  unless `success`
void require(bool success, const std::string& path);

/// "/a/b/c" → "/a", "/a/b", "/a/b/c"; "/" → nothing.
std::vector<std::string> levels(const std::string& path);

/// "[100, 3]", `*` for any size.
std::string shape_in_words(const Shape& shape);

/// A property list for files held in memory, and a name for such a file that no other has and none on disk
/// can have. HDF5 takes files of equal names for one.
Handle memory_access(std::size_t increment_bytes);
std::string memory_name(const void* owner);

}  // namespace dim::hdf5
