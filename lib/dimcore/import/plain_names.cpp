#include "import/plain_names.hpp"

#include <fmt/format.h>

#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

constexpr std::size_t kMaxBytes = 180;

std::string cut(std::string text) {
  if (text.size() <= kMaxBytes) return text;
  std::size_t end = kMaxBytes;
  // Not within a character of several bytes.
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end);
}

}  // namespace

std::string PlainNames::plain(const std::string& raw) {
  const auto known = plain_.find(raw);
  if (known != plain_.end()) return known->second;
  std::string name(trimmed(cut(to_utf8(raw))));
  if (name.empty()) name = fallback_;
  if (!raw.empty() && name != trimmed(raw))
    replaced_.push_back(fmt::format("{} → {}", dim::quoted(raw), name));
  plain_.emplace(raw, name);
  return name;
}

std::string PlainNames::add(const std::string& raw) {
  const std::string stem = plain(raw);
  int& n = used_[stem];
  while (true) {
    std::string name = ++n == 1 ? stem : fmt::format("{}.{}", stem, n);
    // A two-sided surface's other face is called NAME.back.
    if (taken_.count(name + ".back") > 0) continue;
    if (name.size() > 5 && name.ends_with(".back") && taken_.count(name.substr(0, name.size() - 5)) > 0)
      continue;
    if (taken_.insert(name).second) return name;
  }
}

}  // namespace dim
