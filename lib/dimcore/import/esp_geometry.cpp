#include "import/esp_geometry.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "import/esp_blocks.hpp"
#include "import/token_line.hpp"
#include "photometry/text_scanner.hpp"

namespace dim {
namespace {

using Words = std::vector<std::string>;

/// What is said of one surface.
struct SurfaceEntry {
  std::string name, position, construction, boundary;
  bool is_transparent = false;
  bool is_open = false;  ///< ESP-r's fictitious surfaces between zones
  Place place;
};

class EspReader {
 public:
  explicit EspReader(const ImportInput& input)
      : input_(input), lines_(input.bytes), materials_(model_), counter_(input) {
    model_.format = "ESP-r geometry";
    model_.unit_m = 1.0;
    model_.up_stated = true;
  }

  ImportedModel run() {
    Words words = take();
    if (!words.empty() && words[0] == "*Geometry") {
      if (words.size() < 2 || words[1] != "1.1")
        refuse("is geometry of a version that is not known", "1.1 is read, and type GEN");
      if (words.size() > 3) zone_ = words[3];
      model_.format += " 1.1";
      tagged();
    } else if (!words.empty() && words[0] == "GEN") {
      if (words.size() > 1) zone_ = words[1];
      plain();
    } else if (!words.empty() && (words[0] == "REC" || words[0] == "REG")) {
      refuse(fmt::format("is of type {}, which is not read", words[0]),
             "let ESP-r's project manager convert it to type GEN");
    } else {
      refuse("begins neither with *Geometry nor with GEN: no zone geometry of ESP-r", "");
    }
    make_faces();
    unknowns_.tell(model_.warnings);
    return std::move(model_);
  }

 private:
  /// Words of the next line that has any: separated by blanks and commas, what follows # is comment. Empty at
  /// the end.
  Words take() {
    for (std::string_view line; lines_.next(line);) {
      place_ = input_.place(lines_.line_number());
      std::string text(line.substr(0, line.find('#')));
      for (char& c : text)
        if (c == ',') c = ' ';
      Words words;
      for (const std::string_view word : words_of(text)) words.emplace_back(word);
      if (!words.empty()) return words;
    }
    return {};
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& cure = "") const {
    throw InputError({input_.place(std::max(lines_.line_number(), 1)), what, cure});
  }

  double number(const Words& words, std::size_t i, const char* what) const {
    double value = 0.0;
    if (i >= words.size()) refuse(fmt::format("{} is missing", what));
    if (!parse_number(words[i], value))
      refuse(fmt::format("{} is {}, no finite number", what, dim::quoted(words[i])));
    return value;
  }

  std::size_t count(const Words& words, std::size_t i, const char* what, std::size_t most) const {
    const double value = number(words, i, what);
    if (!(value >= 0.0 && value <= static_cast<double>(most)) || value != std::floor(value))
      refuse(fmt::format("{} is {:g}, no whole number within 0..{}", what, value, most));
    return static_cast<std::size_t>(value);
  }

  Vec3 point(const Words& words, std::size_t first, const char* what) const {
    return {number(words, first, what), number(words, first + 1, what), number(words, first + 2, what)};
  }

  void tagged() {
    for (Words words = take(); !words.empty(); words = take()) {
      const std::string& tag = words[0];
      if (tag == "*vertex")
        vertices_.push_back(point(words, 1, "a coordinate"));
      else if (tag == "*edges")
        edges_.push_back(list(std::move(words), 1));
      else if (tag == "*surf")
        surface(words);
      else if (tag == "*rotate")
        turn_by(number(words, 1, "the angle"),
                words.size() > 3 ? Vec2(number(words, 2, "x"), number(words, 3, "y")) : Vec2(0.0));
      else if (tag == "*obs" || tag == "*obs3" || tag == "*obsp")
        block(words);
      else if (tag[0] == '*' && !is_of_no_use(tag))
        unknowns_.add(fmt::format("{} is not understood and left out", tag), place_);
    }
  }

