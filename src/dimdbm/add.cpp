#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/input_file.hpp"
#include "common/counted.hpp"
#include "common/database_option.hpp"
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

// The database to change may be still to be made.
std::string managed_if_there(const std::string& option) {
  std::error_code error;
  return fs::is_directory(option, error) ? option : "";
}

void refuse_built_in(const std::string& name) {
  const auto known = spectrum_names();
  if (std::find(known.begin(), known.end(), name) != known.end())
    throw InputError({{}, "'" + name + "' is a spectrum that DIM knows by itself", "give another --name"});
}

const std::vector<std::string> kValueUnits = {"found", "fraction", "percent"};
const std::vector<std::string> kWavelengthUnits = {"found", "nm", "um"};

template <class Unit>
Unit unit_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Unit>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

AddCommand::AddCommand(Program& program) : program_(program) {
  add_ = program.add_command("add", "Adds a photometric file, a spectrum of a surface or a lamp, or an entry",
                             "  dimdbm add lamp.ldt --spectrum led-4000 --watts 33\n"
                             "  dimdbm add paint.csv --name paint-blue --source \"spectrophotometer, 2024\"\n"
                             "  dimdbm add led.csv --kind lamp --name led-own");
  auto& app = *add_;
  app.add_option("FILE", file_,
                 "Photometric file (.ies, .ldt, .xml), spectrum (.csv, .txt, .spd, .spdx) or entry (.toml)")
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
  app.add_option("--kind", kind_,
                 "What a spectrum is of: opaque, glazing (columns: transmittance, reflectance) or lamp "
                 "(relative power)")
      ->check(CLI::IsMember({"opaque", "glazing", "lamp"}))
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
  refuse_idle_options(extension);
  if (kind_ == "lamp" || extension == ".spd" || extension == ".spdx")
    add_lamp_spectrum();
  else if (is_photometric_name(file_))
    add_photometry();
  else if (extension == ".csv" || extension == ".txt")
    add_spectrum();
  else if (extension == ".toml")
    add_entry();
  else if (const auto foreign = foreign_format(file_); !foreign.what.empty())
    throw InputError({{file_, 0, 0}, "is " + foreign.what, foreign.cure});
  else
    throw UsageError("'" + file_ +
                     "': the name must end in .ies, .ldt, .xml, .csv, .txt, .spd, .spdx or .toml");
  return true;
}

void AddCommand::refuse_idle_options(const std::string& extension) const {
  const bool lamp = kind_ == "lamp" || extension == ".spd" || extension == ".spdx";
  if (extension == ".toml")
    refuse_without_effect(
        *add_,
        {"--title", "--source", "--licence", "--spectrum", "--watts", "--lumens", "--lamp-factor",
         "--maintenance-factor", "--kind", "--column", "--wavelengths", "--values"},
        "with an entry, which is added as it is");
  else if (is_photometric_name(file_) && !lamp)
    refuse_without_effect(*add_, {"--kind", "--column", "--wavelengths", "--values"},
                          "with a photometric file");
  else
    refuse_without_effect(*add_,
                          {"--spectrum", "--watts", "--lumens", "--lamp-factor", "--maintenance-factor"},
                          "with a spectrum: it belongs to fittings");
  if (lamp)
    refuse_without_effect(*add_, {"--wavelengths", "--values"},
                          "with a lamp's spectrum, whose values are relative");
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
  const DatabaseSearch search = database_search(managed_if_there(db_), "-");
  if (!spectrum_.empty()) spectrum_finder(search)(spectrum_);
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
  read_fitting_entry(text, name + ".toml", name, {});
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
                      fmt::format("{} of values where {} needed", counted(table.curves.size(), "column"),
                                  n_wanted == 1 ? "1 is" : fmt::format("{} are", n_wanted)),
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

void AddCommand::add_lamp_spectrum() {
  SpectrumEntry entry =
      read_lamp_spectrum(read_text_file(file_, kMaxTomlBytes), file_, static_cast<std::size_t>(column_ - 1));
  entry.name = new_name();
  refuse_built_in(entry.name);
  const std::string from = "from " + fs::path(file_).filename().string();
  if (!title_.empty()) entry.title = title_;
  if (entry.title.empty()) entry.title = entry.name;
  entry.source = !source_.empty() ? source_ : entry.source.empty() ? from : entry.source + "; " + from;
  entry.licence = licence_.empty() ? "not stated by the file" : licence_;
  const std::string text = spectrum_entry_text(entry);
  read_spectrum_entry(text, entry.name + ".toml", entry.name);
  store(kSpectra, entry.name, {{entry.name + ".toml", text}});
}

void AddCommand::add_entry() {
  const std::string text = read_text_file(file_, kMaxTomlBytes);
  const std::string name = new_name();
  const std::string kind = kind_of_text(text, file_);
  if (kind == kSpectra) {
    refuse_built_in(name);
    read_spectrum_entry(text, file_, name);
    return store(kind, name, {{name + ".toml", text}});
  }
  if (kind == kSurfaces) {
    read_surface_entry(text, file_, name);
    return store(kind, name, {{name + ".toml", text}});
  }
  Warnings warnings;
  const DatabaseSearch search = database_search(managed_if_there(db_), "-");
  const FittingRecord record = read_fitting_record(file_, name, warnings, spectrum_finder(search));
  program_.warn(warnings);
  FittingEntry entry = record.entry;
  // The file's own spectrum stays in the file.
  if (record.photometry.spectrum && entry.spectrum &&
      entry.spectrum->points() == record.photometry.spectrum->points())
    entry.spectrum.reset();
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
