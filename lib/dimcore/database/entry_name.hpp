#pragma once

#include <string>
#include <string_view>

namespace dim {

/// Whether a name may be an entry's: 1 to 100 bytes of letters, digits, '-', '_', '+', '.', and UTF-8 beyond
/// ASCII; begins with neither '-' nor '.'. Such a name is a safe file name everywhere.
bool is_entry_name(std::string_view name);

/// The nearest such name: other characters become '-', several of them one. Empty where nothing is left.
std::string entry_name_from(std::string_view text);

}  // namespace dim
