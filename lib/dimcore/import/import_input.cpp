#include "import/import_input.hpp"

#include <fmt/format.h>

#include "base/input_file.hpp"

namespace dim {

void Unknowns::add(const std::string& what, const Place& place, const std::string& cure) {
  const auto [found, is_new] = index_.emplace(what, entries_.size());
  if (is_new) entries_.push_back({what, cure, place, 0});
  ++entries_[found->second].n;
}

void Unknowns::tell(Warnings& warnings) const {
  for (const Entry& entry : entries_)
    warnings.push_back({entry.place,
                        entry.n == 1 ? entry.what : fmt::format("{} ({} times)", entry.what, entry.n),
                        entry.cure});
}

int MaterialIndex::operator()(const std::string& name) {
  const auto [found, is_new] = index_.emplace(name, 0);
  if (is_new) found->second = material_named(model_, name);
  return found->second;
}

int material_named(ImportedModel& model, const std::string& name) {
  for (std::size_t i = 0; i < model.materials.size(); ++i)
    if (model.materials[i].name == name) return static_cast<int>(i);
  ImportedMaterial material;
  material.name = name;
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

std::size_t import_memory_bytes(std::size_t n_faces, std::size_t n_corners) {
  return 550 * n_faces + 250 * n_corners;
}

void FaceCounter::add(std::size_t n_corners) {
  ++n_faces_;
  n_corners_ += n_corners;
  if (n_faces_ > kMaxImportedFaces || n_corners_ > kMaxImportedCorners)
    throw LimitError(
        fmt::format("{}: more than {} faces or {} corners\n        import a part of the model, or one "
                    "with fewer details",
                    input_.name, kMaxImportedFaces, kMaxImportedCorners));
  if (n_faces_ % 4096 != 0) return;
  input_.job.check();
  const std::size_t needed = import_memory_bytes(n_faces_, n_corners_);
  if (needed > input_.job.memory_limit_bytes)
    throw LimitError(fmt::format(
        "{}: {} faces and more need over {}, {} can be had\n        import a part of the "
        "model, or one with fewer details",
        input_.name, n_faces_, size_in_words(needed), size_in_words(input_.job.memory_limit_bytes)));
}

}  // namespace dim
