#include "database/entry_name.hpp"

#include <algorithm>

namespace dim {
namespace {

constexpr std::size_t kLongest = 100;

bool is_safe(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
         c == '+' || c == '.' || byte >= 0x80;
}

}  // namespace

bool is_entry_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongest && name.front() != '-' && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), is_safe);
}

std::string entry_name_from(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool safe = is_safe(c) && !(name.empty() && (c == '-' || c == '.'));
    if (safe)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  if (name.size() > kLongest) {
    std::size_t cut = kLongest;
    while (cut > 0 && (static_cast<unsigned char>(name[cut]) & 0xC0U) == 0x80U) --cut;
    name.resize(cut);
  }
  while (!name.empty() && (name.back() == '-' || name.back() == '.')) name.pop_back();
  return name;
}

}  // namespace dim
