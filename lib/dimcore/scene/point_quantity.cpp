#include "scene/point_quantity.hpp"

#include <algorithm>
#include <cmath>

#include "database/toml_reader.hpp"

namespace dim {
namespace {

constexpr double kStraight = 1e-6;
const std::string kFour = "vertical4";

std::vector<std::string> words() {
  auto words = quantity_words();
  words.push_back(kFour);
  return words;
}

bool is_vertical(const Vec3& normal) { return std::hypot(normal.x, normal.y) <= kStraight; }

Vec3 level(const Vec3& normal) { return glm::normalize(Vec3(normal.x, normal.y, 0.0)); }

std::vector<Facing> four_ways(const Vec3& front) {
  const Vec3 left(-front.y, front.x, 0.0);
  return {{".front", {front}}, {".left", {left}}, {".back", {-front}}, {".right", {-left}}};
}

}  // namespace

PointQuantity::PointQuantity(const TomlTable& table) {
  const auto word = table.word("quantity", words());
  if (!word) return;
  four_ = *word == kFour;
  const auto& known = quantity_words();
  if (!four_) quantity_ = static_cast<Quantity>(std::find(known.begin(), known.end(), *word) - known.begin());
}

std::vector<Facing> PointQuantity::facings(const Vec3& normal, std::string& fault) const {
  if (four_) return four_ways(is_vertical(normal) ? Vec3(1, 0, 0) : level(normal));
  if (quantity_ == Quantity::cylindrical) {
    if (!is_vertical(normal)) fault = "the axis of cylindrical illuminance is vertical";
    return {{"", {{0, 0, 1}, quantity_}}};
  }
  if (quantity_ == Quantity::semicylindrical) {
    if (std::abs(normal.z) > kStraight) fault = "semicylindrical illuminance is that of half a cylinder which faces a level way";
    return {{"", {is_vertical(normal) ? Vec3(1, 0, 0) : level(normal), quantity_}}};
  }
  return {{"", {normal, quantity_}}};
}

}  // namespace dim