  /// Dates, sunlight inside, shading directives, base lists, brackets round the blocks.
  static bool is_of_no_use(const std::string& tag) {
    for (const char* known : {"*date", "*insol", "*insol_calc", "*shad_calc", "*base_list", "*block_start",
                              "*end_block", "*previous_rotate"})
      if (tag == known) return true;
    return false;
  }

  /// A count and as many corner numbers, which may go on in the next lines.
  std::vector<std::size_t> list(Words words, std::size_t first) {
    const std::size_t n = count(words, first, "the number of corners", 10'000);
    while (words.size() < first + 1 + n) {
      const Words more = take();
      if (more.empty() || more[0][0] == '*') refuse(fmt::format("a list of {} corners has too few", n));
      words.insert(words.end(), more.begin(), more.end());
    }
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < n; ++i)
      corners.push_back(count(words, first + 1 + i, "a corner", vertices_.size()));
    return corners;
  }

  /// *surf,name,position,child of,usage,usage,construction,optics,boundary,…
  void surface(const Words& words) {
    if (words.size() < 8) refuse(fmt::format("*surf with {} items instead of 8 or more", words.size()));
    SurfaceEntry entry{words[1], words[2],
                       words[6], words.size() > 8 ? words[8] : "",
                       false,    words[7].starts_with("SC_fictit"),
                       place_};
    entry.is_transparent =
        words[7] != "OPAQUE" && words[7] != "UNKNOWN" && words[7] != "UNKN" && words[7] != "-";
    surfaces_.push_back(std::move(entry));
  }

