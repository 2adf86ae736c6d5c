#pragma once

#include <string>
#include <vector>

#include "import/import_input.hpp"

namespace dim {

/// One primitive of a Radiance scene: `modifier type name`, then its texts and numbers.
struct RadiancePrimitive {
  std::string modifier, type, name;
  std::vector<std::string> texts;
  std::vector<double> numbers;
  Place place;
};

/// Goes through a Radiance scene primitive by primitive; comments are passed over.
class RadianceTokens {
 public:
  explicit RadianceTokens(const ImportInput& input) : input_(input) {}

  /// The next primitive; of a command (`!xform …`) only `type`, "!", and `name`, its line; of an alias
  /// `type`, "alias", its name and what it stands for as a text. False at the end.
  /// @throws InputError  a number or count that is none, or the end of the file within a primitive
  bool next(RadiancePrimitive& primitive);

 private:
  bool skip_blanks();
  std::string word(const char* what);
  std::string line();
  std::size_t count();
  double number();
  [[noreturn]] void refuse(const std::string& what) const;

  const ImportInput& input_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace dim
