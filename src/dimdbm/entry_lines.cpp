#include "dimdbm/entry_lines.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <map>

#include "base/input_file.hpp"
#include "database/finish_figures.hpp"
#include "database/surface_entry.hpp"
#include "database/toml_reader.hpp"
#include "spectrum/colour.hpp"
#include "spectrum/named_spectra.hpp"
#include "spectrum/white.hpp"

namespace dim {
namespace {

constexpr double kFluxSlack = 0.02;
const char* const kNoSource = "no source is named";

EntryLine fitting_line(const EntryName& entry, bool checked) {
  Warnings warnings;
  // Many entries name the same few spectra: they are looked up afterwards, each once.
  const FittingRecord record = read_fitting_record(entry.path, entry.name, warnings, {});
  EntryLine line;
  line.kind = "fitting";
  line.spectrum_name = record.entry.spectrum_name;
  line.flux_lm = record.photometry.flux_lm;
  line.max_cd = record.photometry.max_cd;
  line.watts = record.watts().value_or(NAN);
  line.colour = spectrum_words(record.entry);
  if (record.entry.spectrum) line.cct_K = cct_of(*record.entry.spectrum);
  line.source = record.entry.source;
  if (!checked) return line;
  if (record.entry.source.empty()) line.problem = kNoSource;
  if (!warnings.empty()) line.problem = warnings.front().what;
  if (const auto declared = record.photometry.declared_flux_lm;
      declared && std::abs(record.file_flux_lm / *declared - 1.0) > kFluxSlack)
    line.problem = fmt::format("flux {:.6g} lm, declared {:.6g} lm", record.file_flux_lm, *declared);
  return line;
}

EntryLine surface_line(const EntryName& entry, const SpectralCurve& d65, bool checked) {
  const std::string text = read_text_file(entry.path, kMaxTomlBytes);
  const Finish finish = read_surface_entry(text, entry.path, entry.name);
  EntryLine line;
  const bool glazing = finish.kind == FinishKind::glazing;
  line.kind = glazing ? "glazing" : "opaque";
  const Vec3 xyz = finish_xyz(finish, d65);
  line.share = xyz.y;
  const Vec2 xy = xy_of(xyz);
  line.colour = std::isnan(xy.x) ? "" : fmt::format("x {:.3f} y {:.3f}", xy.x, xy.y);
  const toml::table root = parse_toml(text, entry.path, {"surface", 1, false, {}});
  line.source = root["source"].value_or(std::string());
  if (!checked) return line;
  if (line.source.empty()) line.problem = kNoSource;
  for (double nm = 380; nm <= 780; nm += 5)
    if (const double all = reflectance_at(finish, nm) + (glazing ? finish.transmittance.at(nm) : 0.0);
        all > 1.0 + 1e-9) {
      line.problem = fmt::format("returns {:.4f} of the light at {} nm", all, nm);
      break;
    }
  return line;
}

EntryLine spectrum_line(const EntryName& entry, bool checked) {
  const auto spectrum = entry.path.empty() ? built_in_spectrum(entry.name)
                                           : read_spectrum_entry(read_text_file(entry.path, kMaxTomlBytes),
                                                                 entry.path, entry.name);
  EntryLine line;
  line.kind = "spectrum";
  const Vec3 xyz = white_xyz(spectrum.power);
  line.cct_K = white_point(xyz).cct_K;
  const Vec2 xy = xy_of(xyz);
  line.colour = fmt::format("x {:.3f} y {:.3f}", xy.x, xy.y);
  line.source = entry.path.empty() ? "known to DIM" : spectrum.source;
  if (checked && line.source.empty()) line.problem = kNoSource;
  return line;
}

/// Colour temperatures of the spectra that entries name; an unknown name is their problem.
void look_up_spectra(std::vector<EntryLine>& lines, const SpectrumFinder& spectra) {
  std::map<std::string, std::pair<double, std::string>> known;
  for (auto& line : lines) {
    if (line.spectrum_name.empty()) continue;
    const auto [it, added] = known.try_emplace(line.spectrum_name, NAN, "");
    if (added) {
      try {
        it->second.first = cct_of(spectra(line.spectrum_name));
      } catch (const InputError& error) {
        it->second.second = error.problems().front().what;
      }
    }
    line.cct_K = it->second.first;
    if (line.problem.empty()) line.problem = it->second.second;
  }
}

}  // namespace

std::vector<EntryName> entries_of(const DatabaseSearch& search, const std::string& kind_wanted,
                                  bool built_in) {
  std::vector<EntryName> entries;
  for (const char* kind : kKinds) {
    if (kind_wanted != "all" && kind_wanted != kind) continue;
    for (auto& name : search.names(kind)) {
      auto path = search.find(kind, name);
      entries.push_back({kind, name, path.value_or("")});
    }
  }
  if (built_in && (kind_wanted == "all" || kind_wanted == kSpectra))
    for (auto& name : spectrum_names()) entries.push_back({kSpectra, std::move(name), ""});
  return entries;
}

std::string spectrum_words(const FittingEntry& entry) {
  if (!entry.spectrum_name.empty()) return entry.spectrum_name;
  return entry.spectrum ? "table" : "equal energy";
}

double cct_of(const SpectralCurve& spectrum) { return white_point(white_xyz(spectrum)).cct_K; }

std::vector<EntryLine> read_lines(const std::vector<EntryName>& entries, const DatabaseSearch& search,
                                  bool checked) {
  const SpectralCurve d65 = find_spectrum("d65");
  std::vector<EntryLine> lines(entries.size());
  tbb::parallel_for(std::size_t{0}, entries.size(), [&](std::size_t i) {
    const auto& entry = entries[i];
    try {
      lines[i] = entry.kind == kFittings  ? fitting_line(entry, checked)
                 : entry.kind == kSpectra ? spectrum_line(entry, checked)
                                          : surface_line(entry, d65, checked);
    } catch (const InputError& error) {
      lines[i].problem = to_string(error.problems().front());
    } catch (const IoError& error) {
      lines[i].problem = error.what();
    }
    if (lines[i].kind.empty())
      lines[i].kind = entry.kind == kFittings ? "fitting" : entry.kind == kSpectra ? "spectrum" : "surface";
  });
  look_up_spectra(lines, spectrum_finder(search));
  return lines;
}

}  // namespace dim
