#include "scene/finish_reader.hpp"

#include <fmt/format.h>

#include "database/surface_entry.hpp"
#include "database/toml_reader.hpp"

namespace dim {
namespace {

// A finish from the database, with trouble inside the entry's own file passed on as it is.
std::optional<Finish> from_entry(const TomlTable& finishes, std::string_view key, const Place& place,
                                 const std::string& entry, const DatabaseSearch& search) {
  Problems& problems = finishes.context().problems;
  if (!search.find_surface(entry)) {
    problems.add(place,
                 fmt::format("finish '{}': no surface '{}' in {}", key, entry, search.places("surfaces")),
                 did_you_mean(entry, search.names("surfaces")));
    return std::nullopt;
  }
  try {
    return find_surface_entry(search, entry);
  } catch (const InputError& error) {
    for (const auto& problem : error.problems()) problems.add(problem.place, problem.what, problem.cure);
    return std::nullopt;
  }
}

std::optional<Finish> read_inline(const TomlTable& finishes, std::string_view key,
                                  const DatabaseSearch& search) {
  const auto table = finishes.table(key, fmt::format("finish '{}'", key));
  if (!table) return std::nullopt;
  Finish finish;
  finish.source = "inline";
  const auto entry = table->text("entry");
  if (entry) {
    auto base = from_entry(finishes, key, table->place("entry"), *entry, search);
    if (!base) return std::nullopt;
    finish = std::move(*base);
  }
  read_finish_keys(*table, finish);
  for (const char* note : {"source", "title"}) table->text(note);
  if (!entry) require_main_key(*table, finish);
  table->refuse_unknown();
  return finish;
}

std::optional<Finish> read_grey(const TomlTable& finishes, std::string_view key) {
  const auto diffuse = finishes.number(key, kReflectance);
  if (!diffuse) return std::nullopt;
  Finish finish;
  finish.diffuse = SpectralCurve(*diffuse);
  finish.source = "inline";
  return finish;
}

}  // namespace

std::vector<Finish> read_finishes(const TomlTable& root, const DatabaseSearch& search) {
  std::vector<Finish> result;
  const auto finishes = root.table("finishes", "finishes");
  if (!finishes) return result;
  for (const auto& [key, value] : finishes->raw()) {
    const std::string_view name = key.str();
    std::optional<Finish> finish;
    const auto* entry = value.as_string();
    if (entry && !percentage(entry->get()))
      finish = from_entry(*finishes, name, finishes->place(name), entry->get(), search);
    else if (value.is_number() || entry)
      finish = read_grey(*finishes, name);
    else
      finish = read_inline(*finishes, name, search);
    // A finish with a problem is still known by name: its surfaces are not reported as well.
    if (!finish) finish.emplace();
    finish->name = std::string(name);
    result.push_back(std::move(*finish));
  }
  return result;
}

}  // namespace dim
