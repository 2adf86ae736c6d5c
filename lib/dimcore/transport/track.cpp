#include "transport/track.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "network/row_parts.hpp"
#include "transport/contraction.hpp"

namespace dim {
namespace {

// One column being tracked.
class Tracker {
 public:
  template <class Direct>
  Tracker(const Zone& zone, const Network& network, const Cells& cells, const Direct& direct,
          const Reflectances& reflectances, std::size_t column, const GatherShine* shine)
      : zone_(zone),
        network_(network),
        cells_(cells),
        reflectances_(reflectances),
        shine_(shine ? &shine->shine : nullptr),
        class_(reflectances.class_of_column[column]),
        received_(cells.size(), 0.0),
        pending_(cells.size(), 0.0),
        on_stack_(cells.size(), false) {
    if (shine_) {
      tint_.resize(shine_->links().n_classes);
      coming_.assign(shine_->n_states(), 0.0);
      going_.assign(shine_->n_states(), 0.0);
      psi_.assign(shine_->n_states(), 0.0);
      for (std::size_t s = 0; s < going_.size(); ++s)
        going_[s] = static_cast<double>(shine->direct.psi[s * reflectances.n_columns() + column]) *
                    cells.area_m2(shine_->off_specular()[s / n_patches()]);
      for (std::size_t g = 0; g < shine_->n_off_specular(); ++g) {
        const auto& albedo = shine_->slice_albedo(class_, finish(shine_->off_specular()[g]));
        largest_albedo_.push_back(*std::max_element(albedo.begin(), albedo.end()));
        const auto begin = going_.begin() + static_cast<std::ptrdiff_t>(g * n_patches());
        going_sum_.push_back(std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(n_patches()), 0.0));
      }
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      received_[i] = pending_[i] = cells.area_m2(i) * static_cast<double>(direct[i]);
      source_flux_ += received_[i];
    }
  }

  void run(double threshold, const Job& job) {
    least_ = threshold * source_flux_;
    for (std::size_t i = 0; i < cells_.size(); ++i) consider(i);
    while (!stack_.empty()) {
      if (++n_sent_ % 1024 == 0) job.check();
      const std::size_t cell = stack_.back();
      stack_.pop_back();
      on_stack_[cell] = false;
      send(cell);
    }
  }

  ColumnReport report() const {
    ColumnReport report;
    report.iterations = static_cast<int>(n_sent_ / 1000);
    report.received = source_flux_;
    report.escaped = escaped_;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      report.absorbed += received_[i] * (1.0 - rho(i));
      report.dropped += unsent(i);
    }
    report.absorbed -= mirrored_ + lobed_;
    report.dropped += cut_;
    report.residual = source_flux_ > 0.0 ? report.dropped / source_flux_ : 0.0;
    add_bound(report);
    return report;
  }

