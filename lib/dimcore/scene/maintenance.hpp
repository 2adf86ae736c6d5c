#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "scene/lights.hpp"

namespace dim {

class TomlTable;

/// The maintenance factors of a lights file: maintained light over initial light of a luminaire (its own key), of a
/// group (`[maintenance]`), or of all (`maintenance_factor` of the file), the first of these that is said. They are kept
/// beside the light, which stays that of the luminaires as new.
class Maintenance {
 public:
  /// Reads what the file says of all and of groups.
  explicit Maintenance(const TomlTable& root);

  /// Sets a luminaire's factor. A fitting whose database entry has a maintenance factor gives maintained light already:
  /// the file's for all passes it by; one of its own or its group's would take from it twice, and is refused.
  /// @param table  of the luminaire
  void set(const TomlTable& table, const Fitting& fitting, Luminaire& luminaire);

  /// Reports groups that no luminaire is in.
  void check_groups(const Lights& lights, Problems& problems) const;

 private:
  struct OfGroup {
    double factor;
    Place place;
  };
  std::optional<double> of_all_;
  std::map<std::string, OfGroup> of_group_;
};

}  // namespace dim
