#include "photometry/photometry_file.hpp"

#include <filesystem>

#include "base/input_file.hpp"
#include "photometry/eulumdat.hpp"
#include "photometry/text_scanner.hpp"
#include "photometry/tm33.hpp"

namespace dim {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const std::string& name) { return in_capitals(fs::path(name).extension().string()); }

bool has_tilt_line(std::string_view bytes) {
  TextScanner scanner(bytes, "");
  while (!scanner.at_end()) {
    const std::string_view line = trimmed(scanner.take_line());
    if (in_capitals(line.substr(0, 4)) == "TILT" && trimmed(line.substr(4)).substr(0, 1) == "=") return true;
  }
  return false;
}

// A damaged LM-63 file may have lost its TILT line: its name and its first line then speak for it.
bool is_lm63(std::string_view bytes, const std::string& file_name) {
  if (has_tilt_line(bytes)) return true;
  if (extension_of(file_name) == ".IES") return true;
  const std::string_view text = bytes.substr(0, 3) == "\xEF\xBB\xBF" ? bytes.substr(3) : bytes;
  return extension_of(file_name) != ".LDT" && in_capitals(text.substr(0, 3)) == "IES";
}

}  // namespace

bool is_photometric_name(const std::string& name) {
  const std::string extension = extension_of(name);
  return extension == ".IES" || extension == ".LDT" || extension == ".XML";
}

ForeignFormat foreign_format(const std::string& name) {
  const std::string extension = extension_of(name);
  if (extension == ".GLDF")
    return {"a GLDF container (zip)", "take the .ldt, .ies or TM-33 .xml out of its folder ldc: unzip " +
                                          fs::path(name).filename().string()};
  if (extension == ".ULD" || extension == ".ULDZ")
    return {"a DIALux luminaire, whose format is not public", "get the .ldt or .ies of the same luminaire"};
  if (extension == ".ROLF" || extension == ".ROLFZ")
    return {"a Relux luminaire (zip)", "get the .ldt or .ies of the same luminaire"};
  if (extension == ".RFA") return {"a Revit family", "get the .ies that it was made with"};
  return {};
}

Photometry read_photometry(std::string_view bytes, const std::string& file_name, Warnings& warnings,
                           const TiltResolver& resolver) {
  if (is_xml(bytes)) return read_tm33(bytes, file_name, warnings);
  if (is_lm63(bytes, file_name)) return read_ies(bytes, file_name, warnings, resolver);
  return read_eulumdat(bytes, file_name, warnings);
}

Photometry read_photometric_file(const std::string& path, Warnings& warnings) {
  const fs::path folder = fs::path(path).parent_path();
  const auto beside = [&](const std::string& name) {
    return read_text_file((folder / name).string(), kMaxPhotometryBytes);
  };
  return read_photometry(read_text_file(path, kMaxPhotometryBytes), name_for_messages(path), warnings,
                         beside);
}

}  // namespace dim
