#include "import/obj.hpp"

#include <fmt/format.h>

#include <charconv>

#include "import/material_library.hpp"
#include "import/token_line.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

using Words = std::vector<std::string_view>;

class ObjReader {
 public:
  explicit ObjReader(const ImportInput& input) : input_(input), materials_(model_), counter_(input) {
    model_.format = "OBJ";
  }

  ImportedModel run() {
    LineReader lines(input_.bytes);
    for (std::string_view line; lines.next(line);) {
      place_ = input_.place(lines.line_number());
      if (joined_.empty() && (line.empty() || line.back() != '\\')) {
        statement(line);
        continue;
      }
      const bool goes_on = !line.empty() && line.back() == '\\';
      joined_ += line.substr(0, line.size() - (goes_on ? 1 : 0));
      joined_ += ' ';
      if (goes_on) continue;
      statement(joined_);
      joined_.clear();
    }
    if (!joined_.empty()) statement(joined_);
    if (points_.empty()) problems_.add(input_.place(0), "no vertex in it: not an OBJ file, or an empty one");
    problems_.throw_if_any();
    unknowns_.tell(model_.warnings);
    return std::move(model_);
  }

 private:
  void statement(std::string_view line) {
    line = trimmed(line.substr(0, line.find('#')));
    const Words words = words_of(line);
    if (words.empty()) return;
    const std::string_view rest = trimmed(line.substr(words[0].size()));
    if (words[0] == "v")
      vertex(words);
    else if (words[0] == "f" || words[0] == "fo")
      face(words);
    else if (words[0] == "g" || words[0] == "o")
      name_ = std::string(rest);
    else if (words[0] == "usemtl")
      material_ = materials_(std::string(rest));
    else if (words[0] == "mtllib")
      library(std::string(rest), words);
    else if (words[0] == "vt" || words[0] == "vn" || words[0] == "s" || words[0] == "usemap" ||
             words[0] == "maplib")
      return;
    else
      unknowns_.add(fmt::format("statement {} is not understood and left out", dim::quoted(words[0])),
                    place_);
  }

  void vertex(const Words& words) {
    Vec3 p(0.0);
    for (int i = 0; i < 3; ++i)
      if (words.size() < 4 || !parse_number(words[static_cast<std::size_t>(i) + 1], p[i])) {
        problems_.add(place_, "v needs three finite numbers");
        break;
      }
    points_.push_back(p);
  }

  void face(const Words& words) {
    if (words.size() < 4) {
      unknowns_.add("face of fewer than three corners left out", place_);
      return;
    }
    counter_.add(words.size() - 1);
    ImportedFace face;
    face.outline.reserve(words.size() - 1);
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto corner = corner_of(words[i]);
      if (!corner) return;
      face.outline.push_back(points_[*corner]);
    }
    face.material = material_ >= 0 ? material_ : materials_("");
    face.name = name_;
    model_.faces.push_back(std::move(face));
  }

  /// `7`, `7/1`, `7//3`, `7/1/3`; below 0: counted back from the latest vertex.
  std::optional<std::size_t> corner_of(std::string_view word) {
    const std::string_view digits = word.substr(0, word.find('/'));
    long long index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    const auto n = static_cast<long long>(points_.size());
    const bool is_number = error == std::errc() && end == digits.data() + digits.size();
    if (is_number && index >= 1 && index <= n) return static_cast<std::size_t>(index - 1);
    if (is_number && index < 0 && index >= -n) return static_cast<std::size_t>(n + index);
    problems_.add(place_,
                  fmt::format("corner {} of a face is none of the {} vertices so far", dim::quoted(word), n));
    return std::nullopt;
  }

  void library(const std::string& rest, const Words& words) {
    // Several libraries may stand behind each other, and names may hold blanks.
    if (read_library(rest)) return;
    for (std::size_t i = 1; words.size() > 2 && i < words.size(); ++i)
      if (read_library(std::string(words[i]))) return;
    unknowns_.add(fmt::format("material library {} is not there", dim::quoted(rest)), place_,
                  "put it beside the model: without it reflectances are assumed");
  }

  bool read_library(const std::string& name) {
    const auto text = input_.beside(name);
    if (text) read_material_library(*text, name, model_);
    return text.has_value();
  }

  const ImportInput& input_;
  ImportedModel model_;
  MaterialIndex materials_;
  FaceCounter counter_;
  Problems problems_;
  Unknowns unknowns_;
  Place place_;
  std::vector<Vec3> points_;
  std::string name_, joined_;
  int material_ = -1;
};

}  // namespace

ImportedModel read_obj(const ImportInput& input) { return ObjReader(input).run(); }

}  // namespace dim
