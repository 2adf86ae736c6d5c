// The layout of the binary files: what the documentation says, what is written, and what is refused.
#include "base/file_layout.hpp"

#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include "catch.hpp"
#include "network/network_storage.hpp"
#include "property/transport_support.hpp"
#include "result/lum_file.hpp"
#include "unit/files_support.hpp"
#include "unit/forged_file.hpp"

using namespace dim;
using namespace dim::test;
using files_test::Folder;
using files_test::ForgedFile;
using files_test::io_error;

namespace {

struct Row {
  std::string type, unit;
  bool operator==(const Row&) const = default;
};

// Rows `| `/path` | type [shape] | unit | …` of docs/formats.md, those of one format only.
std::map<std::string, Row> documented(const std::string& other_format) {
  std::ifstream file(std::string(DIM_SOURCE_DIR) + "/docs/formats.md");
  std::map<std::string, Row> rows;
  bool skip = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) skip = line.find(other_format) != std::string::npos;
    if (skip || !line.starts_with("| `/")) continue;
    const auto columns = split(std::string_view(line).substr(2), " | ");
    REQUIRE(columns.size() >= 3);
    rows[std::string(columns[0].substr(1, columns[0].size() - 2))] = {std::string(columns[1]),
                                                                      std::string(columns[2])};
  }
  return rows;
}

std::map<std::string, Row> stated(const FileSchema& schema) {
  std::map<std::string, Row> rows;
  for (const auto& rule : schema.datasets) {
    std::string type(rule.type);
    if (!rule.shape.empty()) type += " [" + std::string(rule.shape) + "]";
    rows[std::string(rule.path)] = {type, std::string(rule.unit)};
  }
  return rows;
}

void check_same(const std::map<std::string, Row>& docs, const std::map<std::string, Row>& schema) {
  for (const auto& [path, row] : schema) {
    CAPTURE(path);
    REQUIRE(docs.count(path) == 1);
    CHECK(docs.at(path).type == row.type);
    CHECK(docs.at(path).unit == row.unit);
  }
  for (const auto& [path, row] : docs) {
    CAPTURE(path);
    CHECK(schema.count(path) == 1);
  }
}

// Every dataset of a file, by HDF5's own walk.
std::vector<std::string> datasets_of(const std::string& path) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  std::vector<std::string> names;
  H5Ovisit2(
      file, H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t, const char* name, const H5O_info_t* info, void* out) -> herr_t {
        if (info->type == H5O_TYPE_DATASET)
          static_cast<std::vector<std::string>*>(out)->push_back(std::string("/") + name);
        return 0;
      },
      &names, H5O_INFO_BASIC);
  H5Fclose(file);
  return names;
}

// A room with a lobe and a family, so that nothing optional is missing.
struct StoredRoom {
  Zone zone = furnished_room(0.5, 1.0);
  Lights lights = point_lamp({-2, 0, 1.2}, 200.0);
  Network network;

  StoredRoom() {
    zone.points.push_back({{0.1, 0.2, 0.3}, {0, 0, 1}});
    zone.point_sets.push_back({"p", 0, 1});
    zone.surfaces[0].finish = add_grey(zone, 0.3);
    zone.finishes.back().specular = 0.4;
    zone.finishes.back().roughness = 0.3;
    NetworkOptions options;
    options.patches = options.point_patches = {4, 6};
    options.family = true;
    network = build_network(zone, Cells(zone), options, Job{});
  }
  void save(const Folder& folder) const {
    const Cells cells(zone);
    save_rays(folder / "a.rays", zone, cells, network);
    save_lum(folder / "a.lum", zone, cells, lights, solve(zone, lights, network), "hash");
  }
};

// Names of what was written, all of it as the layout has it.
std::set<std::string> check_written(const std::string& path, const std::string& kind, int version,
                                    const FileSchema& schema) {
  // Before the reader has the file open in its own way.
  const auto written = datasets_of(path);
  Hdf5Reader file(path, kind, version);
  file.lay_against(schema, std::size_t{1} << 30);
  const auto rules = stated(schema);
  for (const auto& name : written) {
    CAPTURE(name);
    REQUIRE(rules.count(name) == 1);
    CHECK(file.text_attribute(name, "unit") == rules.at(name).unit);
  }
  return {written.begin(), written.end()};
}

