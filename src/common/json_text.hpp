#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace dim {

/// JSON with an end of line. Names and texts of files may hold bytes that are no UTF-8: each becomes the
/// replacement character, for JSON knows no others.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace dim
