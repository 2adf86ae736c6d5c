#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "base/error.hpp"
#include "base/job.hpp"
#include "import/imported_model.hpp"

namespace dim {

/// A file to be imported, in memory, and a way to the files beside it that it names.
struct ImportInput {
  std::string_view bytes;
  std::string name;  ///< for messages
  /// The bytes of a file that the model names, relative to it; nothing where it is not there.
  /// @throws IoError  it is there and cannot be read
  std::function<std::optional<std::string>(const std::string& path)> beside;
  Job job;

  Place place(int line, int column = 0) const { return {name, line, column}; }
};

/// Largest file that is read.
inline constexpr std::size_t kMaxImportBytes = std::size_t{1} << 30;

/// Gathers what a reader does not understand: one warning a word, with how often and where first.
class Unknowns {
 public:
  /// @param what  "statement 'vt'"
  void add(const std::string& what, const Place& place, const std::string& cure = "");
  void tell(Warnings& warnings) const;

 private:
  struct Entry {
    std::string what, cure;
    Place place;
    std::size_t n = 0;
  };
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::size_t> index_;
};

/// Finds materials by name in a model that is being read: the index of each is looked up once.
class MaterialIndex {
 public:
  explicit MaterialIndex(ImportedModel& model) : model_(model) {}
  int operator()(const std::string& name);

 private:
  ImportedModel& model_;
  std::unordered_map<std::string, int> index_;
};

/// Refuses models beyond kMaxImportedFaces or kMaxImportedCorners, and those that would not fit into memory.
class FaceCounter {
 public:
  explicit FaceCounter(const ImportInput& input) : input_(input) {}
  /// @throws LimitError
  void add(std::size_t n_corners);

 private:
  const ImportInput& input_;
  std::size_t n_faces_ = 0, n_corners_ = 0;
};

/// Memory that importing takes, bytes: as measured of a million triangles (1.26 GB), and a little more.
std::size_t import_memory_bytes(std::size_t n_faces, std::size_t n_corners);

}  // namespace dim
