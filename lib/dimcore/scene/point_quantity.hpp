#pragma once

#include <string>
#include <vector>

#include "hemisphere/response.hpp"

namespace dim {

class TomlTable;

/// One of the sets of measuring points that a plane or sensor list stands for.
struct Facing {
  std::string suffix;  ///< of its name; empty for the only one
  Response response;
};

/// The `quantity` of a plane or sensor list: a word of Quantity, or "vertical4", which is four planar sets that face
/// level ways a quarter turn apart.
class PointQuantity {
 public:
  /// Reads the key; planar where it is missing or refused.
  explicit PointQuantity(const TomlTable& table);

  bool takes_direction() const { return four_ || quantity_ == Quantity::semicylindrical; }
  Quantity quantity() const { return quantity_; }

  /// What points with this normal measure. Of four sets the first faces the level part of the normal, +x where it has
  /// none. Cylinders stand upright, half cylinders face a level way.
  /// @param normal  unit
  /// @param fault   set where the normal does not fit
  std::vector<Facing> facings(const Vec3& normal, std::string& fault) const;

 private:
  Quantity quantity_ = Quantity::planar;
  bool four_ = false;
};

}  // namespace dim
