#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dim {

/// A file to be put into a folder of the database.
struct StoredFile {
  std::string name;  ///< without folder
  std::string bytes;
};

/// A folder of entries (`db/fittings`, `db/surfaces`) that several processes may change at once: each change
/// holds the folder's lock, files appear whole, and a name that is taken is never replaced unasked.
class EntryStore {
 public:
  /// Makes the folder, and those above it, where they are missing.
  /// @throws IoError
  explicit EntryStore(std::string folder);
  ~EntryStore();
  EntryStore(const EntryStore&) = delete;
  EntryStore& operator=(const EntryStore&) = delete;

  /// Puts the files of one entry in place, the entry's own TOML file last. Without `replace` nothing is
  /// changed where one of the names is taken.
  /// @returns         the first name that is taken; nothing where all was written
  /// @throws IoError  then the files written so far are taken away again
  std::optional<std::string> add(const std::vector<StoredFile>& files, bool replace);

  /// Takes files away; those that are not there are passed over.
  /// @throws IoError
  void remove(const std::vector<std::string>& names);

  const std::string& folder() const { return folder_; }

 private:
  std::string path_of(const std::string& name) const;

  std::string folder_;
  int lock_ = -1;
};

}  // namespace dim
