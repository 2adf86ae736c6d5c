#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "catch.hpp"
#include "image/colour_space.hpp"
#include "image/false_colour.hpp"
#include "image/legend.hpp"

using dim::Raster;
using dim::Scale;
using dim::ScaleKind;

namespace {

Raster with_values(const std::vector<float>& values) {
  Raster raster{static_cast<int>(values.size()), 1, {}, values, "lx"};
  raster.xyz.assign(3 * values.size(), 0.0f);
  return raster;
}

double lightness(const dim::Rgb8& colour) {
  const dim::Vec3 weights = dim::luminance_weights(dim::kSrgbPrimaries);
  double y = 0;
  for (int i = 0; i < 3; ++i) {
    y += weights[i] * dim::srgb_decode(colour[static_cast<std::size_t>(i)] / 255.0);
  }
  return y > 216.0 / 24389.0 ? 116 * std::cbrt(y) - 16 : y * 24389.0 / 27.0;
}

std::vector<std::string> labels(const Scale& scale, int n) {
  std::vector<std::string> result;
  for (const auto& tick : dim::ticks(scale, n)) {
    if (!tick.label.empty()) result.push_back(tick.label);
  }
  return result;
}

}  // namespace

TEST_CASE("The colour map's lightness is linear in the value", "[image][unit]") {
  for (int i = 0; i <= 255; ++i) {
    const double t = i / 255.0;
    // Rounding to 8 bits is worth up to 0.4 of lightness at the dark end.
    CHECK(lightness(dim::colour_map(t)) == Approx(14 + 78 * t).margin(0.5));
  }
  CHECK(dim::colour_map(-3) == dim::colour_map(0));
  CHECK(dim::colour_map(9) == dim::colour_map(1));
}

TEST_CASE("Linear scales start at zero and end at a round number", "[image][unit]") {
  const Scale scale = dim::automatic_scale(ScaleKind::linear, {120, 300, 487});
  CHECK(scale.low == 0);
  CHECK(scale.high == 500);
  CHECK(dim::automatic_scale(ScaleKind::linear, {0.013f, 0.0377f}).high == Approx(0.04));
  CHECK(dim::automatic_scale(ScaleKind::linear, {500}).high == Approx(500));
  CHECK(dim::automatic_scale(ScaleKind::linear, {}).high == 1);
  CHECK(dim::automatic_scale(ScaleKind::linear, {0, 0}).high == 1);
  const Scale negative = dim::automatic_scale(ScaleKind::linear, {-30, 70});
  CHECK(negative.low == Approx(-40));
  CHECK(negative.high == Approx(80));
}

TEST_CASE("A few hot pixels do not use up the scale", "[image][unit]") {
  std::vector<float> values(1000, 450);
  values[0] = values[1] = 90000;
  CHECK(dim::automatic_scale(ScaleKind::linear, values).high == 500);
}

TEST_CASE("Logarithmic scales end at 1, 2 or 5 and span at most four decades", "[image][unit]") {
  const Scale scale = dim::automatic_scale(ScaleKind::logarithmic, {3, 40, 1700});
  CHECK(scale.low == Approx(2));
  CHECK(scale.high == Approx(2000));
  const Scale wide = dim::automatic_scale(ScaleKind::logarithmic, {0, 1e-9f, 1000});
  CHECK(wide.low == Approx(0.1));
  CHECK(wide.high == Approx(1000));
  CHECK(dim::automatic_scale(ScaleKind::logarithmic, {100, 100}).low == Approx(10));
}

TEST_CASE("Ticks are round and labelled with one number of decimals", "[image][unit]") {
  CHECK(labels({ScaleKind::linear, 0, 500}, 11) ==
        std::vector<std::string>{"0", "50", "100", "150", "200", "250", "300", "350", "400", "450", "500"});
  CHECK(labels({ScaleKind::linear, 0, 500}, 6) ==
        std::vector<std::string>{"0", "100", "200", "300", "400", "500"});
  CHECK(labels({ScaleKind::linear, 0, 1}, 5) ==
        std::vector<std::string>{"0.00", "0.25", "0.50", "0.75", "1.00"});
  CHECK(labels({ScaleKind::linear, 13, 47}, 6) == std::vector<std::string>{"20", "30", "40"});
  CHECK(labels({ScaleKind::logarithmic, 2, 2000}, 11) ==
        std::vector<std::string>{"2", "5", "10", "20", "50", "100", "200", "500", "1000", "2000"});
  CHECK(labels({ScaleKind::logarithmic, 0.1, 1000}, 6) ==
        std::vector<std::string>{"0.1", "1", "10", "100", "1000"});
}

TEST_CASE("Each value gets the colour of its place on the scale", "[image][unit]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto result = dim::false_colour(with_values({0, 250, 500, 600, -5, nan}), {.low = 0, .high = 500});
  const auto pixel = [&](std::size_t i) {
    return dim::Rgb8{result.picture.rgb[3 * i], result.picture.rgb[3 * i + 1], result.picture.rgb[3 * i + 2]};
  };
  CHECK(pixel(0) == dim::colour_map(0));
  CHECK(pixel(1) == dim::colour_map(0.5));
  CHECK(pixel(2) == dim::colour_map(1));
  CHECK(pixel(3) == dim::colour_map(1));
  CHECK(pixel(4) == dim::colour_map(0));
  CHECK(pixel(5) == dim::kNoValueColour);
  CHECK(result.n_above == 1);
  CHECK(result.n_below == 1);
}

