#include "import/material_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "import/token_line.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

using Words = std::vector<std::string_view>;

class LibraryReader {
 public:
  LibraryReader(const std::string& name, ImportedModel& model) : name_(name), model_(model) {}

  void run(std::string_view text) {
    LineReader lines(text);
    for (std::string_view line; lines.next(line);) {
      line = trimmed(line.substr(0, line.find('#')));
      const Words words = words_of(line);
      if (words.empty()) continue;
      place_ = {name_, lines.line_number(), 0};
      if (words[0] == "newmtl")
        material_ = material_named(model_, std::string(trimmed(line.substr(words[0].size()))));
      else if (material_ >= 0)
        statement(words);
      else
        problems_.add(place_, fmt::format("{} stands before the first newmtl", dim::quoted(words[0])));
    }
    problems_.throw_if_any();
    unknowns_.tell(model_.warnings);
  }

 private:
  ImportedMaterial& material() { return model_.materials[static_cast<std::size_t>(material_)]; }

  void statement(const Words& words) {
    if (words[0] == "Kd") {
      if (const auto colour = colour_of(words))
        material().diffuse = luminous((*colour)[0], (*colour)[1], (*colour)[2]);
    } else if (words[0] == "d") {
      // "d -halo 0.5" fades towards the silhouette: the number is the last word.
      if (const auto opacity = share(words, words.size() - 1)) transparent(1.0 - *opacity);
    } else if (words[0] == "Tr") {
      if (const auto transparency = share(words, 1)) transparent(*transparency);
    } else if (words[0] == "Ke") {
      const auto colour = colour_of(words);
      if (colour && luminous((*colour)[0], (*colour)[1], (*colour)[2]) > 0.0)
        unknowns_.add(fmt::format("material {}: light of its own (Ke) has no unit and is left out",
                                  dim::quoted(material().name)),
                      place_, "write luminaires in the lights file");
    } else if (words[0].substr(0, 4) == "map_" || words[0] == "bump" || words[0] == "disp" ||
               words[0] == "decal" || words[0] == "refl") {
      unknowns_.add(
          fmt::format("pictures on materials ({}) are not read: the material's Kd is taken", words[0]),
          place_);
    } else if (words[0] == "Ks" || words[0] == "Ns" || words[0] == "Ka" || words[0] == "Ni" ||
               words[0] == "illum" || words[0] == "Tf" || words[0] == "sharpness") {
      // Phong's figures for a picture, no measures of what is reflected.
    } else {
      unknowns_.add(fmt::format("statement {} of a material is not understood", dim::quoted(words[0])),
                    place_);
    }
  }

  void transparent(double transmittance) {
    if (transmittance > 0.0) material().transmittance = transmittance;
  }

  std::optional<double> share(const Words& words, std::size_t i) {
    double value = 0.0;
    if (i > 0 && i < words.size() && parse_number(words[i], value) && value >= 0.0 && value <= 1.0)
      return value;
    problems_.add(place_, fmt::format("{} needs a number within 0..1", words[0]));
    return std::nullopt;
  }

  std::optional<std::array<double, 3>> colour_of(const Words& words) {
    if (words.size() > 1 && (words[1] == "spectral" || words[1] == "xyz")) {
      unknowns_.add(fmt::format("{} {} is not read", words[0], words[1]), place_);
      return std::nullopt;
    }
    std::array<double, 3> rgb{};
    // One number stands for all three.
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = words.size() == 2 ? 1 : i + 1;
      if (k >= words.size() || !parse_number(words[k], rgb[i]) || rgb[i] < 0.0) {
        problems_.add(place_, fmt::format("{} needs three numbers of at least 0", words[0]));
        return std::nullopt;
      }
    }
    return rgb;
  }

  const std::string& name_;
  ImportedModel& model_;
  int material_ = -1;
  Place place_;
  Problems problems_;
  Unknowns unknowns_;
};

}  // namespace

void read_material_library(std::string_view library, const std::string& name, ImportedModel& model) {
  LibraryReader(name, model).run(library);
}

}  // namespace dim
