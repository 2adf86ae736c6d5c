#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace dim {

/// Which cell each ray ends on: [row, patch], two bytes an entry where the cells can be counted in two bytes,
/// four otherwise. The entry `n_cells` means that the ray ends nowhere (it left an open zone or met the back
/// of a surface).
class SinkTable {
 public:
  SinkTable() = default;
  /// Entries are not initialised.
  SinkTable(std::size_t n_rows, std::size_t n_patches, std::size_t n_cells)
      : n_rows_(n_rows), n_patches_(n_patches), wide_(is_wide(n_cells)) {
    if (wide_)
      wide_entries_ = std::make_unique_for_overwrite<std::uint32_t[]>(n_rays());
    else
      narrow_entries_ = std::make_unique_for_overwrite<std::uint16_t[]>(n_rays());
  }

  static bool is_wide(std::size_t n_cells) { return n_cells > 0xFFFF; }

  std::size_t n_rows() const { return n_rows_; }
  std::size_t n_patches() const { return n_patches_; }
  std::size_t n_rays() const { return n_rows_ * n_patches_; }
  std::size_t n_bytes() const { return n_rays() * (wide_ ? 4 : 2); }
  bool wide() const { return wide_; }

  void set(std::size_t row, std::size_t patch, std::uint32_t sink) {
    if (wide_)
      wide_entries_[row * n_patches_ + patch] = sink;
    else
      narrow_entries_[row * n_patches_ + patch] = static_cast<std::uint16_t>(sink);
  }
  std::uint32_t at(std::size_t row, std::size_t patch) const {
    return wide_ ? wide_entries_[row * n_patches_ + patch] : narrow_entries_[row * n_patches_ + patch];
  }

  std::span<std::uint16_t> narrow() { return {narrow_entries_.get(), wide_ ? 0 : n_rays()}; }
  std::span<std::uint32_t> wide_entries() { return {wide_entries_.get(), wide_ ? n_rays() : 0}; }
  std::span<const std::uint16_t> narrow() const { return {narrow_entries_.get(), wide_ ? 0 : n_rays()}; }
  std::span<const std::uint32_t> wide_entries() const { return {wide_entries_.get(), wide_ ? n_rays() : 0}; }

  /// Calls f with a pointer to the entries in their own width, const std::uint16_t* or const std::uint32_t*.
  template <class F>
  auto visit(F&& f) const {
    return wide_ ? f(static_cast<const std::uint32_t*>(wide_entries_.get()))
                 : f(static_cast<const std::uint16_t*>(narrow_entries_.get()));
  }

 private:
  std::size_t n_rows_ = 0;
  std::size_t n_patches_ = 0;
  bool wide_ = false;
  std::unique_ptr<std::uint16_t[]> narrow_entries_;
  std::unique_ptr<std::uint32_t[]> wide_entries_;
};

}  // namespace dim
