#include "transport/simulate.hpp"

#include <optional>

#include "transport/assembly.hpp"
#include "transport/daylight_columns.hpp"
#include "transport/direct_columns.hpp"
#include "transport/memory_check.hpp"
#include "transport/source_flights.hpp"

namespace dim {
namespace {

Gathered<float> inter_reflect(const Room& room, const ModelPlan& plan, const Shine& shine,
                              const DirectShine& direct_shine, const Assembly::DirectAsColumns& direct,
                              const SimulationOptions& options, const Job& job) {
  const Reflectances reflectances = diffuse_reflectances(room.zone, plan);
  const GatherShine gather_shine{shine, room.zone, direct_shine};
  const auto* shiny = shine.any() ? &gather_shine : nullptr;
  return options.solver == Solver::gather
             ? gather(room.network, room.cells, direct.cell, direct.point, reflectances, options.gather, job, shiny)
             : track(room.zone, room.network, room.cells, direct.cell, direct.point, reflectances, options.track,
                     job, shiny);
}

}  // namespace

Solution simulate(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
                  const SimulationOptions& options, const Job& job, Warnings& warnings) {
  const Room room(zone, cells, network, lights, job);
  ModelPlan plan = make_plan(room, options);
  std::optional<const DaylightSources> daylight;
  if (lights.sky) {
    daylight.emplace(room, plan, options, job);
    daylight->append_to(plan, warnings);
  }
  check_memory(room, plan, job);
  auto flights = source_flights(room, plan, job, warnings);

  const Shine shine(room.zone, room.cells, room.network, plan.classes, room.obstructions.caster(),
                    MirrorRayOptions{}, job);
  DirectColumns direct = direct_columns(room, plan, shine, {options.gather.tolerance, options.mirror_depth}, job);
  if (daylight) {
    daylight->add_to(direct, plan, job);
    daylight->add_flights(flights);
  }
  Assembly assembly(room, plan, shine, options.bands);
  auto columns = assembly.add_direct(direct);

  if (direct.add_followed()) columns.cell = Columns<float>::from_rows(direct.cell, direct.n_columns);
  auto gathered = inter_reflect(room, plan, shine, direct.shine, columns, options, job);
  assembly.add_total(std::move(gathered), direct, flights, daylight ? &*daylight : nullptr);
  return assembly.finish();
}

}  // namespace dim
