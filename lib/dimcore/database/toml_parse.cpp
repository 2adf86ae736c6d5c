#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "database/toml_reader.hpp"
#include "database/toml_syntax.hpp"

namespace dim {
namespace {

constexpr int kMaxKeyDepth = 64;

bool is_key_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '"' || c == '\'';
}

// The parser follows a dotted key down one table a dot, and destroys them recursively: a line of a million
// dots would end in a stack overflow. Values cannot do this, their nesting is limited in the parser itself.
void refuse_deep_keys(std::string_view text, const std::string& file) {
  int depth = 0, line = 1;
  std::size_t line_start = 0;
  bool after_key = false, after_dot = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line, line_start = i + 1;
    if (is_key_character(c)) {
      if (after_dot && ++depth > kMaxKeyDepth)
        throw InputError(Problem{{file, line, static_cast<int>(i - line_start + 1)},
                                 fmt::format("key nested more than {} deep", kMaxKeyDepth),
                                 ""});
      after_key = true;
      after_dot = false;
    } else if (c == '.') {
      after_dot = after_key;
      after_key = false;
    } else if (c != ' ' && c != '\t') {
      depth = 0;
      after_key = after_dot = false;
    }
  }
}

// Files of DIM itself, given in the place of another.
void refuse_binary(std::string_view text, const std::string& file, const TomlKind& kind) {
  if (!text.starts_with("DIM file\n")) return;
  const std::string_view header = text.substr(0, 200);
  const auto is = [&](const char* what) { return header.find(what) != std::string_view::npos; };
  const bool rays = is("kind rays"), lum = is("kind lum");
  throw InputError(Problem{{file, 0, 0},
                           fmt::format("is {}, not a {} file",
                                       rays  ? "a ray network"
                                       : lum ? "a luminance database"
                                             : "a binary file of DIM",
                                       kind.kind),
                           rays  ? "dimray reads it: dimray ROOM.rays LIGHTS.toml -o ROOM.lum"
                           : lum ? "dimout reads it: dimout grid ROOM.lum"
                                 : ""});
}

struct Override {
  std::string text;              ///< as written
  std::vector<std::string> key;  ///< path
  toml::table holder;            ///< the value, under "v"
};

Place place_of_override(const std::string& text) { return {"--set " + text, 0, 0}; }

[[noreturn]] void refuse(const std::string& text, const std::string& what, const std::string& cure) {
  throw InputError(Problem{place_of_override(text), what, cure});
}

std::vector<std::string> split_key(const std::string& text, std::string_view key) {
  std::vector<std::string> parts(1);
  char quote = 0;
  for (const char c : key) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        parts.back() += c;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '.') {
      parts.emplace_back();
    } else if (c != ' ' && c != '\t') {
      parts.back() += c;
    }
  }
  if (parts.size() > static_cast<std::size_t>(kMaxKeyDepth) ||
      std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); }))
    refuse(text, "not a key", "write KEY=VALUE, for example finishes.wall.diffuse=0.7");
  return parts;
}

std::string as_basic_string(std::string_view value) {
  std::string quoted = "v = \"";
  for (const char c : value) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

toml::table parse_value(const std::string& text, std::string_view value) {
  const std::string place = "--set " + text;
  const std::string assignment = "v = " + std::string(value);
  refuse_deep_keys(assignment, place);
  try {
    auto table = toml::parse(std::string_view(assignment), std::string_view(place));
    if (table.size() == 1 && table.contains("v")) return table;
  } catch (const toml::parse_error&) {
  }
  try {
    return toml::parse(std::string_view(as_basic_string(value)), std::string_view(place));
  } catch (const toml::parse_error& error) {
    refuse(text, std::string(error.description()), "");
  }
}

Override parse_override(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse(text, "no '=' in the override", "write KEY=VALUE, for example cell=0.2");
  return {text, split_key(text, std::string_view(text).substr(0, equals)),
          parse_value(text, std::string_view(text).substr(equals + 1))};
}

std::string join(const std::vector<std::string>& parts, std::size_t n) {
  std::string joined;
  for (std::size_t i = 0; i < n; ++i) joined += (i ? "." : "") + parts[i];
  return joined;
}

std::vector<std::string> keys_of(const toml::table& table) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : table) keys.emplace_back(key.str());
  return keys;
}

// Element of an array of tables by its name. Names may contain dots ("desk1.top"), so the longest run of path
// parts that makes a name wins; `used` says how many parts it took.
toml::table* element_named(toml::array& array, const Override& set, std::size_t from, std::size_t& used) {
  std::vector<std::string> names;
  for (std::size_t n = set.key.size() - 1; n > from; --n) {
    std::string wanted = set.key[from];
    for (std::size_t i = from + 1; i < n; ++i) wanted += "." + set.key[i];
    for (auto& node : array) {
      auto* table = node.as_table();
      if (!table) continue;
      const auto name = (*table)["name"].value<std::string>();
      if (!name) continue;
      if (*name == wanted) {
        used = n - from;
        return table;
      }
      names.push_back(*name);
    }
  }
  refuse(set.text, fmt::format("no {} named '{}'", set.key[from - 1], set.key[from]),
         did_you_mean(set.key[from], names));
}

toml::table as_finish_table(const toml::node& scalar, const toml::source_region& region) {
  toml::table table;
  if (const auto* entry = scalar.as_string())
    table.insert_or_assign(toml::key("entry", region), *entry);
  else
    table.insert_or_assign(toml::key("diffuse", region), scalar);
  return table;
}

