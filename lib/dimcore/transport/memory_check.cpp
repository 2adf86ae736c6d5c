#include "transport/memory_check.hpp"

#include <fmt/format.h>

#include "transport/shine_memory.hpp"

namespace dim {
namespace {

constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
constexpr std::size_t kBlockBytes = 32 * 4 * sizeof(double);  // a block of columns being solved

void check_rows(const Room& room, const ModelPlan& plan, const Job& job) {
  const std::size_t n_rows = room.cells.size() + room.n_points();
  const std::size_t needed =
      n_rows * (plan.n_columns() * (3 * sizeof(double) + 2 * sizeof(float)) + kBlockBytes);
  if (needed > job.memory_limit_bytes)
    throw LimitError(
        fmt::format("{} cells and points x {} sources x {} bands need {:.2f} GiB, {:.2f} GiB are free; use "
                    "--combine group, fewer --bands or a larger --cell",
                    n_rows, plan.n_sources(), plan.classes.of_band.size(), static_cast<double>(needed) / kGiB,
                    static_cast<double>(job.memory_limit_bytes) / kGiB));
}

void check_shine(const Room& room, const ModelPlan& plan, const Job& job) {
  const ShineMemory memory = shine_memory(room.zone, room.cells, room.network, plan.classes,
                                          room.obstructions.caster(), MirrorRayOptions{}, plan.n_columns());
  if (memory.total() > job.memory_limit_bytes)
    throw LimitError(fmt::format(
        "light by direction of {} off-specular cells x {} patches, and rays by mirrors, need {:.2f} GiB, {:.2f} "
        "GiB are free; use --combine group, fewer --bands, a larger --cell or fewer --patches",
        memory.n_off_specular, memory.n_patches, static_cast<double>(memory.total()) / kGiB,
        static_cast<double>(job.memory_limit_bytes) / kGiB));
}

}  // namespace

void check_memory(const Room& room, const ModelPlan& plan, const Job& job) {
  check_rows(room, plan, job);
  check_shine(room, plan, job);
}

}  // namespace dim
