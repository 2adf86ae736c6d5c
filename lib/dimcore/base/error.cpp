#include "base/error.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace dim {
namespace {

std::string join(const std::vector<Problem>& problems) {
  std::string text;
  for (const auto& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem);
  }
  return text;
}

// Letters added, left out, replaced, or swapped with their neighbour (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1), last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text = problem.place.file;
  if (problem.place.line > 0) {
    text += ':' + std::to_string(problem.place.line);
    if (problem.place.column > 0) text += ':' + std::to_string(problem.place.column);
  }
  if (!text.empty()) text += ": ";
  text += problem.what;
  if (!problem.cure.empty()) text += "\n        " + problem.cure;
  return text;
}

InputError::InputError(Problem problem)
    : Error(to_string(problem)), problems_{std::move(problem)}, n_found_(1) {}

InputError::InputError(std::vector<Problem> problems, std::size_t n_found)
    : Error(join(problems)), problems_(std::move(problems)), n_found_(n_found) {}

void Problems::add(Place place, std::string what, std::string cure) {
  ++n_found_;
  if (shown_.size() < kMaxShown) shown_.push_back({std::move(place), std::move(what), std::move(cure)});
}

void Problems::throw_if_any() const {
  if (empty()) return;
  // As they stand in each file, the files as they came.
  std::map<std::string, std::size_t> files;
  for (const auto& problem : shown_) files.emplace(problem.place.file, files.size());
  auto sorted = shown_;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Problem& a, const Problem& b) {
    return std::tuple(files[a.place.file], a.place.line, a.place.column) <
           std::tuple(files[b.place.file], b.place.line, b.place.column);
  });
  throw InputError(std::move(sorted), n_found_);
}

std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates) {
  const std::size_t limit = std::max<std::size_t>(1, word.size() / 3);
  std::string best;
  std::size_t best_distance = limit + 1;
  for (const auto& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(word, candidates);
  return nearest.empty() ? "" : "did you mean '" + nearest + "'?";
}

std::string name_cure(const std::string& word, const std::vector<std::string>& candidates) {
  constexpr std::size_t kMaxNames = 8;
  if (candidates.empty()) return "there is none";
  std::string cure = did_you_mean(word, candidates);
  if (!cure.empty()) return cure;
  std::vector<std::string> names;
  for (const auto& name : candidates)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  for (std::size_t i = 0; i < std::min(names.size(), kMaxNames); ++i)
    cure += (i == 0 ? "there is '" : ", '") + names[i] + "'";
  if (names.size() > kMaxNames) cure += " and " + std::to_string(names.size() - kMaxNames) + " more";
  return cure;
}

}  // namespace dim
