#include <fcntl.h>
#include <sys/stat.h>

#include <random>

#include "base/hdf5_file.hpp"
#include "base/hdf5_file_header.hpp"
#include "base/version.hpp"
#include "catch.hpp"
#include "files_support.hpp"

using dim::Hdf5Reader;
using dim::Hdf5Writer;
using dim::kHeader_bytes;
using files_test::contents;
using files_test::Folder;
using files_test::io_error;
using files_test::put;
using files_test::start_child;
using files_test::wait_for;

namespace {

Hdf5Writer sample(const std::string& kind = "rays", int version = 1, std::size_t n_values = 50) {
  Hdf5Writer writer(kind, version);
  writer.dataset<double>("/x", std::vector<double>(n_values, 1.5), {n_values}, "m");
  return writer;
}

/// Why the file is refused, without its name; empty if it is not.
std::string refusal(const std::string& path, int max_version = 1) {
  const std::string message = io_error([&] { const Hdf5Reader reader(path, "rays", max_version); });
  const std::string name = path == "-" ? "standard input" : path;
  return message.empty() ? message : message.substr(name.size() + 2);
}

std::string refusal_of(const Folder& folder, std::string_view bytes) {
  put(folder / "x", bytes);
  return refusal(folder / "x");
}

/// Calls `use("-")` while `bytes` come down a pipe to standard input.
template <class Use>
void with_piped(const std::string& bytes, Use&& use) {
  files_test::Pipe pipe;
  const auto child = start_child([&] {
    std::signal(SIGPIPE, SIG_IGN);
    pipe.close_reader();
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t n = ::write(pipe.writer(), bytes.data() + at, bytes.size() - at);
      if (n <= 0) break;
      at += static_cast<std::size_t>(n);
    }
  });
  pipe.close_writer();
  {
    const files_test::Redirected in(STDIN_FILENO, pipe.reader());
    pipe.close_reader();
    use("-");
  }
  wait_for(child);
}

std::string piped_refusal(const std::string& bytes) {
  std::string message;
  with_piped(bytes, [&](const std::string& dash) { message = refusal(dash); });
  return message;
}

const std::string kExpected = "; expected a ray network (.rays)";

}  // namespace

TEST_CASE("Files that are not DIM's are refused with what they are", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "a.rays");
  const std::string good = contents(folder / "a.rays");
  CHECK(refusal(folder / "none") == "cannot read: No such file or directory");
  CHECK(refusal(folder.str()) == "is a directory");
  CHECK(refusal_of(folder, "") == "is empty" + kExpected);
  CHECK(refusal_of(folder, "dim = \"zone/1\"\nname = \"büro\"\n") == "is a text file" + kExpected);
  CHECK(refusal_of(folder, good.substr(kHeader_bytes)) == "is an HDF5 file of another program" + kExpected);
  CHECK(refusal_of(folder, std::string(kHeader_bytes, '\0') + good.substr(kHeader_bytes)) ==
        "is not a DIM file" + kExpected);
  std::mt19937 random(7);
  std::string noise(5000, '\0');
  for (char& c : noise) c = static_cast<char>(random());
  CHECK(refusal_of(folder, noise) == "is not a DIM file" + kExpected);
}

TEST_CASE("Another kind and a newer version are refused by name", "[base][unit]") {
  const Folder folder;
  sample("lum").write(folder / "lum");
  CHECK(refusal(folder / "lum") == "is a luminance database (.lum)" + kExpected + ", which dimdis makes");
  sample("sky-data").write(folder / "other");
  CHECK(refusal(folder / "other") == "is a DIM file of kind 'sky-data'" + kExpected + ", which dimdis makes");
  sample("rays", 3).write(folder / "new");
  CHECK(refusal(folder / "new", 2) == "written by DIM " + dim::version() +
                                          " in format 3, this program reads 1..2; use that version of DIM or a "
                                          "newer one");
  CHECK(refusal(folder / "new", 3).empty());
  CHECK(Hdf5Reader(folder / "new", "rays", 4).version() == 3);
  CHECK(io_error([&] { Hdf5Reader(folder / "new", "rays", 4, {}, 4); }) ==
        folder / "new" + ": written by DIM " + dim::version() +
            " in format 3, this program reads 4; make it again with this dimdis");
  // Files of the first versions do not say which it was.
  const auto header = dim::make_header({"lum", 1, 612, std::string(32, '0')});
  CHECK(io_error([&] { dim::parse_header("x", header, "lum", {2, 2}); }) ==
        "x: written in format 1, this program reads 2; make it again with this dimray");
}

TEST_CASE("A file cut short at any length is refused", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "x");
  const std::size_t n_bytes = contents(folder / "x").size();
  for (std::size_t n = n_bytes; n-- > 0;) {
    std::filesystem::resize_file(folder / "x", n);
    const std::string expected =
        n == 0 ? "is empty" + kExpected
        : n < kHeader_bytes
            ? "is cut short: holds " + std::to_string(n) + " of at least 512 bytes"
            : "is cut short: holds " + std::to_string(n) + " of " + std::to_string(n_bytes) + " bytes";
    const std::string found = refusal(folder / "x");
    if (found != expected) FAIL_CHECK(n << ": " << found);
  }
}

TEST_CASE("A file that goes on after its end is refused", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "x");
  const std::string good = contents(folder / "x");
  const std::string expected = "is altered: goes on after its " + std::to_string(good.size()) + " bytes";
  CHECK(refusal_of(folder, good + '\0') == expected);
  CHECK(piped_refusal(good + '\0') == expected);
}

