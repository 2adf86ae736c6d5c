#include "common/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "common/json_text.hpp"

namespace dim {
namespace {

void append_csv(fmt::memory_buffer& out, const Table::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    fmt::format_to(std::back_inserter(out), "{}", csv_field(*text));
  else if (const auto* whole = std::get_if<long>(&value))
    fmt::format_to(std::back_inserter(out), "{}", *whole);
  else if (const double number = std::get<double>(value); !std::isnan(number))
    fmt::format_to(std::back_inserter(out), "{:.9g}", number == 0.0 ? 0.0 : number);
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string Table::csv() const {
  fmt::memory_buffer out;
  const auto line = [&](const auto& values, const auto& append) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) out.push_back(',');
      append(values[i]);
    }
    out.push_back('\n');
  };
  line(columns_,
       [&](const std::string& name) { fmt::format_to(std::back_inserter(out), "{}", csv_field(name)); });
  for (const auto& row : rows_) line(row, [&](const Value& value) { append_csv(out, value); });
  return fmt::to_string(out);
}

std::string Table::json() const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& row : rows_) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      std::visit([&](const auto& value) { object[columns_[i]] = value; }, row[i]);
    list.push_back(std::move(object));
  }
  return json_text(list);
}

}  // namespace dim
