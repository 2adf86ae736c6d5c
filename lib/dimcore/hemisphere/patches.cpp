#include "hemisphere/patches.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr long kMaxPatches = 10'000'000;

bool parse_count(const char* first, const char* last, long& value) {
  const auto result = std::from_chars(first, last, value);
  return result.ec == std::errc() && result.ptr == last && value >= 1 && value <= kMaxPatches;
}

// Patches near the middle slices are square when b is about pi times a (their height is 1/a, their width
// 2 pi/b * sin(theta) with sin(theta) about 0.8 there, and the cosine compresses the height).
PatchGrid most_square(long n) {
  PatchGrid best{1, static_cast<int>(n)};
  double best_fit = 1e300;
  for (long a = 1; a <= n; ++a) {
    if (n % a != 0) continue;
    const double fit = std::abs(std::log(static_cast<double>(n / a) / (2.5 * static_cast<double>(a))));
    if (fit < best_fit) {
      best_fit = fit;
      best = {static_cast<int>(a), static_cast<int>(n / a)};
    }
  }
  return best;
}

}  // namespace

Vec3 PatchGrid::centre(int slice, int sector) const {
  const double cosine = (slice + 0.5) / n_slices, sine = std::sqrt(1.0 - cosine * cosine);
  const double azimuth = 2.0 * kPi * (sector + 0.5) / n_sectors;
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

std::size_t PatchGrid::patch_of(const Vec3& direction) const {
  const int slice = std::clamp(static_cast<int>(direction.z * n_slices), 0, n_slices - 1);
  double turns = std::atan2(direction.y, direction.x) / (2.0 * kPi);
  if (turns < 0.0) turns += 1.0;
  const int sector = std::clamp(static_cast<int>(turns * n_sectors), 0, n_sectors - 1);
  return static_cast<std::size_t>(slice) * static_cast<std::size_t>(n_sectors) +
         static_cast<std::size_t>(sector);
}

PatchGrid parse_patches(const std::string& text, const std::string& option) {
  const char* first = text.data();
  const char* last = first + text.size();
  const char* cross = std::find(first, last, 'x');
  long a = 0, b = 0;
  const bool good =
      cross == last ? parse_count(first, last, a)
                    : parse_count(first, cross, a) && parse_count(cross + 1, last, b) && a * b <= kMaxPatches;
  if (!good)
    throw InputError({{},
                      option + " '" + text + "' is not AxB or a total of 1..10000000 patches",
                      "write for example " + option + " 16x32"});
  return cross == last ? most_square(a) : PatchGrid{static_cast<int>(a), static_cast<int>(b)};
}

}  // namespace dim
