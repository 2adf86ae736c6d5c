#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

/// Errors of the library: what is wrong, where, with the value and its allowed range, and what to do.
/// The library throws these and never prints; the programs turn them into text and an exit status.
namespace dim {

/// A place in an input file. line and column count from 1; 0 means "not known".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// One thing wrong with an input (or worth a warning).
struct Problem {
  Place place;
  std::string what;  ///< complete in itself: names the thing, the value, the allowed range
  std::string cure;  ///< what the user can do; may be empty
};

/// `file:line:column: what`, and the cure on an indented second line where there is one.
std::string to_string(const Problem& problem);

/// Base of all errors the library throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Input data is wrong (exit status 3). Holds every problem found in the file.
class InputError : public Error {
 public:
  explicit InputError(Problem problem);
  InputError(std::vector<Problem> problems, std::size_t n_found);
  const std::vector<Problem>& problems() const { return problems_; }
  /// How many were found; more than problems().size() where the list was cut.
  std::size_t n_found() const { return n_found_; }

 private:
  std::vector<Problem> problems_;
  std::size_t n_found_ = 0;
};

/// A file or the system failed: cannot open, disk full, not a file of ours (exit status 4).
class IoError : public Error {
 public:
  /// @param path   the file, `-` for a pipe
  /// @param what   the failure in words, errno text included where there is one
  IoError(const std::string& path, const std::string& what) : Error(path + ": " + what) {}
};

/// A request that cannot fit in memory or in a format (exit status 4). Says the size needed and the option
/// that reduces it.
class LimitError : public Error {
 public:
  using Error::Error;
};

/// An invariant of ours is broken (exit status 5).
class InternalError : public Error {
 public:
  using Error::Error;
};

/// The user asked to stop (exit status 130).
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

/// Gathers the problems of one input so that they are reported together, the first 20 in full.
class Problems {
 public:
  static constexpr std::size_t kMaxShown = 20;

  void add(Place place, std::string what, std::string cure = "");
  bool empty() const { return n_found_ == 0; }
  /// @throws InputError when anything was added, ordered by line within each file
  void throw_if_any() const;

 private:
  std::vector<Problem> shown_;
  std::size_t n_found_ = 0;
};

using Warnings = std::vector<Problem>;

/// The candidate nearest to `word` by edit distance, or empty when none is near enough to suggest.
std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates);

/// " did you mean 'x'?" helper: the cure sentence for an unknown name, empty when nothing is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// The cure for a name that is not there: the nearest one, else the names there are, the first 8 in full.
std::string name_cure(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace dim
