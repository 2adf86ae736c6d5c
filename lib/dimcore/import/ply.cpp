#include "import/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "import/byte_reader.hpp"
#include "import/ply_header.hpp"
#include "import/token_line.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

/// Takes numbers off the body one by one, whichever way it is written.
class PlyBody {
 public:
  PlyBody(const ImportInput& input, const PlyHeader& header)
      : input_(input), header_(header), rest_(input.bytes.substr(header.body)), words_(rest_, input.name) {}

  double number(PlyType type) {
    if (header_.encoding == PlyEncoding::text) {
      double value = 0.0;
      const std::string_view word = words_.take_word();
      if (!parse_number(word, value))
        throw InputError({input_.place(words_.place().line + header_.n_lines),
                          word.empty() ? "the file is cut short"
                                       : fmt::format("{} is no finite number", dim::quoted(word)),
                          ""});
      return value;
    }
    const std::size_t size = size_of(type);
    if (rest_.size() < size) throw InputError({input_.place(0), "the file is cut short", ""});
    const double value = as_double(type, rest_.data(), header_.encoding == PlyEncoding::big_endian);
    rest_.remove_prefix(size);
    if (!std::isfinite(value)) throw InputError({input_.place(0), "holds values that are no numbers", ""});
    return value;
  }

  /// Bytes that are left, at least one for every number that is to come.
  std::size_t n_left() const {
    return header_.encoding == PlyEncoding::text ? words_.n_left() : rest_.size();
  }

 private:
  const ImportInput& input_;
  const PlyHeader& header_;
  std::string_view rest_;
  TextScanner words_;
};

/// sRGB as pictures have it to linear.
double linear(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

using Colour = std::array<int, 3>;  ///< 0 to 255

class PlyReader {
 public:
  explicit PlyReader(const ImportInput& input)
      : input_(input),
        header_(read_ply_header(input)),
        body_(input, header_),
        materials_(model_),
        counter_(input) {
    model_.format = header_.encoding == PlyEncoding::text ? "PLY, text" : "PLY, binary";
  }

  ImportedModel run() {
    for (const PlyElement& element : header_.elements) read(element);
    unknowns_.tell(model_.warnings);
    return std::move(model_);
  }

 private:
  void read(const PlyElement& element) {
    if (element.n > body_.n_left())
      throw InputError({input_.place(element.line),
                        fmt::format("{} of '{}', more than the file has room for", element.n, element.name),
                        ""});
    if (element.name != "vertex" && element.name != "face" && element.n > 0)
      unknowns_.add(fmt::format("element '{}' is not understood and left out", element.name),
                    input_.place(element.line));
    for (std::size_t i = 0; i < element.n; ++i) {
      if (element.name == "vertex")
        vertex(element);
      else if (element.name == "face")
        face(element);
      else
        for (const PlyProperty& property : element.properties) values(property);
    }
  }

  const std::vector<double>& values(const PlyProperty& property) {
    values_.clear();
    double n = 1.0;
    if (property.is_list) n = body_.number(property.count_type);
    if (n < 0.0 || n > static_cast<double>(body_.n_left()))
      throw InputError(
          {input_.place(0), fmt::format("a list of {:g} values, more than the file has room for", n), ""});
    for (double i = 0; i < n; ++i) values_.push_back(body_.number(property.type));
    return values_;
  }

  /// Of 0..255, whatever numbers the colour is written in.
  static int coded(const PlyProperty& property, double value) {
    const bool is_share = property.type == PlyType::float32 || property.type == PlyType::float64;
    return static_cast<int>(std::clamp(is_share ? value * 255.0 : value, 0.0, 255.0) + 0.5);
  }

  static int channel(const std::string& name) {
    static constexpr std::array<const char*, 3> kShort = {"red", "green", "blue"},
                                                kLong = {"diffuse_red", "diffuse_green", "diffuse_blue"};
    for (std::size_t i = 0; i < 3; ++i)
      if (name == kShort[i] || name == kLong[i]) return static_cast<int>(i);
    return -1;
  }

  void vertex(const PlyElement& element) {
    Vec3 p(0.0);
    Colour colour{-1, -1, -1};
    for (const PlyProperty& property : element.properties) {
      const auto& read = values(property);
      if (read.empty()) continue;
      if (property.name == "x") p.x = read[0];
      if (property.name == "y") p.y = read[0];
      if (property.name == "z") p.z = read[0];
      if (property.name == "x" && property.type == PlyType::float32) model_.single_precision = true;
      if (const int c = channel(property.name); c >= 0)
        colour[static_cast<std::size_t>(c)] = coded(property, read[0]);
    }
    points_.push_back(p);
    colours_.push_back(colour);
  }

  void face(const PlyElement& element) {
    ImportedFace face;
    Colour own{-1, -1, -1}, sum{0, 0, 0};
    for (const PlyProperty& property : element.properties) {
      const auto& read = values(property);
      if (property.name == "vertex_indices" || property.name == "vertex_index") {
        for (const double index : read) {
          if (!(index >= 0.0 && index < static_cast<double>(points_.size())) || index != std::floor(index))
            throw InputError({input_.place(0),
                              fmt::format("face {} has the corner {:g}, which is none of the {} before it",
                                          model_.faces.size() + 1, index, points_.size()),
                              ""});
          const auto i = static_cast<std::size_t>(index);
          face.outline.push_back(points_[i]);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += std::max(colours_[i][c], 0);
          if (colours_[i][0] < 0) sum[0] = -1'000'000'000;
        }
      } else if (const int c = channel(property.name); c >= 0 && !read.empty()) {
        own[static_cast<std::size_t>(c)] = coded(property, read[0]);
      }
    }
    if (face.outline.size() < 3) {
      unknowns_.add("face of fewer than three corners left out", input_.place(0));
      return;
    }
    counter_.add(face.outline.size());
    const auto n = static_cast<int>(face.outline.size());
    const Colour mean = sum[0] < 0 ? Colour{-1, -1, -1} : Colour{sum[0] / n, sum[1] / n, sum[2] / n};
    face.material = material(own[0] >= 0 ? own : mean);
    model_.faces.push_back(std::move(face));
  }

  int material(const Colour& colour) {
    if (colour[0] < 0) return materials_("");
    const int index = materials_(fmt::format("colour-{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]));
    const auto share = [](int value) { return linear(value / 255.0); };
    model_.materials[static_cast<std::size_t>(index)].diffuse =
        luminous(share(colour[0]), share(colour[1]), share(colour[2]));
    return index;
  }

  const ImportInput& input_;
  PlyHeader header_;
  PlyBody body_;
  ImportedModel model_;
  MaterialIndex materials_;
  FaceCounter counter_;
  Unknowns unknowns_;
  std::vector<Vec3> points_;
  std::vector<Colour> colours_;
  std::vector<double> values_;
};

}  // namespace

ImportedModel read_ply(const ImportInput& input) { return PlyReader(input).run(); }

}  // namespace dim
