#pragma once

#include <string>

namespace dim {

/// Both paths name the same file, whether it exists yet or not. Standard input and output, written `-`, and
/// special files are no files here.
bool is_same_file(const std::string& a, const std::string& b);

/// Tries whether a file can be written in its folder, and leaves no trace; `-` and special files pass.
/// @throws IoError  a directory, no such folder, no permission
void refuse_unwritable(const std::string& path);

}  // namespace dim
