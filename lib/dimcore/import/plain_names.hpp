#pragma once

#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace dim {

/// Names as a zone file may have them, each given once. What is no UTF-8 is read as Windows-1252 or
/// Shift-JIS, control characters become blanks, names beyond 180 bytes are cut.
class PlainNames {
 public:
  /// @param fallback  for names that are empty
  explicit PlainNames(std::string fallback) : fallback_(std::move(fallback)) {}

  /// The name, with `.2`, `.3` … behind it from the second use on.
  std::string add(const std::string& raw);
  /// Names that had to be changed, "old → new".
  const std::vector<std::string>& replaced() const { return replaced_; }

 private:
  std::string plain(const std::string& raw);

  std::string fallback_;
  std::unordered_map<std::string, std::string> plain_;
  std::unordered_map<std::string, int> used_;  ///< how many of this stem
  std::set<std::string> taken_;
  std::vector<std::string> replaced_;
};

}  // namespace dim
