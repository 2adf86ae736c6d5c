#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dim {

/// Values of rows (cells, measuring points) for many columns (sources in reflectance classes) in the layout
/// that they are solved in: [block of at most 32 columns][row][column of the block]. No block is padded.
/// Light is stored as `float` and solved as `double`.
template <class Real>
class Columns {
 public:
  static constexpr std::size_t kBlockColumns = 32;

  Columns() = default;
  /// All zero.
  Columns(std::size_t n_rows, std::size_t n_columns)
      : n_rows_(n_rows), n_columns_(n_columns), values_(n_rows * n_columns) {}
  /// @param rows  [n_rows, n_columns], last fastest
  template <class Other>
  static Columns from_rows(const std::vector<Other>& rows, std::size_t n_columns) {
    Columns columns(n_columns > 0 ? rows.size() / n_columns : 0, n_columns);
    for (std::size_t c = 0; c < n_columns; ++c) {
      const Strided column = columns.column(c);
      for (std::size_t row = 0; row < columns.n_rows(); ++row)
        column[row] = static_cast<Real>(rows[row * n_columns + c]);
    }
    return columns;
  }

  std::size_t n_rows() const { return n_rows_; }
  std::size_t n_columns() const { return n_columns_; }
  std::size_t n_blocks() const { return (n_columns_ + kBlockColumns - 1) / kBlockColumns; }

  /// Columns of a block, and the first of its [n_rows, width] values.
  std::size_t width(std::size_t block) const {
    return std::min(kBlockColumns, n_columns_ - block * kBlockColumns);
  }
  Real* block(std::size_t block) { return values_.data() + block * kBlockColumns * n_rows_; }
  const Real* block(std::size_t block) const { return values_.data() + block * kBlockColumns * n_rows_; }

  /// One column, indexed by row.
  template <class Value>
  struct View {
    Value* first;
    std::size_t stride;
    Value& operator[](std::size_t row) const { return first[row * stride]; }
  };
  using Strided = View<Real>;
  using ConstStrided = View<const Real>;
  Strided column(std::size_t column) {
    return {block(column / kBlockColumns) + column % kBlockColumns, width(column / kBlockColumns)};
  }
  ConstStrided column(std::size_t column) const {
    return {block(column / kBlockColumns) + column % kBlockColumns, width(column / kBlockColumns)};
  }
  Real value(std::size_t row, std::size_t column) const { return this->column(column)[row]; }

 private:
  std::size_t n_rows_ = 0;
  std::size_t n_columns_ = 0;
  std::vector<Real> values_;
};

}  // namespace dim
