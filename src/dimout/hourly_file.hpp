#pragma once

#include <string>
#include <vector>

#include "base/hdf5_series.hpp"
#include "climate/annual.hpp"
#include "climate/blinds.hpp"
#include "result/database.hpp"
#include "sky/epw.hpp"

namespace dim {

/// Illuminance at every step and point as an HDF5 file: docs/daylight.md.
class HourlyFile {
 public:
  /// @param sets  whose points are columns, in this order
  /// @throws IoError
  HourlyFile(const std::string& path, const LuminanceDatabase& database, const Weather& weather,
             const std::vector<PointSet>& sets, const std::vector<BlindYear>& blinds, const Job& job);

  void add(const PointBlock& block);
  void commit() { file_.commit(); }

 private:
  Hdf5Series file_;
  std::vector<PointSet> sets_;
};

}  // namespace dim