TEST_CASE("On a logarithmic scale the geometric mean is in the middle", "[image][unit]") {
  const Scale scale{ScaleKind::logarithmic, 10, 1000};
  CHECK(scale.position(100) == Approx(0.5));
  CHECK(scale.position(0) < -1e9);
  const auto result =
      dim::false_colour(with_values({0, 100}), {.kind = ScaleKind::logarithmic, .low = 10, .high = 1000});
  CHECK(result.n_below == 1);
}

TEST_CASE("Impossible ranges are refused; one given end finds its partner", "[image][unit]") {
  const Raster raster = with_values({1, 2, 3});
  CHECK_THROWS_AS(dim::false_colour(raster, {.low = 5, .high = 5}), dim::InputError);
  CHECK_THROWS_AS(dim::false_colour(raster, {.low = std::nan("")}), dim::InputError);
  CHECK_THROWS_AS(dim::false_colour(raster, {.kind = ScaleKind::logarithmic, .low = 0, .high = 5}),
                  dim::InputError);
  CHECK(dim::false_colour(raster, {.low = 50}).scale.high > 50);
  Raster none = raster;
  none.scalar.clear();
  CHECK_THROWS_AS(dim::false_colour(none), dim::InternalError);
}

namespace {

/// Remembers what would be drawn; digits are half as wide as high.
class FakeText : public dim::TextDrawer {
 public:
  struct Drawn {
    int x, y, width;
    std::string text;
  };
  bool available() const override { return true; }
  dim::TextExtent measure(const std::string& utf8, int size_px) const override {
    return {static_cast<int>(utf8.size()) * size_px / 2, size_px * 3 / 4, 0};
  }
  void draw(dim::Picture8& picture, int x, int y, const std::string& utf8, int size_px,
            dim::Rgb8) const override {
    const int width = measure(utf8, size_px).width;
    CHECK((x >= 0 && x + width <= picture.width));
    CHECK((y - size_px * 3 / 4 >= 0 && y <= picture.height));
    drawn.push_back({x, y, width, utf8});
    size = size_px;
  }
  mutable std::vector<Drawn> drawn;
  mutable int size = 0;
};

}  // namespace

TEST_CASE("Legend words lie inside the sheet and do not overlap, whatever the picture's size",
          "[image][unit]") {
  for (const int height : {1, 40, 120, 200, 480, 960, 2160, 8000}) {
    for (const ScaleKind kind : {ScaleKind::linear, ScaleKind::logarithmic}) {
      Raster raster{4, height, {}, {}, "lx"};
      raster.xyz.assign(3 * raster.n_pixels(), 0.0f);
      raster.scalar.assign(raster.n_pixels(), 37.0f);
      const FakeText text;
      const auto painted = dim::false_colour(raster, {.kind = kind, .low = 0.5, .high = 12000});
      const auto sheet = dim::with_legend(painted, "Illuminance", "lx", text);
      CHECK(sheet.height == std::max(height, dim::kMinLegendHeight));
      REQUIRE(text.drawn.size() >= 4);
      for (std::size_t i = 1; i < text.drawn.size(); ++i) {
        CHECK(std::abs(text.drawn[i].y - text.drawn[i - 1].y) >= text.size);
      }
    }
  }
}

TEST_CASE("Pixels beyond the scale are owned up to in the legend", "[image][unit]") {
  Raster raster{1, 200, {}, std::vector<float>(200, 700.0f), "lx"};
  raster.xyz.assign(600, 0.0f);
  const FakeText text;
  dim::with_legend(dim::false_colour(raster, {.low = 0, .high = 500}), "", "lx", text);
  const auto says = [&](const std::string& s) {
    return std::any_of(text.drawn.begin(), text.drawn.end(), [&](const auto& d) { return d.text == s; });
  };
  CHECK(says("> 500"));
  CHECK(says("0"));
  CHECK(says("lx"));
}

TEST_CASE("The ends of a legend are labelled, round or not, at any height", "[image][unit]") {
  for (const int height : {60, 200, 960}) {
    for (const ScaleKind kind : {ScaleKind::linear, ScaleKind::logarithmic}) {
      Raster raster{1, height, {}, std::vector<float>(static_cast<std::size_t>(height), 100.0F), "lx"};
      raster.xyz.assign(3 * raster.n_pixels(), 0.0F);
      const FakeText text;
      dim::with_legend(dim::false_colour(raster, {.kind = kind, .low = 3.7, .high = 437.5}), "", "lx", text);
      const auto says = [&](const std::string& s) {
        return std::any_of(text.drawn.begin(), text.drawn.end(), [&](const auto& d) { return d.text == s; });
      };
      CHECK(says("3.7"));
      CHECK(says("437.5"));
    }
  }
}
