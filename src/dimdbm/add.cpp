#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/input_file.hpp"
#include "common/option_checks.hpp"
#include "database/entry_name.hpp"
#include "database/spectrum_csv.hpp"
#include "database/surface_entry.hpp"
#include "database/toml_reader.hpp"
#include "dimdbm/commands.hpp"
#include "photometry/photometry_file.hpp"
#include "photometry/photometry_writer.hpp"
#include "spectrum/named_spectra.hpp"

namespace dim {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return extension;
}

/// "MAKER, catalogue number, test report; from FILE"
std::string source_of(const Photometry& photometry, const std::string& file) {
  std::string source;
  for (const char* keyword : {"MANUFAC", "LUMCAT", "TEST"})
    if (const std::string value = photometry.keyword(keyword); !value.empty())
      source += (source.empty() ? "" : ", ") + value;
  return fmt::format("{}{}{}", source, source.empty() ? "" : "; ",
                     "from " + fs::path(file).filename().string());
}

const std::vector<std::string> kValueUnits = {"found", "fraction", "percent"};
const std::vector<std::string> kWavelengthUnits = {"found", "nm", "um"};

template <class Unit>
Unit unit_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Unit>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

AddCommand::AddCommand(Program& program) : program_(program) {
  add_ = program.add_command("add", "Adds a photometric file, a measured spectrum or an entry",
                             "  dimdbm add lamp.ldt --spectrum led-4000 --watts 33\n"
                             "  dimdbm add paint.csv --name paint-blue --source \"spectrophotometer, 2024\"");
  auto& app = *add_;
  app.add_option("FILE", file_, "Photometric file (.ies, .ldt), spectrum (.csv) or entry (.toml)")
      ->required()
      ->type_name("");
  app.add_option("--name", name_, "Name of the entry; from the file's name unless said")->type_name("NAME");
  app.add_flag("--force", force_, "Replace an entry of the same name");
  add_manage_option(app, db_);
  app.add_option("--title", title_, "What it is, in words")->type_name("TEXT")->group("Entry");
  app.add_option("--source", source_, "Where the figures come from")->type_name("TEXT")->group("Entry");
  app.add_option("--licence", licence_, "Under what terms they may be used")
      ->type_name("TEXT")
      ->group("Entry");
  app.add_option("--spectrum", spectrum_, "Spectrum by name, for example led-4000")
      ->type_name("NAME")
      ->group("Fitting");
  app.add_option("--watts", watts_, "Power, W, in place of the file's")
      ->check(number_within(0.0, HUGE_VAL, true))
      ->type_name("W")
      ->group("Fitting");
  app.add_option("--lumens", lumens_, "Luminaire flux to scale the intensities to, lm")
      ->check(number_within(0.0, HUGE_VAL, true))
      ->type_name("LM")
      ->group("Fitting");
  app.add_option("--lamp-factor", lamp_factor_, "Flux of the lamps used over that of the lamps measured")
      ->check(number_within(0.0, 1e6, true))
      ->type_name("F")
      ->group("Fitting");
  app.add_option("--maintenance-factor", maintenance_factor_, "Flux in use over flux when new")
      ->check(number_within(0.0, 1.0, true))
      ->type_name("F")
      ->group("Fitting");
  app.add_option("--kind", kind_, "What a spectrum is of; a glazing's columns are transmittance, reflectance")
      ->check(CLI::IsMember({"opaque", "glazing"}))
      ->group("Spectrum");
  app.add_option("--column", column_, "Which column of values, counted from 1")
      ->check(CLI::Range(1, 99))
      ->group("Spectrum");
  app.add_option("--wavelengths", wavelengths_, "Unit of wavelength: nm, um, or found")
      ->check(CLI::IsMember(kWavelengthUnits))
      ->group("Spectrum");
  app.add_option("--values", values_, "Unit of the values: fraction, percent, or found")
      ->check(CLI::IsMember(kValueUnits))
      ->group("Spectrum");
  program.add_common_options(app);
}

bool AddCommand::run() {
  if (!add_->parsed()) return false;
  const std::string extension = extension_of(file_);
  if (is_photometric_name(file_))
    add_photometry();
  else if (extension == ".csv" || extension == ".txt")
    add_spectrum();
  else if (extension == ".toml")
    add_entry();
  else
    throw UsageError("'" + file_ + "': the name must end in .ies, .ldt, .csv or .toml");
  return true;
}

std::string AddCommand::new_name() const {
  if (!name_.empty()) {
    if (is_entry_name(name_)) return name_;
    throw UsageError(
        fmt::format("--name '{}' is not a safe file name: letters, digits, '-', '_', '+' and '.'", name_));
  }
  const std::string name = entry_name_from(fs::path(file_).stem().string());
  if (name.empty()) throw UsageError("'" + file_ + "' makes no name for the entry; give --name NAME");
  return name;
}

