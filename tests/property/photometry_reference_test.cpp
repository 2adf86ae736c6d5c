#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "catch.hpp"
#include "photometry/photometry_file.hpp"
#include "photometry/photometry_writer.hpp"

namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> split_csv(const std::string& line) {
  std::vector<std::string> cells(1);
  bool in_quotes = false;
  for (const char c : line) {
    if (c == '"')
      in_quotes = !in_quotes;
    else if (c == ',' && !in_quotes)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

std::vector<Row> read_csv(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<Row> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    const auto cells = split_csv(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

std::filesystem::path shared_photometry() {
  const char* given = std::getenv("DIM_SHARED_DATA");
  const std::filesystem::path data =
      given ? std::filesystem::path(given) : std::filesystem::path(DIM_SOURCE_DIR) / "../shared/data";
  return data / "photometry";
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Every intensity of `wanted` is in `found`, the same angles or not.
void check_same(const dim::Photometry& wanted, const dim::Photometry& found) {
  const dim::IntensityTable a(wanted.distribution), b(found.distribution);
  REQUIRE(wanted.distribution.type == found.distribution.type);
  REQUIRE(found.distribution.intensity_cd.size() == wanted.distribution.intensity_cd.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < wanted.distribution.intensity_cd.size(); ++i) {
    const double cd = wanted.distribution.intensity_cd[i];
    worst =
        std::max(worst, std::abs(found.distribution.intensity_cd[i] - cd) / std::max(cd, 1e-3 * a.max_cd()));
  }
  CHECK(worst < 1e-6);
  CHECK(b.flux_lm() == Approx(a.flux_lm()).epsilon(1e-6));
  CHECK(found.watts.value_or(0) == Approx(wanted.watts.value_or(0)).epsilon(1e-6));
}

std::vector<std::filesystem::path> own_corpus() {
  std::vector<std::filesystem::path> paths;
  for (const char* folder : {"/tests/data/photometry", "/db/fittings"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(DIM_SOURCE_DIR) + folder))
      if (dim::is_photometric_name(entry.path().string())) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string mutated(std::string bytes, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % (n + 1)); };
  const std::size_t n_changes = 1 + below(5);
  for (std::size_t i = 0; i < n_changes && !bytes.empty(); ++i) {
    const std::size_t at = below(bytes.size() - 1);
    const std::size_t length = below(std::min<std::size_t>(40, bytes.size() - at));
    switch (below(4)) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 3:
        bytes.erase(at, length);
        break;
      default:
        bytes[at] = "0123456789-+.eE, \n\r[]="[below(21)];
        break;
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("Files of makers integrate to the independent bilinear flux within 0.01 %",
          "[photometry][validation]") {
  const auto folder = shared_photometry();
  if (!std::filesystem::exists(folder / "facts.csv")) {
    WARN("skipped: no reference photometry (set DIM_SHARED_DATA)");
    return;
  }
  std::size_t n_checked = 0;
  for (const Row& row : read_csv(folder / "facts.csv")) {
    if (row.at("kind") != "LM-63") continue;
    INFO(row.at("file"));
    dim::Warnings warnings;
    const auto path = (folder / row.at("file")).string();
    const auto p = dim::read_photometric_file(path, warnings);
    const double flux = std::stod(row.at("flux_bilinear_lm"));
    // Half a unit of the table's second decimal on top, which matters for the smallest.
    CHECK(std::abs(p.flux_lm - flux) <= 1e-4 * flux + 0.005);
    CHECK(p.max_cd == Approx(std::stod(row.at("max_candela"))).epsilon(1e-6));
    CHECK_THAT(row.at("symmetry"), Catch::Matchers::StartsWith(dim::symmetry_name(p.symmetry)));
    const double unit_m = row.at("units") == "ft" ? 0.3048 : 1.0;
    const bool type_c = row.at("photometric_type") == "C";
    CHECK((type_c ? p.opening.width_m : p.opening.length_m) ==
          Approx(unit_m * std::abs(std::stod(row.at("width")))).margin(1e-12));
    CHECK((type_c ? p.opening.length_m : p.opening.width_m) ==
          Approx(unit_m * std::abs(std::stod(row.at("length")))).margin(1e-12));
    CHECK(p.watts == std::stod(row.at("watts")));
    ++n_checked;
  }
  CHECK(n_checked >= 12);
}

TEST_CASE("EULUMDAT files of makers integrate to the independent bilinear flux within 0.01 %",
          "[photometry][validation]") {
  const auto folder = shared_photometry();
  if (!std::filesystem::exists(folder / "facts.csv")) {
    WARN("skipped: no reference photometry (set DIM_SHARED_DATA)");
    return;
  }
  std::size_t n_checked = 0;
  for (const Row& row : read_csv(folder / "facts.csv")) {
    if (row.at("kind") != "EULUMDAT") continue;
    INFO(row.at("file"));
    dim::Warnings warnings;
    const auto p = dim::read_photometric_file((folder / row.at("file")).string(), warnings);
    const double klm = std::stod(row.at("lumens")) / 1000.0;
    CHECK(p.flux_lm == Approx(klm * std::stod(row.at("flux_bilinear_per_klm"))).epsilon(1e-4));
    CHECK(p.max_cd == Approx(klm * std::stod(row.at("max_candela"))).epsilon(1e-6));
    CHECK(p.n_lamps == std::stoi(row.at("lamps")));
    ++n_checked;
  }
  CHECK(n_checked >= 4);
}

TEST_CASE("The same luminaire in LM-63 and in EULUMDAT has the same intensities",
          "[photometry][validation]") {
  const auto folder = shared_photometry();
  if (!std::filesystem::exists(folder / "facts.csv")) {
    WARN("skipped: no reference photometry (set DIM_SHARED_DATA)");
    return;
  }
  dim::Warnings warnings;
  const auto ies = dim::read_photometric_file((folder / "luxpy_isym3.ies").string(), warnings);
  const auto ldt = dim::read_photometric_file((folder / "luxpy_isym3.ldt").string(), warnings);
  const dim::IntensityTable a(ies.distribution), b(ldt.distribution);
  for (int c = 0; c < 360; c += 15)
    for (int gamma = 0; gamma <= 90; gamma += 5) {
      INFO("C " << c << " gamma " << gamma);
      // The EULUMDAT values have six digits, the LM-63 ones two decimals.
      CHECK(a.at_c_gamma(dim::radians(c), dim::radians(gamma)) ==
            Approx(b.at_c_gamma(dim::radians(c), dim::radians(gamma))).epsilon(2e-5).margin(0.02));
    }
  CHECK(ies.opening.length_m == ldt.opening.length_m);
  CHECK(ies.opening.width_m == ldt.opening.width_m);
}

TEST_CASE("Written and read again, files of makers keep every intensity to 1e-6", "[photometry][property]") {
  std::vector<std::filesystem::path> paths = own_corpus();
  const auto folder = shared_photometry();
  if (std::filesystem::exists(folder / "facts.csv"))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (dim::is_photometric_name(entry.path().string())) paths.push_back(entry.path());
  std::size_t n_checked = 0;
  for (const auto& path : paths) {
    INFO(path.string());
    dim::Warnings warnings;
    dim::Photometry p;
    try {
      p = dim::read_photometric_file(path.string(), warnings);
    } catch (const dim::InputError&) {
      continue;
    }
    check_same(p, dim::read_photometry(dim::ies_text(p), "written.ies", warnings));
    if (p.distribution.type == dim::PhotometricType::kC && p.flux_lm > 0.0)
      check_same(p, dim::read_photometry(dim::eulumdat_text(p, warnings), "written.ldt", warnings));
    ++n_checked;
  }
  CHECK(n_checked >= 30);
}

TEST_CASE("Flux summed over directions agrees with the closed form", "[photometry][property]") {
  dim::Warnings warnings;
  const auto p =
      dim::read_photometric_file(std::string(DIM_SOURCE_DIR) + "/db/fittings/batten-5200.ies", warnings);
  const dim::IntensityTable table(p.distribution);
  // Equal-area grid over the sphere, midpoints in z and C.
  const int n_z = 600;
  const int n_c = 600;
  double sum = 0.0;
  for (int i = 0; i < n_z; ++i)
    for (int j = 0; j < n_c; ++j) {
      const double z = 1.0 - (i + 0.5) * 2.0 / n_z;
      const double c = (j + 0.5) * 2.0 * dim::kPi / n_c;
      const double s = std::sqrt(1.0 - z * z);
      sum += table.at({s * std::cos(c), s * std::sin(c), z});
    }
  CHECK(sum * 4 * dim::kPi / (n_z * n_c) == Approx(table.flux_lm()).epsilon(1e-5));
}

TEST_CASE("Damaged files are read or refused, never worse", "[photometry][property]") {
  const unsigned long seed = 20250115;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t n_read = 0;
  std::size_t n_refused = 0;
  for (const auto& path : own_corpus()) {
    const std::string whole = bytes_of(path);
    for (int i = 0; i < 120; ++i) {
      const std::string bytes = mutated(whole, random);
      dim::Warnings warnings;
      try {
        const auto p = dim::read_photometry(bytes, "damaged" + path.extension().string(), warnings);
        REQUIRE(std::isfinite(p.flux_lm));
        REQUIRE(p.flux_lm >= 0.0);
        ++n_read;
      } catch (const dim::InputError&) {
        ++n_refused;
      }
    }
  }
  CHECK(n_read > 100);
  CHECK(n_refused > 100);
}

TEST_CASE("A file cut at any byte is read or refused", "[photometry][property]") {
  const std::string whole = bytes_of(std::string(DIM_SOURCE_DIR) + "/tests/data/photometry/tilt_include.ies");
  for (std::size_t n = 0; n < whole.size(); ++n) {
    dim::Warnings warnings;
    try {
      dim::read_ies(whole.substr(0, n), "cut.ies", warnings);
      // Only the last number's digits may go unnoticed.
      REQUIRE(n + 4 >= whole.size());
    } catch (const dim::InputError& error) {
      REQUIRE(error.problems().front().place.line > 0);
    }
  }
}