std::set<std::string> names_of(const FileSchema& schema) {
  std::set<std::string> names;
  for (const auto& [name, row] : stated(schema)) names.insert(name);
  return names;
}

}  // namespace

TEST_CASE("The documentation shows the layouts that files are read by", "[base][unit]") {
  check_same(documented("`.lum`, format"), stated(rays_schema()));
  check_same(documented("`.rays`, format"), stated(lum_schema()));
}

TEST_CASE("What is written is what the layout says, and nothing else", "[base][unit]") {
  const Folder folder;
  StoredRoom room;
  room.save(folder);
  CHECK(check_written(folder / "a.rays", "rays", kRaysVersion, rays_schema()) == names_of(rays_schema()));
  auto written = check_written(folder / "a.lum", "lum", kLumVersion, lum_schema());
  // Errors are known where there are no lobes.
  for (auto& finish : room.zone.finishes) finish.specular = 0.0;
  room.save(folder);
  written.merge(check_written(folder / "a.lum", "lum", kLumVersion, lum_schema()));
  CHECK(written == names_of(lum_schema()));
}

TEST_CASE("A layout binds sizes where they are first named and compares them after", "[base][unit]") {
  const Folder folder;
  FileSchema schema;
  schema.attributes = {{"/g", "a", AttributeType::integer, 1, 10}};
  schema.datasets = {{"/g/x", "float64", "n, 2", "1", Allowed::positive},
                     {"/g/first", "uint64", "n+1"},
                     {"/g/of", "uint32", "a*n", "1", Allowed::index, "n"}};
  const auto written = [&](std::vector<double> x, std::vector<std::uint64_t> first, std::vector<std::uint32_t> of,
                           int a) {
    Hdf5Writer file("rays", 1);
    file.dataset<double>("/g/x", x, {x.size() / 2, 2}, "1");
    file.dataset<std::uint64_t>("/g/first", first, {first.size()}, "1");
    file.dataset<std::uint32_t>("/g/of", of, {of.size()}, "1");
    file.attribute("/g", "a", a);
    std::move(file).write(folder / "x");
    return io_error([&] {
      Hdf5Reader reader(folder / "x", "rays", 1);
      reader.lay_against(schema, 1000);
      CHECK(reader.size("n") == x.size() / 2);
      reader.dataset<double>("/g/x", {kAnySize, 2});
      std::vector<std::uint32_t> part(1);
      reader.read_rows<std::uint32_t>("/g/of", 1, 1, part);
    });
  };
  const auto says = [&](const std::string& message, const std::string& words) {
    CAPTURE(message);
    CHECK(message.find(words) != std::string::npos);
  };
  CHECK(written({1, 2, 3, 4}, {0, 1, 2}, {0, 1, 1, 0, 0, 0}, 3).empty());
  says(written({1, 2, 3, 4}, {0, 1}, {0, 1, 1, 0, 0, 0}, 3), "'/g/first' has shape [2], expected [n+1] with n+1 = 3");
  says(written({1, 2, 3, 4}, {0, 1, 2}, {0, 1, 1, 0, 0}, 3), "'/g/of' has shape [5], expected [a*n] with a*n = 6");
  says(written({1, 2, 3, 4}, {0, 1, 2}, {0, 1, 1, 0, 0, 0}, 11), "attribute 'a' of '/g' is 11, outside 1..10");
  says(written({1, 2, 0, 4}, {0, 1, 2}, {0, 1, 1, 0, 0, 0}, 3), "'/g/x': element 2 is 0, not a finite number above 0");
  says(written({1, 2, HUGE_VAL, 4}, {0, 1, 2}, {0, 1, 1, 0, 0, 0}, 3), "'/g/x': element 2 is inf");
  says(written({1, 2, 3, 4}, {0, 1, 2}, {0, 2, 1, 0, 0, 0}, 3), "'/g/of': element 1 is 2, not below 2 (n)");
}

TEST_CASE("A file that would not fit in memory is refused before it is read", "[base][unit]") {
  const Folder folder;
  StoredRoom().save(folder);
  Job job;
  job.memory_limit_bytes = 10'000;
  CHECK_THROWS_AS(load_rays(folder / "a.rays", job), LimitError);
  CHECK_THROWS_AS(load_lum(folder / "a.lum", job), LimitError);
}

