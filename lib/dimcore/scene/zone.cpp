#include "scene/zone.hpp"

namespace dim {

const View& find_view(const Zone& zone, const std::string& name) {
  if (zone.views.empty())
    throw InputError({{}, "zone '" + zone.name + "' has no [[view]]", "add one to the zone file"});
  if (name.empty()) return zone.views.front();
  std::vector<std::string> names;
  for (const auto& view : zone.views) {
    if (view.name == name) return view;
    names.push_back(view.name);
  }
  throw InputError({{}, "no view '" + name + "' in zone '" + zone.name + "'", did_you_mean(name, names)});
}

}  // namespace dim