void AddCommand::store(const std::string& kind, const std::string& name, std::vector<StoredFile> files) {
  EntryStore store((fs::path(managed_database(db_)) / kind).string());
  program_.stage(kWritingStage);
  // An entry replaced by one with a file of another name would leave its own file behind.
  std::vector<std::string> left =
      force_ && kind == kFittings ? own_files(store.folder(), name) : std::vector<std::string>{};
  if (const auto taken = store.add(files, force_))
    throw InputError({{(fs::path(store.folder()) / *taken).string(), 0, 0},
                      "exists already: nothing was added",
                      "give another --name, or --force to replace it"});
  for (const auto& file : files) std::erase(left, file.name);
  store.remove(left);
  program_.say(fmt::format("added {}/{}", store.folder(), name));
}

void AddCommand::add_photometry() {
  Warnings warnings;
  const Photometry photometry = read_photometric_file(file_, warnings);
  program_.warn(warnings);
  if (!spectrum_.empty()) find_spectrum(spectrum_);
  const std::string name = new_name();
  std::string bytes = read_text_file(file_, kMaxPhotometryBytes);
  std::string stored = name + extension_of(file_);
  // Lamp tilt in a file beside it would be left behind.
  if (photometry.tilt && in_capitals(bytes).find("TILT=INCLUDE") == std::string::npos)
    bytes = ies_text(photometry);
  FittingEntry entry;
  entry.title = title_.empty() ? photometry.keyword("LUMINAIRE") : title_;
  entry.file = stored;
  entry.watts = watts_ ? watts_ : photometry.watts;
  if (entry.watts && !(*entry.watts > 0.0)) entry.watts.reset();
  entry.lumens = lumens_;
  entry.lamp_factor = lamp_factor_.value_or(1.0);
  entry.maintenance_factor = maintenance_factor_.value_or(1.0);
  entry.spectrum_name = spectrum_;
  entry.source = source_.empty() ? source_of(photometry, file_) : source_;
  entry.licence = licence_.empty() ? "not stated by the file" : licence_;
  const std::string text = fitting_entry_text(entry);
  read_fitting_entry(text, name + ".toml", name);
  store(kFittings, name, {{stored, std::move(bytes)}, {name + ".toml", text}});
}

void AddCommand::add_spectrum() {
  const SpectrumTable table = read_spectrum_csv(read_text_file(file_, kMaxTomlBytes), file_,
                                                unit_of<WavelengthUnit>(kWavelengthUnits, wavelengths_),
                                                unit_of<ValueUnit>(kValueUnits, values_));
  const auto column = static_cast<std::size_t>(column_ - 1);
  SurfaceDraft draft;
  draft.glazing = kind_ == "glazing";
  const std::size_t n_wanted = column + (draft.glazing ? 2 : 1);
  if (table.curves.size() < n_wanted)
    throw InputError({{file_, 0, 0},
                      fmt::format("{} columns of values where {} are needed", table.curves.size(), n_wanted),
                      draft.glazing ? "a glazing has transmittance, then reflectance" : "see --column"});
  draft.diffuse = draft.transmittance = table.curves[column];
  if (draft.glazing) draft.reflectance = table.curves[column + 1];
  const std::string name = new_name();
  draft.title = title_.empty() ? name : title_;
  draft.source = source_.empty() ? "from " + fs::path(file_).filename().string() : source_;
  draft.licence = licence_.empty() ? "not stated by the file" : licence_;
  draft.note = fmt::format("measured values read as {} over {}", table.percent ? "per cent" : "fractions",
                           table.micrometres ? "micrometres" : "nanometres");
  const std::string text = surface_entry_text(draft);
  read_surface_entry(text, name + ".toml", name);
  store(kSurfaces, name, {{name + ".toml", text}});
}

void AddCommand::add_entry() {
  const std::string text = read_text_file(file_, kMaxTomlBytes);
  const std::string name = new_name();
  if (!is_fitting_text(text, file_)) {
    read_surface_entry(text, file_, name);
    return store(kSurfaces, name, {{name + ".toml", text}});
  }
  Warnings warnings;
  const FittingRecord record = read_fitting_record(file_, name, warnings);
  program_.warn(warnings);
  FittingEntry entry = record.entry;
  const std::string stored = name + extension_of(entry.file);
  std::vector<StoredFile> files = {{stored, read_text_file(entry.file, kMaxPhotometryBytes)}};
  // The entry's own words are kept where its file keeps its name.
  const bool renamed = toml::table(parse_toml(text, file_, {"fitting", 1, false, {}}))["file"].value_or(
                           std::string()) != stored;
  entry.file = stored;
  files.push_back({name + ".toml", renamed ? fitting_entry_text(entry) : text});
  store(kFittings, name, std::move(files));
}

}  // namespace dim
