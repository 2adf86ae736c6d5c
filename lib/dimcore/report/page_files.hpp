#pragma once

#include <string_view>

namespace dim {

/// Text of a file of report/page, put into the library when it was built.
/// @throws InternalError  no such file
std::string_view page_file(std::string_view name);

}  // namespace dim
