#pragma once

#include <string>

#include "base/error.hpp"

namespace dim {

/// Calls `work` and gives the problems it reports without a place the file they are about.
template <class Work>
auto in_file(const std::string& path, Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const InputError& error) {
    auto problems = error.problems();
    for (auto& problem : problems)
      if (problem.place.file.empty()) problem.place.file = path == "-" ? "<stdin>" : path;
    throw InputError(std::move(problems), error.n_found());
  }
}

}  // namespace dim
