#pragma once

#include "base/vec.hpp"

namespace dim {

struct Ray {
  Vec3 from{0.0};
  Vec3 direction{0, 0, 1};  ///< unit
};

}  // namespace dim
