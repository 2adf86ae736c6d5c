#include "import/ply_header.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

#include "import/byte_reader.hpp"
#include "import/token_line.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

std::optional<PlyType> type_named(std::string_view word) {
  struct Name {
    const char *old_name, *name;
  };
  static constexpr std::array<Name, 8> kNames = {{{"char", "int8"},
                                                  {"uchar", "uint8"},
                                                  {"short", "int16"},
                                                  {"ushort", "uint16"},
                                                  {"int", "int32"},
                                                  {"uint", "uint32"},
                                                  {"float", "float32"},
                                                  {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (word == kNames[i].old_name || word == kNames[i].name) return static_cast<PlyType>(i);
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(const ImportInput& input) : input_(input), lines_(input.bytes) {}

  PlyHeader run() {
    std::string_view line;
    if (!lines_.next(line) || trimmed(line) != "ply") refuse("begins with no 'ply': not a PLY file");
    for (bool done = false; !done;) {
      if (!lines_.next(line)) refuse("ends within its header");
      done = statement(words_of(line));
    }
    header_.body = static_cast<std::size_t>(line.data() + line.size() - input_.bytes.data());
    // Behind the line's end, of one character or two.
    if (header_.body < input_.bytes.size() && input_.bytes[header_.body] == '\r') ++header_.body;
    if (header_.body < input_.bytes.size()) ++header_.body;
    header_.n_lines = lines_.line_number();
    return std::move(header_);
  }

 private:
  /// True at the end of the header.
  bool statement(const std::vector<std::string_view>& words) {
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return false;
    if (words[0] == "end_header") return true;
    if (words[0] == "format" && words.size() >= 2)
      encoding(words[1]);
    else if (words[0] == "element" && words.size() == 3)
      element(words);
    else if (words[0] == "property" && !header_.elements.empty() && (words.size() == 3 || words.size() == 5))
      property(words);
    else
      refuse(fmt::format("{} is not understood in a header", dim::quoted(words[0])));
    return false;
  }

  void encoding(std::string_view word) {
    if (word == "ascii")
      header_.encoding = PlyEncoding::text;
    else if (word == "binary_little_endian")
      header_.encoding = PlyEncoding::little_endian;
    else if (word == "binary_big_endian")
      header_.encoding = PlyEncoding::big_endian;
    else
      refuse(fmt::format("format {} is not known", dim::quoted(word)));
  }

  void element(const std::vector<std::string_view>& words) {
    PlyElement element;
    element.name = std::string(words[1]);
    element.line = lines_.line_number();
    const auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.n);
    if (error != std::errc() || end != words[2].data() + words[2].size())
      refuse(fmt::format("{} is no number of elements", dim::quoted(words[2])));
    header_.elements.push_back(std::move(element));
  }

  void property(const std::vector<std::string_view>& words) {
    PlyProperty property;
    property.is_list = words[1] == "list";
    if (property.is_list != (words.size() == 5))
      refuse("a property is 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    if (property.is_list) property.count_type = type(words[2]);
    property.type = type(property.is_list ? words[3] : words[1]);
    property.name = std::string(words.back());
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType type(std::string_view word) const {
    const auto found = type_named(word);
    if (!found) refuse(fmt::format("type {} is not known", dim::quoted(word)));
    return *found;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError({input_.place(std::max(lines_.line_number(), 1)), what, ""});
  }

  const ImportInput& input_;
  LineReader lines_;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  static constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

double as_double(PlyType type, const char* bytes, bool big) {
  switch (type) {
    case PlyType::int8:
      return static_cast<double>(static_cast<std::int8_t>(bytes[0]));
    case PlyType::uint8:
      return static_cast<double>(static_cast<std::uint8_t>(bytes[0]));
    case PlyType::int16:
      return static_cast<double>(number_at<std::int16_t>(bytes, big));
    case PlyType::uint16:
      return static_cast<double>(number_at<std::uint16_t>(bytes, big));
    case PlyType::int32:
      return static_cast<double>(number_at<std::int32_t>(bytes, big));
    case PlyType::uint32:
      return static_cast<double>(number_at<std::uint32_t>(bytes, big));
    case PlyType::float32:
      return static_cast<double>(number_at<float>(bytes, big));
    case PlyType::float64:
      return number_at<double>(bytes, big);
  }
  return 0.0;
}

PlyHeader read_ply_header(const ImportInput& input) { return HeaderReader(input).run(); }

}  // namespace dim
