#include "base/error.hpp"

#include <algorithm>
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

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substitute, row[j] + 1, row[j - 1] + 1});
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
  if (!empty()) throw InputError(shown_, n_found_);
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

}  // namespace dim
