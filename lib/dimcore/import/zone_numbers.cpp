#include "import/zone_numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace dim {

ZoneNumbers::ZoneNumbers(double single_precision_m) {
  constexpr double kSpacing = 6e-8;
  if (single_precision_m > 0.0)
    per_m_ = std::min(1e9, std::pow(10.0, -std::ceil(std::log10(single_precision_m * kSpacing))));
}

std::string ZoneNumbers::values(const Vec3& p) const {
  const auto text = [&](double value) {
    const double rounded = std::round(value * per_m_) / per_m_;
    return fmt::format("{:.15g}", rounded == 0.0 ? 0.0 : rounded);
  };
  return text(p.x) + ", " + text(p.y) + ", " + text(p.z);
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMostShown = 8;
  std::set<std::string> seen;
  std::string text;
  for (const std::string& name : names) {
    if (!seen.insert(name).second || seen.size() > kMostShown) continue;
    text += fmt::format("{}'{}'", text.empty() ? "" : ", ", name);
  }
  return seen.size() > kMostShown ? text + fmt::format(" and {} more", seen.size() - kMostShown) : text;
}

}  // namespace dim
