// LM-63: any bytes are read or refused with InputError; what is read has a finite flux and is written and
// read again with the same.
#include "fuzz/photometry_check.hpp"
#include "photometry/ies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  dim::check_reading([&](dim::Warnings& warnings) {
    return dim::read_ies(bytes, "fuzz.ies", warnings, [](const std::string&) { return "1\n2\n0 90\n1 0.9\n"; });
  });
  return 0;
}
