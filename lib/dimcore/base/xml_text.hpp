#pragma once

#include <string>

namespace dim {

/// Text as the content of an element of XML or HTML: what would be markup is spelt out, control characters that
/// neither may hold are left out.
std::string xml_text(const std::string& text);

}  // namespace dim
