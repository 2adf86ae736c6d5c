// EULUMDAT: as fuzz_ies.
#include "fuzz/photometry_check.hpp"
#include "photometry/eulumdat.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  dim::check_reading([&](dim::Warnings& warnings) { return dim::read_eulumdat(bytes, "fuzz.ldt", warnings); });
  return 0;
}
