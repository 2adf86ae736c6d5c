#include "esp/temporal_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "esp/esp_text.hpp"

namespace dim {
namespace {

constexpr std::size_t kTagLength = 12;
constexpr int kWidth = 20;  ///< words of a record; ESP-r takes no fewer
constexpr int kFirstStepRecord = 50;
constexpr double kMostWatts = 100000.0;

struct Field {
  const char* name;
  double least;
};
constexpr std::array<Field, kGainColumns> kFields = {{{"Occup convec gain (W):", -10000.0},
                                                      {"Occup radiant gain (W):", -10000.0},
                                                      {"Occup latent gain (W):", 0.0},
                                                      {"Lights convec gain (W):", -10000.0},
                                                      {"Lights radiant gain (W):", -10000.0},
                                                      {"Lights latent gain (W):", 0.0},
                                                      {"Equip convec gain (W):", -10000.0},
                                                      {"Equip radiant gain (W):", -10000.0},
                                                      {"Equip latent gain (W):", 0.0}}};

long n_steps(const TemporalGains& gains) {
  return static_cast<long>(gains.end_day - gains.begin_day + 1) * 24 * gains.steps_per_hour;
}

double time_of(const TemporalGains& gains, std::size_t row) {
  return gains.begin_day + static_cast<double>(row + 1) / (24.0 * gains.steps_per_hour);
}

[[noreturn]] void refuse(const std::string& what) { throw LimitError("temporal file: " + what); }

void check(const TemporalGains& gains) {
  if (gains.steps_per_hour < 1 || gains.steps_per_hour > 60)
    refuse(fmt::format("{} steps an hour, ESP-r takes 1..60", gains.steps_per_hour));
  if (gains.tag.empty() || gains.tag.size() > kTagLength)
    refuse(fmt::format("the tag '{}' has {} characters, ESP-r takes 1..{}", gains.tag, gains.tag.size(),
                       kTagLength));
  if (gains.begin_day < 1 || gains.end_day > 366 || gains.begin_day > gains.end_day)
    refuse(fmt::format("days {}..{} are not of one year", gains.begin_day, gains.end_day));
  if (static_cast<long>(gains.rows.size()) != n_steps(gains))
    refuse(fmt::format("{} rows for {} steps", gains.rows.size(), n_steps(gains)));
  for (const auto& row : gains.rows)
    for (std::size_t c = 0; c < kGainColumns; ++c)
      if (!(row[c] >= kFields[c].least && row[c] <= kMostWatts))
        refuse(fmt::format("{} W of '{}', ESP-r takes {}..{}", row[c], kFields[c].name, kFields[c].least,
                           kMostWatts));
}

void read_item(EspReader& in, TemporalGains& gains) {
  in.tag("*items");
  gains.tag = in.tag("*tag");
  if (gains.tag.empty() || gains.tag.size() > kTagLength)
    in.wrong(fmt::format("the tag '{}' has {} characters, ESP-r takes 1..{}", gains.tag, gains.tag.size(),
                         kTagLength));
  const std::string type = in.tag("*type");
  if (type != "CASUAL3T") in.wrong(fmt::format("type '{}', this reader knows CASUAL3T", type));
  in.tag("*menu");
  in.tag("*aide");
  in.line("*other");
  in.word("*other");
  in.integer("static fields", 0, 0);
  in.integer("columns", kGainColumns, kGainColumns);
  in.end_line();
  in.line("*fields");
  in.word("*fields");
  in.integer("number of fields", kGainColumns, kGainColumns);
  in.end_line();
  for (int i = 1; i <= static_cast<int>(kGainColumns); ++i) {
    in.line("a field");
    const std::string kind = in.word("kind of field");
    if (kind != "REAL") in.wrong(fmt::format("a field '{}', a gain is REAL", kind));
    in.integer("field", i, i);
    in.integer("column", i, i);
    for (const char* what : {"default", "least", "greatest"}) in.real(what, -1e6, 1e6);
    while (in.n_words() > 0) in.word("description");
  }
  in.tag("*end_item");
}

void read_rows(EspReader& in, TemporalGains& gains, long n) {
  in.tag("*tabular_data");
  for (long k = 0; k < n; ++k) {
    in.line("a row of data");
    const double expected = time_of(gains, static_cast<std::size_t>(k));
    const double time = in.real("time", 1.0, 367.0);
    if (std::abs(time - expected) > 2e-6)
      in.wrong(fmt::format("time {:.6f}, this row is of {:.6f}", time, expected));
    GainRow row{};
    for (std::size_t c = 0; c < kGainColumns; ++c)
      row[c] = in.real(kFields[c].name, kFields[c].least, kMostWatts);
    in.end_line();
    gains.rows.push_back(row);
  }
  in.tag("*end_tabular_data");
}

}  // namespace

std::string gains_tag(const std::string& zone) {
  std::string tag = zone + "_lights";
  if (tag.size() > kTagLength) tag.resize(kTagLength);
  return tag;
}

std::string write_tdf(const TemporalGains& gains) {
  check(gains);
  std::string text = "ASCIITDF3\n# NWPR NITDF NTSPH year begin end columns\n";
  text += fmt::format("{:5}{:5}{:5}{:5}{:5}{:5}{:5}\n", kWidth, 1, gains.steps_per_hour, gains.year,
                      gains.begin_day, gains.end_day, kGainColumns);
  text += fmt::format("# NEXTRC NEXTCL NDBSTP\n{:7}{:7}{:7}\n", 1, kGainColumns + 1, n_steps(gains));
  text += fmt::format("*tdaid1,DIM zone lighting level\n*tdaid2,zone {}\n*items\n*tag,{}\n*type,CASUAL3T\n",
                      gains.zone, gains.tag);
  text +=
      fmt::format("*menu,Casual separate OccLtEq\n*aide,DIM lighting gains\n*other,{:4}{:4}\n*fields,{:2}\n",
                  0, kGainColumns, kGainColumns);
  for (std::size_t c = 0; c < kGainColumns; ++c)
    text += fmt::format("REAL{:3} {:3}{:11.3f}{:11.3f}{:11.3f}  {}\n", c + 1, c + 1, 0.0, kFields[c].least,
                        kMostWatts, kFields[c].name);
  text += "*end_item\n*pointers\n 5\n*tabular_data\n# time then columns\n";
  for (std::size_t k = 0; k < gains.rows.size(); ++k) {
    text += fmt::format("{:10.6f}", time_of(gains, k));
    for (const double watts : gains.rows[k]) text += fmt::format(",{:.2f}", watts);
    text += '\n';
  }
  return text + "*end_tabular_data\n";
}

TemporalGains read_tdf(std::string_view text, const std::string& file) {
  EspReader in(text, file);
  TemporalGains gains;
  in.tag("ASCIITDF3");
  in.line("the header");
  in.integer("record width", kWidth, 10000);
  in.integer("number of items", 1, 1);
  gains.steps_per_hour = in.integer("steps an hour", 1, 60);
  gains.year = in.integer("year", 1, 9999);
  gains.begin_day = in.integer("first day", 1, 366);
  gains.end_day = in.integer("last day", gains.begin_day, 366);
  in.integer("columns", kGainColumns, kGainColumns);
  in.end_line();
  in.line("the sizes");
  in.integer("next record", 1, 1);
  in.integer("next column", kGainColumns + 1, kGainColumns + 1);
  const int n = static_cast<int>(n_steps(gains));
  in.integer("number of steps", n, n);
  in.end_line();
  in.tag("*tdaid1");
  const std::string about = in.tag("*tdaid2");
  gains.zone = about.starts_with("zone ") ? about.substr(5) : about;
  read_item(in, gains);
  in.tag("*pointers");
  in.line("a pointer");
  in.integer("pointer", 1, kFirstStepRecord);
  in.end_line();
  read_rows(in, gains, n);
  in.finish();
  return gains;
}

std::string tdf_links(const TemporalGains& gains, const std::string& file_name) {
  return fmt::format("*tdf ../nets/{}\n{} CASUAL3T {}\n* end tdf\n", file_name, gains.tag, gains.zone);
}

}  // namespace dim
