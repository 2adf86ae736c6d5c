#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/job.hpp"

namespace dim {

/// A plain HDF5 file for other programs (h5py, MATLAB, xarray): one table of numbers on two dimension scales, written
/// to the disk part by part, so that it may be larger than memory. It appears whole or not at all (AtomicFile). Not a
/// file of DIM's own: no header, no checksum. Never used by two threads at once.
class Hdf5Series {
 public:
  /// @param path  a regular file or none yet
  /// @param kind  root attribute `dim_format`
  /// @throws IoError  it cannot be written, or is a pipe or device, which HDF5 cannot write
  Hdf5Series(const std::string& path, const std::string& kind, int version, const Job& job = {});
  ~Hdf5Series();
  Hdf5Series(const Hdf5Series&) = delete;
  Hdf5Series& operator=(const Hdf5Series&) = delete;

  /// Root attribute.
  void attribute(const std::string& name, const std::string& value);

  /// A list of numbers, or of texts, along one dimension. Names of datasets are without a slash.
  void numbers(const std::string& name, std::span<const double> values, const std::string& unit,
               const std::string& description);
  void texts(const std::string& name, const std::vector<std::string>& values, const std::string& description);

  /// Begins the table [rows, columns] of single precision, chunked. @param row_scale, column_scale  lists written
  /// before, as long as its sides: they become dimension scales
  void table(const std::string& name, const std::string& row_scale, const std::string& column_scale,
             const std::string& unit, const std::string& description);

  /// Columns [first, first + n) of the table. @param values  [n_rows, n]
  void columns(std::size_t first, std::size_t n, std::span<const float> values);

  /// Puts the file in its place. Once, last. @throws IoError
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dim