  void plain() {
    const Words sizes = take();
    const std::size_t n_vertices = count(sizes, 0, "the number of vertices", 100'000);
    const std::size_t n_surfaces = count(sizes, 1, "the number of surfaces", 100'000);
    const double angle = sizes.size() > 2 ? number(sizes, 2, "the angle") : 0.0;
    const Vec2 about = sizes.size() > 4 ? Vec2(number(sizes, 3, "x"), number(sizes, 4, "y")) : Vec2(0.0);
    for (std::size_t i = 0; i < n_vertices; ++i) vertices_.push_back(point(take(), 0, "a coordinate"));
    turn_by(angle, about);
    for (std::size_t i = 0; i < n_surfaces; ++i) edges_.push_back(list(take(), 0));
    // An unused index and the indentation, a number a surface each, then how sunlight is spread: four.
    skip(n_surfaces);
    skip(n_surfaces);
    skip(4);
    for (std::size_t i = 0; i < n_surfaces; ++i) {
      const Words words = take();
      if (words.size() < 5)
        refuse(fmt::format("{} attributes of surface {} instead of 5 or more", words.size(), i + 1));
      surfaces_.push_back({words[1], words[3], words[4], words.size() > 5 ? words[5] : "", words[2] == "TRAN",
                           words[4].starts_with("fictit"), place_});
    }
  }

  void skip(std::size_t n_numbers) {
    for (std::size_t n = 0; n < n_numbers;) {
      const Words words = take();
      if (words.empty()) refuse("ends before its surfaces are described");
      n += words.size();
    }
  }

  void turn_by(double degrees_, const Vec2& about) {
    const double c = std::cos(radians(degrees_)), s = std::sin(radians(degrees_));
    if (degrees_ == 0.0) return;
    for (Vec3& p : vertices_) {
      const Vec2 d = Vec2(p.x, p.y) - about;
      p.x = about.x + d.x * c - d.y * s;
      p.y = about.y + d.x * s + d.y * c;
    }
  }

  /// *obs,x,y,z,dx,dy,dz,turn[,opacity],name,construction; *obs3 with two angles more;
  /// *obsp,8,6[,opacity],name, construction, then eight corners.
  void block(const Words& words) {
    std::array<Vec3, 8> corners;
    std::size_t next = 3;
    if (words[0] == "*obsp") {
      if (count(words, 1, "the number of corners", 8) != 8 || count(words, 2, "the number of faces", 6) != 6)
        refuse("a block of other than 8 corners and 6 faces");
    } else {
      const bool has_tilt = words[0] == "*obs3";
      next = has_tilt ? 10 : 8;
      if (has_tilt && number(words, 9, "the third angle") != 0.0)
        unknowns_.add("the third angle of a block is not applied", place_);
      corners = esp_block_corners(point(words, 1, "the origin"), point(words, 4, "a length"),
                                  number(words, 7, "the angle"),
                                  has_tilt ? number(words, 8, "the second angle") : 0.0);
    }
    double opacity = 1.0;
    if (next < words.size() && parse_number(words[next], opacity)) {
      ++next;
      if (opacity < 1.0) unknowns_.add("blocks that let some light through are written as opaque", place_);
    }
    const std::string name = next < words.size() ? words[next] : "block";
    const std::string construction = next + 1 < words.size() ? words[next + 1] : "";
    if (words[0] == "*obsp") corners = eight_corners();
    const int material =
        material_of(construction.empty() || construction == "NONE" ? "obstruction" : construction, 0.35);
    for (ImportedFace& face : esp_block_faces(corners, name, material)) blocks_.push_back(std::move(face));
  }

  std::array<Vec3, 8> eight_corners() {
    std::array<Vec3, 8> corners;
    Words words;
    while (words.size() < 24) {
      const Words more = take();
      if (more.empty() || more[0][0] == '*') refuse("a block with fewer than 8 corners");
      words.insert(words.end(), more.begin(), more.end());
    }
    for (std::size_t i = 0; i < 8; ++i) corners[i] = point(words, 3 * i, "a coordinate");
    return corners;
  }

  int material_of(const std::string& name, double assumed) {
    const int index = materials_(name);
    model_.materials[static_cast<std::size_t>(index)].assumed = assumed;
    return index;
  }

  int material_of(const SurfaceEntry& entry) {
    if (entry.is_transparent && !entry.is_open) {
      const int index = materials_(entry.construction + " (glass)");
      model_.materials[static_cast<std::size_t>(index)].is_glass = true;
      if (entry.boundary == "ANOTHER")
        unknowns_.add("glass to another zone is written as a window", entry.place,
                      "make it opaque or leave it out by hand");
      return index;
    }
    const bool is_floor = entry.position == "FLOR", is_ceiling = entry.position == "CEIL";
    return material_of(fmt::format("{} ({})", entry.construction,
                                   is_floor     ? "floor"
                                   : is_ceiling ? "ceiling"
                                                : "wall"),
                       is_floor     ? 0.2
                       : is_ceiling ? 0.7
                                    : 0.5);
  }

  /// Corners run counter-clockwise seen from outside.
  void make_faces() {
    if (surfaces_.size() != edges_.size())
      refuse(
          fmt::format("describes {} surfaces and lists the corners of {}", surfaces_.size(), edges_.size()));
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      ImportedFace face;
      counter_.add(edges_[i].size());
      for (auto corner = edges_[i].rbegin(); corner != edges_[i].rend(); ++corner) {
        if (*corner == 0)
          refuse(fmt::format("surface '{}' has the corner 0; they count from 1", surfaces_[i].name));
        face.outline.push_back(vertices_[*corner - 1]);
      }
      face.name = surfaces_[i].name;
      face.room = zone_;
      face.material = material_of(surfaces_[i]);
      face.lit = surfaces_[i].is_open ? Lit::open : Lit::front;
      if (surfaces_[i].is_open) unknowns_.add("fictitious surfaces are left open", surfaces_[i].place);
      model_.faces.push_back(std::move(face));
    }
    for (ImportedFace& face : blocks_) model_.faces.push_back(std::move(face));
  }

  const ImportInput& input_;
  LineReader lines_;
  ImportedModel model_;
  MaterialIndex materials_;
  FaceCounter counter_;
  Unknowns unknowns_;
  Place place_;
  std::string zone_ = "zone";
  std::vector<Vec3> vertices_;
  std::vector<std::vector<std::size_t>> edges_;
  std::vector<SurfaceEntry> surfaces_;
  std::vector<ImportedFace> blocks_;
};

}  // namespace

ImportedModel read_esp_geometry(const ImportInput& input) { return EspReader(input).run(); }

}  // namespace dim
