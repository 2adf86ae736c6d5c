#include "database/bsdf_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

#include "photometry/xml_document.hpp"

namespace dim {
namespace {

constexpr std::size_t kValues = klems::kPatches * klems::kPatches;
constexpr char kFullBasis[] = "LBNL/Klems Full";

[[noreturn]] void refuse(const XmlDocument& xml, pugi::xml_node node, const std::string& what,
                         const std::string& cure) {
  throw InputError({xml.place(node), what, cure});
}

// The <WavelengthDataBlock> of visible light that comes from the front.
pugi::xml_node front_block(const XmlDocument& xml) {
  const auto optical = child_of(xml.root(), {"Optical"});
  const auto layer = child_of(optical, {"Layer"});
  for (const auto& data : children_of(layer, {"WavelengthData"})) {
    if (text_of(data, {"Wavelength"}) != "Visible") continue;
    for (const auto& block : children_of(data, {"WavelengthDataBlock"}))
      if (text_of(block, {"WavelengthDataDirection"}) == "Transmission Front") return block;
  }
  refuse(xml, xml.root(), "no visible 'Transmission Front' among its data",
         "export the system from LBNL WINDOW as BSDF XML with visible data");
}

std::vector<double> numbers_of(const XmlDocument& xml, pugi::xml_node node) {
  std::vector<double> values;
  const std::string_view text = node.text().get();
  const char* at = text.data();
  const char* end = at + text.size();
  while (true) {
    while (at != end && (std::isspace(static_cast<unsigned char>(*at)) || *at == ',')) ++at;
    if (at == end) return values;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !(value >= 0.0) || !std::isfinite(value))
      refuse(xml, node, fmt::format("value {} of the scattering data is no number of at least 0", values.size() + 1),
             "the file is damaged");
    values.push_back(value);
    at = stop;
  }
}

void check_energy(const XmlDocument& xml, pugi::xml_node node, const KlemsMatrix& matrix) {
  constexpr double kRounding = 1e-3;  // values have five or six digits
  for (std::size_t in = 0; in < klems::kPatches; ++in) {
    const double passed = matrix.transmittance(in);
    if (passed > 1.0 + kRounding)
      refuse(xml, node, fmt::format("light from Klems patch {} is passed by {:.4g} of itself, more than whole", in + 1,
                                    passed),
             "is it data by another definition? values are 1/sr");
  }
}

}  // namespace

std::shared_ptr<const KlemsMatrix> read_bsdf(std::string_view text, const std::string& file_name) {
  const XmlDocument xml(text, file_name);
  if (local_name(xml.root()) != "WindowElement")
    refuse(xml, xml.root(), fmt::format("<{}> is no BSDF of LBNL WINDOW", std::string(local_name(xml.root()))),
           "its root is <WindowElement>");
  const auto block = front_block(xml);
  for (const char* basis : {"ColumnAngleBasis", "RowAngleBasis"}) {
    const std::string name = text_of(block, {basis});
    if (name != kFullBasis)
      refuse(xml, block, fmt::format("its {} is '{}'", basis, name),
             fmt::format("only '{}' of 145 patches is read", kFullBasis));
  }
  const auto data = child_of(block, {"ScatteringData"});
  auto values = numbers_of(xml, data);
  if (values.size() != kValues)
    refuse(xml, block, fmt::format("{} scattering data, expected 145 x 145 = {}", values.size(), kValues),
           "the file is damaged or of another basis");
  auto matrix = std::make_shared<const KlemsMatrix>(std::move(values));
  check_energy(xml, data, *matrix);
  return matrix;
}

}  // namespace dim