TEST_CASE("A flipped bit anywhere in the header is refused", "[base][unit]") {
  const auto header = dim::make_header({"rays", 1, 123'456, std::string(32, 'a')});
  REQUIRE_NOTHROW(dim::parse_header("x", header, "rays", {1, 1}));
  for (std::size_t i = 0; i < header.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      auto changed = header;
      changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
      const auto message = io_error([&] { dim::parse_header("x", changed, "rays", {1, 1}); });
      if (message.empty()) FAIL_CHECK("byte " << i << " bit " << bit << " unnoticed");
    }
  }
}

TEST_CASE("A flipped byte anywhere in the file is refused", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "x");
  const std::string good = contents(folder / "x");
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string changed = good;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
    const std::string message = refusal_of(folder, changed);
    const bool as_expected =
        i < kHeader_bytes ? !message.empty()
                          : message == "is altered or damaged: its content does not match its checksum";
    if (!as_expected) FAIL_CHECK(i << ": " << message);
  }
}

TEST_CASE("A header whose seal fits but that lies about the length is refused", "[base][unit]") {
  const Folder folder;
  const auto header = dim::make_header({"rays", 1, std::uint64_t{1} << 60, std::string(32, '0')});
  const std::string start(header.begin(), header.end());
  const std::string expected = "is cut short: holds 612 of 1152921504606846976 bytes";
  CHECK(refusal_of(folder, start + std::string(100, 'x')) == expected);
  CHECK(piped_refusal(start + std::string(100, 'x')) == expected);
}

TEST_CASE("A content that disagrees with its header or is no HDF5 is refused", "[base][unit]") {
  const Folder folder;
  const auto sealed = [](const std::string& kind, int version, const std::string& body) {
    dim::BodyHash hash;
    hash.add(std::as_bytes(std::span(body)));
    const auto header = dim::make_header({kind, version, kHeader_bytes + body.size(), hash.hex()});
    return std::string(header.begin(), header.end()) + body;
  };
  sample("lum").write(folder / "lum");
  const std::string body = contents(folder / "lum").substr(kHeader_bytes);
  CHECK(refusal_of(folder, sealed("rays", 1, body)) ==
        "is altered: its header and its content say different formats");
  CHECK_THAT(refusal_of(folder, sealed("rays", 1, "rubbish")),
             Catch::Matchers::StartsWith("cannot be opened"));
  CHECK_THAT(piped_refusal(sealed("rays", 1, "rubbish")), Catch::Matchers::StartsWith("cannot be opened"));
}

TEST_CASE("The hash is the 128-bit XXH3 of the published specification", "[base][unit]") {
  // XXH3_128bits of no input with seed 0: xxHash's own test vectors (tests/sanity_test_vectors.h).
  CHECK(dim::BodyHash().hex() == "99aa06d3014798d86001c324468d497f");
}

TEST_CASE("A pipe is read like a file", "[base][unit]") {
  const Folder folder;
  // Longer than any pipe holds, and than the first memory asked for.
  const std::string hash = sample("rays", 1, 1'000'000).write(folder / "x");
  std::vector<double> values;
  with_piped(contents(folder / "x"), [&](const std::string& dash) {
    const Hdf5Reader reader(dash, "rays", 1);
    CHECK(reader.hash() == hash);
    values = reader.dataset<double>("/x", {dim::kAnySize});
  });
  CHECK(values == std::vector<double>(1'000'000, 1.5));
}

TEST_CASE("A pipe cut short or damaged is refused", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "x");
  const std::string good = contents(folder / "x");
  CHECK(piped_refusal("") == "is empty" + kExpected);
  CHECK(piped_refusal(good).empty());
  for (const std::size_t n : {std::size_t{1}, std::size_t{511}}) {
    CHECK(piped_refusal(good.substr(0, n)) ==
          "is cut short: holds " + std::to_string(n) + " of at least 512 bytes");
  }
  for (const std::size_t n : {std::size_t{512}, std::size_t{513}, good.size() - 1}) {
    CHECK(piped_refusal(good.substr(0, n)) ==
          "is cut short: holds " + std::to_string(n) + " of " + std::to_string(good.size()) + " bytes");
  }
  std::string changed = good;
  changed.back() ^= 1;
  CHECK(piped_refusal(changed) == "is altered or damaged: its content does not match its checksum");
}

TEST_CASE("A fifo and a redirected file work by name and as standard input", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "x");
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  const auto child = start_child([&] { sample().write(folder / "fifo"); });
  CHECK(refusal(folder / "fifo").empty());
  CHECK(wait_for(child) == 0);

  const int file = ::open((folder / "x").c_str(), O_RDONLY | O_CLOEXEC);
  {
    const files_test::Redirected in(STDIN_FILENO, file);
    CHECK(refusal("-").empty());
  }
  ::close(file);
}

TEST_CASE("A file replaced while it is open goes on being read as it was", "[base][unit]") {
  const Folder folder;
  sample().write(folder / "x");
  const Hdf5Reader before(folder / "x", "rays", 1);
  sample("rays", 1, 7).write(folder / "x");
  const Hdf5Reader after(folder / "x", "rays", 1);
  CHECK(before.dataset<double>("/x", {50}).size() == 50);
  CHECK(after.dataset<double>("/x", {7}).size() == 7);
}