  // What was dropped would have arrived, and been sent on, no more than a geometric series of its flux.
  void add_bound(ColumnReport& report) const {
    double share = 0.0, landing = 1.0, flux = 0.0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const SentOn sent_on = most_sent_on(cells_.surface_of(i), rho(i), shine_, zone_, class_);
      share = std::max(share, sent_on.share);
      landing = std::max(landing, sent_on.landing);
      flux += received_[i];
    }
    if (report.dropped > 0.0)
      report.error_bound =
          share < 1.0 ? report.dropped * landing / (flux * (1.0 - share)) : std::numeric_limits<double>::infinity();
    report.local_error_bound = report.dropped > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
  }

  double irradiance(std::size_t cell) const { return received_[cell] / cells_.area_m2(cell); }
  double psi(std::size_t state) const {
    return psi_[state] / cells_.area_m2(shine_->off_specular()[state / n_patches()]);
  }

 private:
  std::size_t n_patches() const { return shine_->grid().n_patches(); }
  int finish(std::size_t cell) const { return zone_.surfaces[cells_.surface_of(cell)].finish; }
  double rho(std::size_t cell) const {
    return reflectances_.of_surface[cells_.surface_of(cell) * reflectances_.n_classes + class_];
  }
  bool has_lobe(std::size_t cell) const { return shine_ && shine_->index_of(cell) >= 0; }
  std::size_t first_state(std::size_t cell) const {
    return static_cast<std::size_t>(shine_->index_of(cell)) * n_patches();
  }

  // What a cell has yet to send.
  double unsent(std::size_t cell) const {
    double sum = rho(cell) * pending_[cell];
    if (!has_lobe(cell)) return sum;
    const auto& albedo = shine_->slice_albedo(class_, finish(cell));
    const auto n_sectors = static_cast<std::size_t>(shine_->grid().n_sectors);
    for (std::size_t p = 0; p < n_patches(); ++p)
      sum += going_[first_state(cell) + p] + coming_[first_state(cell) + p] * albedo[p / n_sectors];
    return sum;
  }

  void consider(std::size_t cell) {
    double most = rho(cell) * pending_[cell];
    if (has_lobe(cell)) {
      const auto g = static_cast<std::size_t>(shine_->index_of(cell));
      most += largest_albedo_[g] * pending_[cell] + going_sum_[g];
    }
    if (on_stack_[cell] || !(most > least_)) return;
    on_stack_[cell] = true;
    stack_.push_back(cell);
  }

  void land(std::size_t cell, double flux, std::size_t patch_in) {
    received_[cell] += flux;
    pending_[cell] += flux;
    if (has_lobe(cell)) coming_[first_state(cell) + patch_in] += flux;
    consider(cell);
  }

  void send(std::size_t cell) {
    const double diffuse = rho(cell) * std::exchange(pending_[cell], 0.0);
    if (shine_)
      send_shining(cell, diffuse);
    else
      send_diffuse(cell, diffuse);
  }

  void send_diffuse(std::size_t cell, double flux) {
    const auto& patches = network_.patches;
    const auto n_sectors = static_cast<std::size_t>(patches.n_sectors);
    for (std::size_t patch = 0; patch < patches.n_patches() && flux > 0.0; ++patch) {
      const double part = flux * patches.weight_sr(static_cast<int>(patch / n_sectors)) / kPi;
      const std::size_t sink = network_.sinks.at(cell, patch);
      if (sink < cells_.size())
        land(sink, part, 0);
      else
        escaped_ += part;
    }
    if (!network_.has_family()) return;
    for (auto e = network_.extra.first[cell]; e < network_.extra.first[cell + 1]; ++e)
      land(network_.extra.cell[e], flux * network_.extra.weight[e], 0);
  }

  void send_shining(std::size_t cell, double diffuse) {
    const std::vector<double> lobe = has_lobe(cell) ? take_lobe(cell) : std::vector<double>();
    const auto n_sectors = static_cast<std::size_t>(network_.patches.n_sectors);
    const RowParts row(zone_, cells_, network_, cell);
    for (const auto& part : row.parts()) {
      double flux = diffuse * part.share;
      if (!lobe.empty()) {
        const double w = network_.patches.weight_sr(static_cast<int>(part.patch / n_sectors)) / kPi;
        const auto& states = shine_->states();
        flux += lobe[states.patch_of(part.patch)] * states.share_of(part.patch) * part.share / w;
      }
      if (!(flux > 0.0)) continue;
      if (part.cell >= cells_.size()) {
        escaped_ += flux;
        continue;
      }
      const bool shines = shine_->of_cell(part.cell) != Shininess::diffusing;
      const Ray ray = shines ? row.ray(part) : Ray{};
      land(part.cell, flux, shines ? shine_->states().patch_in(part.cell, ray.direction) : 0);
      if (shine_->of_cell(part.cell) == Shininess::mirror) go_on(ray, part.cell, flux);
    }
  }

  // A ray that came down on a mirror: each further landing is given its tint's part of the flux.
  void go_on(const Ray& ray, std::size_t mirror, double flux) {
    std::fill(tint_.begin(), tint_.end(), 1.0);
    const auto end = shine_->mirror_rays().follow(
        ray, cells_.surface_of(mirror), tint_, [&](std::size_t cell, const Vec3& direction) {
          mirrored_ += flux * tint_[class_];
          land(cell, flux * tint_[class_], shine_->states().patch_in(cell, direction));
        });
    if (end == MirrorRays::End::landed) return;
    mirrored_ += flux * tint_[class_];
    (end == MirrorRays::End::cut ? cut_ : escaped_) += flux * tint_[class_];
  }

  // All flux that the cell's lobe has yet to send, by patch.
  std::vector<double> take_lobe(std::size_t cell) {
    const std::size_t first = first_state(cell), n = n_patches();
    const auto n_sectors = static_cast<std::size_t>(shine_->grid().n_sectors);
    const auto begin = going_.begin() + static_cast<std::ptrdiff_t>(first);
    std::vector<double> out(begin, begin + static_cast<std::ptrdiff_t>(n));
    std::fill_n(begin, n, 0.0);
    going_sum_[first / n] = 0.0;
    const LobeMatrix& lobe = shine_->lobe(class_, finish(cell));
    for (std::size_t p = 0; p < n; ++p) {
      const double flux = std::exchange(coming_[first + p], 0.0);
      if (flux == 0.0) continue;
      const int slice = static_cast<int>(p / n_sectors);
      for (const auto* entry = lobe.begin(slice); entry != lobe.end(slice); ++entry)
        out[entry->slice_out * n_sectors + (p % n_sectors + entry->turn) % n_sectors] += entry->share * flux;
    }
    for (std::size_t p = 0; p < n; ++p) {
      psi_[first + p] += out[p];
      lobed_ += out[p];
    }
    return out;
  }

  const Zone& zone_;
  const Network& network_;
  const Cells& cells_;
  const Reflectances& reflectances_;
  const Shine* shine_;
  std::size_t class_;
  std::vector<double> received_, pending_;  // flux
  std::vector<double> coming_, going_,
      psi_;  // [n_states] flux: to be reflected, reflected and to be sent, sent
  std::vector<double> going_sum_, largest_albedo_;  // [n_off_specular]
  std::vector<bool> on_stack_;
  std::vector<std::size_t> stack_;
  std::vector<double> tint_;  // [n_classes] of a ray that is being followed
  double source_flux_ = 0.0, least_ = 0.0, escaped_ = 0.0, mirrored_ = 0.0, lobed_ = 0.0, cut_ = 0.0;
  std::size_t n_sent_ = 0;
};

}  // namespace

