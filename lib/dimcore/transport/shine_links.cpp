#include "transport/shine_links.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "network/row_parts.hpp"

namespace dim {
namespace {

using Links = ShineLinks;
constexpr std::size_t kRowsAtOnce = 512;  // whose links exist twice while they are put in order

// A lobe's link on its way to the receiver's row.
struct Sent {
  std::uint32_t receiver;
  Links::Lobe link;
};

// What one row found.
struct Found {
  std::vector<Links::Mirror> mirror;
  std::vector<float> mirror_tint;
  std::vector<Sent> lobe, lobe_by_mirror;
  std::vector<float> lobe_tint;
  std::vector<Links::LobeLoss> lobe_loss;
  std::vector<float> lobe_loss_tint;
  std::vector<double> escaped, cut;  // [n_classes] of a receiver's hemisphere
};

void append_tint(std::vector<float>& tints, std::span<const double> tint) {
  for (const double t : tint) tints.push_back(static_cast<float>(t));
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

class Linker {
 public:
  Linker(const Zone& zone, const Cells& cells, const Network& network, std::size_t n_classes,
         const std::vector<Shininess>& of_surface, const LobeStates& states, const MirrorRays& mirrors)
      : zone_(zone),
        cells_(cells),
        network_(network),
        of_surface_(of_surface),
        states_(states),
        mirrors_(mirrors),
        n_cells_(cells.size()),
        n_classes_(n_classes) {}

  Links build(const Job& job) {
    const bool any_mirror = std::count(of_surface_.begin(), of_surface_.end(), Shininess::mirror) > 0;
    links_.n_classes = n_classes_;
    links_.cut_off.assign(n_classes_, 0.0);
    links_.passed.assign(n_cells_ * n_classes_, {});
    in_chunks(
        states_.cells_with_lobe().size(), job, [&](Found& found, std::size_t g) { send_lobe(found, g); },
        [&](const Found& found, std::size_t) { keep_lobe(found); });
    // Without mirrors, only points look for anything.
    const std::size_t n_receivers = n_cells_ + zone_.points.size(), first = any_mirror ? 0 : n_cells_;
    links_.mirror_first.assign(first + 1, 0);
    in_chunks(
        n_receivers - first, job, [&](Found& found, std::size_t row) { look(found, first + row); },
        [&](const Found& found, std::size_t row) { keep_seen(found, first + row); });
    for (double& cut : links_.cut_off) cut /= static_cast<double>(n_receivers);
    sort_by_receiver(sent_, nullptr, n_receivers, links_.lobe_first, links_.lobe);
    sort_by_receiver(sent_by_mirror_, &links_.lobe_tint, n_receivers, links_.lobe_by_mirror_first,
                     links_.lobe_by_mirror);
    scale_mirrors();
    add_families();
    return std::move(links_);
  }

 private:
  Shininess kind(std::size_t cell) const { return of_surface_[cells_.surface_of(cell)]; }

  // Rows in parallel, then kept one by one in their order.
  template <class Make, class Keep>
  void in_chunks(std::size_t n, const Job& job, Make&& make, Keep&& keep) {
    for (std::size_t first = 0; first < n; first += kRowsAtOnce) {
      std::vector<Found> found(std::min(kRowsAtOnce, n - first));
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, found.size(), 16), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end() && !job.stopped(); ++i)
          make(found[i], first + i);
      });
      job.check();
      for (std::size_t i = 0; i < found.size(); ++i) keep(found[i], first + i);
    }
  }

  // Down the rays of an off-specular cell.
  void send_lobe(Found& found, std::size_t g) const {
    const std::size_t source = states_.cells_with_lobe()[g];
    const auto n_sectors = static_cast<std::size_t>(network_.patches.n_sectors);
    const RowParts row(zone_, cells_, network_, source);
    std::vector<double> tint(n_classes_);
    for (const auto& part : row.parts()) {
      if (part.cell >= n_cells_) continue;
      const auto state = static_cast<std::uint32_t>(g * states_.n_patches() + states_.patch_of(part.patch));
      const double of_patch =
          part.share * kPi / network_.patches.weight_sr(static_cast<int>(part.patch / n_sectors));
      const double sent_m2 = states_.share_of(part.patch) * of_patch * cells_.area_m2(source);
      const auto arrival = [&](std::size_t cell, std::uint16_t patch_in) {
        const auto weight = static_cast<float>(sent_m2 / cells_.area_m2(cell));
        return Sent{static_cast<std::uint32_t>(cell), {state, weight, patch_in}};
      };
      if (kind(part.cell) == Shininess::diffusing) {
        found.lobe.push_back(arrival(part.cell, 0));
        continue;
      }
      const Ray ray = row.ray(part);
      found.lobe.push_back(arrival(part.cell, states_.patch_in(part.cell, ray.direction)));
      if (kind(part.cell) != Shininess::mirror) continue;
      std::fill(tint.begin(), tint.end(), 1.0);
      const auto end = mirrors_.follow(
          ray, cells_.surface_of(part.cell), tint, [&](std::size_t cell, const Vec3& direction) {
            found.lobe_by_mirror.push_back(arrival(cell, states_.patch_in(cell, direction)));
            append_tint(found.lobe_tint, tint);
          });
      if (end == MirrorRays::End::landed) continue;
      found.lobe_loss.push_back({state, static_cast<float>(sent_m2), end == MirrorRays::End::escaped});
      append_tint(found.lobe_loss_tint, tint);
    }
  }

  // Along the rays of a receiver: into mirrors, and from points into lobes.
  void look(Found& found, std::size_t receiver) const {
    const bool is_point = receiver >= n_cells_;
    const RowParts row = is_point ? RowParts(zone_, network_, receiver - n_cells_)
                                  : RowParts(zone_, cells_, network_, receiver);
    found.escaped.assign(n_classes_, 0.0);
    found.cut.assign(n_classes_, 0.0);
    std::vector<double> tint(n_classes_);
    for (const auto& part : row.parts()) {
      if (part.cell >= n_cells_) continue;
      const Shininess kind_seen = kind(part.cell);
      if (kind_seen == Shininess::diffusing) continue;
      const Ray ray = row.ray(part);
      if (kind_seen == Shininess::off_specular) {
        if (is_point) found.lobe.push_back(lobe_seen(receiver, part, part.cell, ray.direction));
        continue;
      }
      std::fill(tint.begin(), tint.end(), 1.0);
      const auto end = mirrors_.follow(
          ray, cells_.surface_of(part.cell), tint, [&](std::size_t cell, const Vec3& direction) {
            found.mirror.push_back({static_cast<std::uint32_t>(cell), static_cast<float>(part.share),
                                    is_point ? std::uint16_t{0} : states_.patch_of(part.patch)});
            append_tint(found.mirror_tint, tint);
            if (!is_point || kind(cell) != Shininess::off_specular) return;
            found.lobe_by_mirror.push_back(lobe_seen(receiver, part, cell, direction));
            append_tint(found.lobe_tint, tint);
          });
      if (end == MirrorRays::End::landed) continue;
      auto& lost = end == MirrorRays::End::cut ? found.cut : found.escaped;
      for (std::size_t q = 0; q < n_classes_; ++q) lost[q] += part.share * tint[q];
    }
  }

  Sent lobe_seen(std::size_t receiver, const RowParts::Part& part, std::size_t cell,
                 const Vec3& direction) const {
    const auto state = states_.state_towards(cell, direction);
    const double weight = part.share * kPi / states_.grid().weight_sr(states_.slice_of_state(state));
    return {static_cast<std::uint32_t>(receiver), {state, static_cast<float>(weight), 0}};
  }

  void keep_lobe(const Found& found) {
    append(sent_, found.lobe);
    append(sent_by_mirror_, found.lobe_by_mirror);
    append(links_.lobe_tint, found.lobe_tint);
    append(links_.lobe_loss, found.lobe_loss);
    append(links_.lobe_loss_tint, found.lobe_loss_tint);
  }

  void keep_seen(const Found& found, std::size_t receiver) {
    keep_lobe(found);
    append(links_.mirror, found.mirror);
    append(links_.mirror_tint, found.mirror_tint);
    links_.mirror_first.push_back(links_.mirror.size());
    for (std::size_t q = 0; q < n_classes_; ++q) {
      links_.cut_off[q] += found.cut[q];
      if (receiver >= n_cells_) continue;
      auto& passed = links_.passed[receiver * n_classes_ + q];
      passed.escaped = found.escaped[q];
      passed.cut = found.cut[q];
      for (std::size_t l = 0; l < found.mirror.size(); ++l)
        passed.landed += static_cast<double>(found.mirror[l].share) *
                         static_cast<double>(found.mirror_tint[l * n_classes_ + q]);
    }
  }

  // Stable: the links of a receiver stay in the order in which they were sent.
  void sort_by_receiver(std::vector<Sent>& sent, std::vector<float>* tints, std::size_t n_receivers,
                        std::vector<std::uint64_t>& first, std::vector<Links::Lobe>& sorted) const {
    first.assign(n_receivers + 1, 0);
    for (const auto& s : sent) ++first[s.receiver + 1];
    for (std::size_t i = 0; i < n_receivers; ++i) first[i + 1] += first[i];
    auto next = first;
    sorted.resize(sent.size());
    std::vector<float> sorted_tints(tints ? tints->size() : 0);
    for (std::size_t l = 0; l < sent.size(); ++l) {
      const auto to = next[sent[l].receiver]++;
      sorted[to] = sent[l].link;
      if (tints) std::copy_n(&(*tints)[l * n_classes_], n_classes_, &sorted_tints[to * n_classes_]);
    }
    if (tints) *tints = std::move(sorted_tints);
    sent = {};
  }

  // See ShineLinks: what all receivers see of a cell in mirrors is made what its own rays send there. A cell
  // that sends but that nobody sees is cut off.
  void scale_mirrors() {
    links_.mirror_scale.assign(n_cells_ * n_classes_, 0.0);
    if (links_.mirror.empty()) return;
    auto& seen_m2 = links_.mirror_scale;
    for (std::size_t i = 0; i < n_cells_; ++i) {
      const double area_m2 = cells_.area_m2(i) * network_.row_scale[i];
      for (auto l = links_.mirror_first[i]; l < links_.mirror_first[i + 1]; ++l) {
        for (std::size_t q = 0; q < n_classes_; ++q)
          seen_m2[links_.mirror[l].cell * n_classes_ + q] +=
              area_m2 * static_cast<double>(links_.mirror[l].share) *
              static_cast<double>(links_.mirror_tint[l * n_classes_ + q]);
      }
    }
    for (std::size_t j = 0; j < n_cells_; ++j) {
      for (std::size_t q = 0; q < n_classes_; ++q) {
        auto& scale = links_.mirror_scale[j * n_classes_ + q];
        auto& passed = links_.passed[j * n_classes_ + q];
        if (scale > 0.0) {
          scale = cells_.area_m2(j) * passed.landed / (scale * network_.column_scale[j]);
        } else {
          passed.cut += passed.landed;
          passed.landed = 0.0;
        }
      }
    }
  }

  void add_families() {
    if (!network_.has_family()) return;
    links_.family_first.assign(1, 0);
    for (const auto cell : states_.cells_with_lobe()) {
      for (const auto& link : family_links(zone_, cells_, network_, cell))
        links_.family_patch.push_back(states_.patch_of(link.patch));
      links_.family_first.push_back(links_.family_patch.size());
    }
  }

  const Zone& zone_;
  const Cells& cells_;
  const Network& network_;
  const std::vector<Shininess>& of_surface_;
  const LobeStates& states_;
  const MirrorRays& mirrors_;
  std::size_t n_cells_, n_classes_;
  Links links_;
  std::vector<Sent> sent_, sent_by_mirror_;  // by sender
};

}  // namespace

ShineLinks link_shine(const Zone& zone, const Cells& cells, const Network& network, std::size_t n_classes,
                      const std::vector<Shininess>& of_surface, const LobeStates& states,
                      const MirrorRays& mirrors, const Job& job) {
  return Linker(zone, cells, network, n_classes, of_surface, states, mirrors).build(job);
}

}  // namespace dim