TEST_CASE("What DIM never writes is refused by name", "[base][unit]") {
  const Folder folder;
  const auto refused = [&](const std::function<void(const ForgedFile&)>& change) {
    Hdf5Writer writer("rays", 1);
    writer.dataset<double>("/g/x", std::vector<double>(8, 1.0), {8}, "1");
    writer.attribute("/g", "n", 3);
    std::move(writer).write(folder / "x");
    change(ForgedFile(folder / "x"));
    return io_error([&] {
      const Hdf5Reader reader(folder / "x", "rays", 1);
      reader.integer_attribute("/g", "n");
    });
  };
  const auto says = [&](const std::string& words, const std::function<void(const ForgedFile&)>& change) {
    const std::string message = refused(change);
    CAPTURE(message, words);
    CHECK(message.find(words) != std::string::npos);
  };
  CHECK(refused([](auto&) {}).empty());
  says("'/g/y' is a link to elsewhere", [](auto& f) {
    H5Lcreate_soft("/g/x", f.id(), "/g/y", H5P_DEFAULT, H5P_DEFAULT);
  });
  says("'/g/y' is a link to elsewhere", [&](auto& f) {
    H5Lcreate_external((folder / "elsewhere").c_str(), "/g/x", f.id(), "/g/y", H5P_DEFAULT, H5P_DEFAULT);
  });
  says("second name", [](auto& f) {
    H5Lcreate_hard(f.id(), "/g/x", f.id(), "/g/y", H5P_DEFAULT, H5P_DEFAULT);
  });
  says("second name", [](auto& f) { H5Lcreate_hard(f.id(), "/g", f.id(), "/g/again", H5P_DEFAULT, H5P_DEFAULT); });
  const auto stored = [](const std::function<void(hid_t)>& set_up, hid_t type = H5T_IEEE_F64LE, hsize_t n = 8,
                         std::size_t n_values = 8) {
    return [=](const ForgedFile& f) {
      const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
      set_up(properties);
      f.replace("/g/x", std::vector<double>(n_values, 1.0), {n}, type, properties);
      H5Pclose(properties);
    };
  };
  const hsize_t four = 4;
  says("'/g/x' is chunked", stored([&](hid_t p) { H5Pset_chunk(p, 1, &four); }));
  says("'/g/x' is chunked", stored([&](hid_t p) {
    H5Pset_chunk(p, 1, &four);
    H5Pset_deflate(p, 9);
  }));
  says("'/g/x' is chunked", stored([](hid_t p) { H5Pset_layout(p, H5D_COMPACT); }));
  says("'/g/x' is chunked", stored([&](hid_t p) {
    H5Pset_external(p, (folder / "elsewhere").c_str(), 0, 64);
  }));
  says("'/g/x' is larger than the file", stored([](hid_t) {}, H5T_IEEE_F64LE, hsize_t{1} << 40, 0));
  says("'n' of '/g' is not a single value", [](auto& f) { f.replace_attribute("/g", "n", 3, 4096); });
  says("of a type that DIM never writes", [](const ForgedFile& f) {
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, H5T_VARIABLE);
    f.replace("/g/x", {}, {4}, text);
    H5Tclose(text);
  });
}

TEST_CASE("Damage in HDF5's own structures is refused in words", "[base][unit]") {
  const Folder folder;
  StoredRoom().save(folder);
  const std::string path = folder / "a.lum", good = files_test::contents(path);
  std::size_t n_blocks = 0;
  for (const std::string block : {"BTHD", "BTLF", "FRHP", "FHDB", "OHDR", "OCHK", "SNOD", "HEAP", "TREE"}) {
    for (std::size_t at = good.find(block, kHeader_bytes); at != std::string::npos; at = good.find(block, at + 4)) {
      ++n_blocks;
      for (const std::size_t byte : {std::size_t{0}, std::size_t{4}, std::size_t{8}, std::size_t{13}, std::size_t{20}}) {
        if (at + byte >= good.size()) continue;
        std::string bad = good;
        bad[at + byte] = static_cast<char>(bad[at + byte] ^ 0x15);
        files_test::put(path, bad);
        files_test::seal(path);
        CAPTURE(block, at, byte);
        try {
          load_lum(path, Job{});  // what is not damaged by it is read
        } catch (const IoError&) {
        } catch (const LimitError&) {
        }
      }
    }
  }
  CHECK(n_blocks > 10);
}
