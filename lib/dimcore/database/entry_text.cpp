#include "database/entry_text.hpp"

#include <fmt/format.h>

namespace dim {
namespace {

void append_text(std::string& text, const char* key, const std::string& value) {
  if (!value.empty()) text += fmt::format("{} = {}\n", key, toml_quoted(value));
}

void append_factor(std::string& text, const char* key, double value) {
  if (value != 1.0) text += fmt::format("{} = {}\n", key, value);
}

}  // namespace

std::string toml_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += fmt::format("\\{}", c);
    else if (byte < 0x20 || byte == 0x7F)
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(byte));
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string toml_curve(const SpectralCurve& curve) {
  if (curve.is_flat()) return fmt::format("{:.9g}", curve.points().front().second);
  std::string text = "[";
  std::size_t in_row = 0;
  for (const auto& [nm, value] : curve.points()) {
    text += in_row++ % 6 == 0 ? "\n  " : " ";
    text += fmt::format("[{:.9g}, {:.9g}],", nm, value);
  }
  return text + "\n]";
}

std::string fitting_entry_text(const FittingEntry& entry) {
  std::string text = "dim = \"fitting/1\"\n";
  append_text(text, "title", entry.title);
  append_text(text, "file", entry.file);
  if (entry.watts) text += fmt::format("watts = {}\n", *entry.watts);
  if (entry.lumens) text += fmt::format("lumens = {}\n", *entry.lumens);
  append_factor(text, "lamp_factor", entry.lamp_factor);
  append_factor(text, "maintenance_factor", entry.maintenance_factor);
  if (!entry.spectrum_name.empty())
    append_text(text, "spectrum", entry.spectrum_name);
  else if (entry.spectrum)
    text += "spectrum = " + toml_curve(*entry.spectrum) + "\n";
  append_text(text, "source", entry.source);
  append_text(text, "licence", entry.licence);
  return text;
}

std::string surface_entry_text(const SurfaceDraft& draft) {
  std::string text = "dim = \"surface/1\"\n";
  append_text(text, "title", draft.title);
  text += draft.glazing ? "kind = \"glazing\"\n" : "kind = \"opaque\"\n";
  if (draft.glazing) {
    text += "transmittance = " + toml_curve(draft.transmittance) + "\n";
    text += "reflectance = " + toml_curve(draft.reflectance) + "\n";
  } else {
    text += "diffuse = " + toml_curve(draft.diffuse) + "\n";
  }
  append_text(text, "source", draft.source);
  append_text(text, "licence", draft.licence);
  append_text(text, "note", draft.note);
  return text;
}

}  // namespace dim