// Keys of the zone file set for the lights file, or the other way round.
void refuse_other_file(const Override& set, const TomlKind& kind) {
  static const std::vector<std::string> kZone = {"finishes", "surface", "box",  "copy", "room", "plane",
                                                 "sensors",  "view",    "site", "cell", "unit"};
  const std::string& first = set.key.front();
  if (kind.kind == "zone" && first == "luminaire")
    refuse(set.text, "luminaires belong to the lights file", "say it to dimray: dimray --set " + set.text);
  if (kind.kind != "lights" || !std::count(kZone.begin(), kZone.end(), first)) return;
  if (first == "finishes" && set.key.size() > 1)
    refuse(set.text, "finishes belong to the zone, which was read when the rays were made",
           fmt::format("use --finish {}=ENTRY, or {}=0.5 for a grey; dimdis --set for anything else",
                       set.key[1], set.key[1]));
  refuse(set.text,
         fmt::format("'{}' belongs to the zone file, which was read when the rays were made", first),
         "say it to dimdis: dimdis --set " + set.text);
}

void apply(toml::table& root, Override set, const TomlKind& kind) {
  refuse_other_file(set, kind);
  toml::node& value = *set.holder.get("v");
  const auto region = value.source();
  toml::table* table = &root;
  std::size_t i = 0;
  while (i + 1 < set.key.size()) {
    const std::string& part = set.key[i];
    const bool in_named =
        i == 1 && std::count(kind.named_tables.begin(), kind.named_tables.end(), set.key[0]);
    toml::node* node = table->get(part);
    if (!node && in_named)
      refuse(set.text, fmt::format("no '{}' in [{}]", part, set.key[0]), did_you_mean(part, keys_of(*table)));
    if (!node) node = &table->insert_or_assign(toml::key(part, region), toml::table{}).first->second;
    if (in_named && !node->is_table() && !node->is_array())
      node = &table->insert_or_assign(part, as_finish_table(*node, region)).first->second;
    ++i;
    if (auto* array = node->as_array()) {
      if (i + 1 >= set.key.size())
        refuse(set.text, fmt::format("'{}' is a list: name the element and its key", part),
               fmt::format("for example {}.NAME.KEY=VALUE", part));
      std::size_t used = 0;
      table = element_named(*array, set, i, used);
      i += used;
    } else if (node->is_table()) {
      table = node->as_table();
    } else {
      refuse(set.text, fmt::format("'{}' is a value, nothing can be set inside it", join(set.key, i)), "");
    }
  }
  const std::string& last = set.key.back();
  const bool in_named =
      set.key.size() == 2 && std::count(kind.named_tables.begin(), kind.named_tables.end(), set.key[0]);
  if (in_named && !table->contains(last))
    refuse(set.text, fmt::format("no '{}' in [{}]", last, set.key[0]), did_you_mean(last, keys_of(*table)));
  table->erase(last);  // so that the key's place is the override's too
  table->insert_or_assign(toml::key(last, region), std::move(value));
}

void check_header(const toml::table& root, const std::string& file, const TomlKind& kind) {
  const std::string wanted = fmt::format("{}/{}", kind.kind, kind.version);
  const toml::node* node = root.get("dim");
  if (!node) {
    if (!kind.header_required) return;
    throw InputError(Problem{{file, 1, 1},
                             "not a DIM file: the key 'dim' is missing",
                             fmt::format("begin the file with dim = \"{}\"", wanted)});
  }
  const Place place = place_of(node->source(), file);
  const auto* header = node->as_string();
  if (!header)
    throw InputError(Problem{place, "dim must be text", fmt::format("write dim = \"{}\"", wanted)});
  const std::string& text = header->get();
  const auto slash = text.find('/');
  int version = 0;
  const char* end = text.data() + text.size();
  const bool numbered = slash != std::string::npos &&
                        std::from_chars(text.data() + slash + 1, end, version).ptr == end && version > 0;
  if (!numbered || text.substr(0, slash) != kind.kind)
    throw InputError(Problem{place, fmt::format("'{}' is not a {} file", text, kind.kind),
                             fmt::format("a {} file begins with dim = \"{}\"", kind.kind, wanted)});
  if (version > kind.version)
    throw InputError(Problem{place,
                             fmt::format("'{}' is newer than this program reads (up to {})", text, wanted),
                             "use a newer version of DIM"});
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file, const TomlKind& kind,
                       const std::vector<std::string>& overrides) {
  if (text.size() > kMaxTomlBytes)
    throw InputError(Problem{
        {file, 0, 0},
        fmt::format("text of {} bytes is longer than the {} MiB accepted", text.size(), kMaxTomlBytes >> 20),
        ""});
  refuse_binary(text, file, kind);
  refuse_deep_keys(text, file);
  toml::table root;
  try {
    root = toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& error) {
    const std::string words(error.description());
    const bool encoding = words.find("utf-8") != std::string::npos;
    const Place place = place_of(error.source(), file);
    throw InputError(Problem{place, encoding ? "a byte that is not UTF-8 text (" + words + ")" : words,
                             encoding ? "save the file as UTF-8 text" : syntax_cure(text, place.line)});
  }
  check_header(root, file, kind);
  for (const auto& one : overrides) apply(root, parse_override(one), kind);
  return root;
}

}  // namespace dim