template <class Real>
Gathered<Real> track(const Zone& zone, const Network& network, const Cells& cells, const Columns<Real>& direct,
                     const Columns<Real>& point_direct, const Reflectances& reflectances,
                     const TrackOptions& options, const Job& job, const GatherShine* shine) {
  const std::size_t n_columns = reflectances.n_columns();
  Gathered<Real> result;
  result.cell = Columns<Real>(cells.size(), n_columns);
  result.columns.resize(n_columns);
  if (shine) result.psi.resize(shine->shine.n_states() * n_columns);
  tbb::parallel_for(std::size_t{0}, n_columns, [&](std::size_t c) {
    Tracker tracker(zone, network, cells, direct.column(c % direct.n_columns()), reflectances, c, shine);
    tracker.run(options.threshold, job);
    result.columns[c] = tracker.report();
    const auto column = result.cell.column(c);
    for (std::size_t i = 0; i < cells.size(); ++i) column[i] = static_cast<Real>(tracker.irradiance(i));
    for (std::size_t s = 0; s * n_columns < result.psi.size(); ++s)
      result.psi[s * n_columns + c] = static_cast<float>(tracker.psi(s));
  });
  result.point = gather_points(network, cells, result.cell, result.psi, point_direct, reflectances, shine);
  return result;
}

template Gathered<float> track(const Zone&, const Network&, const Cells&, const Columns<float>&,
                               const Columns<float>&, const Reflectances&, const TrackOptions&, const Job&,
                               const GatherShine*);
template Gathered<double> track(const Zone&, const Network&, const Cells&, const Columns<double>&,
                                const Columns<double>&, const Reflectances&, const TrackOptions&, const Job&,
                                const GatherShine*);

}  // namespace dim
