#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "import/json_node.hpp"

namespace dim {

/// The numbers that a glTF file's accessors lead to.
class GltfBuffers {
 public:
  /// @param binary  the binary chunk of a .glb, else empty; must outlive this
  /// @throws InputError  a buffer that is not there, or shorter than stated
  GltfBuffers(const JsonNode& root, std::string_view binary, const ImportInput& input);

  /// @throws InputError  an accessor of another type, or one that reaches beyond its buffer
  std::vector<Vec3> positions(std::size_t accessor) const;
  std::vector<std::uint32_t> indices(std::size_t accessor) const;

 private:
  struct Numbers {
    const char* first = nullptr;
    std::size_t n = 0, stride = 0;
    int component = 0;
    bool normalized = false;
  };
  Numbers numbers(std::size_t accessor, const char* type, std::size_t n_components) const;

  JsonNode root_;
  std::vector<std::string> owned_;
  std::vector<std::string_view> buffers_;
};

}  // namespace dim
