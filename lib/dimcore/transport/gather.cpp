#include "transport/gather.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "transport/cell_smoothing.hpp"
#include "transport/conjugate_residuals.hpp"
#include "transport/contraction.hpp"
#include "transport/gather_kernel.hpp"

namespace dim {
namespace {

// The cycle ends a little below what is asked for, so that the true residual is there as well.
constexpr double kCycleGoal = 0.5;
// With lobes, what a cycle reaches is overtaken by the next change of the lobes.
constexpr double kCycleGainWithLobes = 0.1;
// A cycle that leaves more of the residual than this has gained nothing.
constexpr double kNoGain = 0.9;
// Of what twice as large cells change, the share that the cells' own size is taken to have done; and reflections
// that this change is followed through.
constexpr double kOfTwiceTheSize = 0.5;
constexpr int kChangeReflections = 1;

// What all blocks of columns have in common.
template <class Real>
struct Setting {
  const Network& network;
  const Cells& cells;
  const Columns<Real>& direct;
  const Columns<Real>& point_direct;
  const Reflectances& reflectances;
  const GatherShine* shine;
  Contraction contraction;
  std::vector<double> lost_m2;
  std::optional<CellSmoothing> smoothing;  // nothing where the cells' size is not corrected
};

// The columns [first, first + n) of the setting.
template <class Real>
class Block {
 public:
  Block(const Setting<Real>& setting, std::size_t first, std::size_t n, Gathered<Real>& result)
      : setting_(setting),
        cells_(setting.cells),
        first_(first),
        n_(n),
        result_(result),
        propagation_(setting.network, setting.cells, setting.reflectances, first, n, setting.shine),
        width_(propagation_.width()),
        sums_(propagation_.sums()),
        cycle_(propagation_),
        irradiance_(setting.cells.size() * width_, 0.0),
        columns_(width_) {
    for (std::size_t c = 0; c < width_; ++c) {
      columns_[c].stage = c < n ? Stage::open : Stage::finished;
      // Padding repeats the last column and is never looked at.
      columns_[c].direct = setting.direct.column((first + std::min(c, n - 1)) % setting.direct.n_columns());
    }
    sums_.each([&](std::size_t i) {
      for (std::size_t c = 0; c < n_; ++c) irradiance_[i * width_ + c] = direct(i, c);
    });
  }

  void solve(const GatherOptions& options, const Job& job) {
    while (any(Stage::open)) {
      job.check();
      propagation_.reflect(irradiance_, residual_);
      count(1);
      take_residual();
      for (auto& column : columns_) judge(column, options);
      improve(options);
      std::vector<double> lobes(width_, 0.0);
      if (auto* shine = propagation_.shine()) lobes = shine->reflect(propagation_.emit(irradiance_));
      if (any(Stage::finishing)) finish(lobes);
    }
    if (setting_.smoothing) correct_cell_size();
    if (!setting_.shine || setting_.smoothing) copy_points();
    compare_rays();
  }

 private:
  enum class Stage { open, finishing, finished };
  struct Column {
    Stage stage = Stage::open;
    typename Columns<Real>::ConstStrided direct{};
    int sweeps = 0;
    double mean = 0.0;                                       // irradiance of lit cells
    double local = std::numeric_limits<double>::infinity();  // largest residual over a cell's own irradiance
    bool plain = false;                                      // conjugate residuals do not help
  };

  bool any(Stage stage) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.stage == stage; });
  }
  bool finishing(std::size_t c) const { return columns_[c].stage == Stage::finishing; }
  double direct(std::size_t i, std::size_t c) const { return static_cast<double>(columns_[c].direct[i]); }
  bool reflects(std::size_t i, std::size_t c) const { return propagation_.reflectance(i)[c] > 0.0; }

  void count(int reflections) {
    const auto n = static_cast<std::uint64_t>(reflections);
    result_.counts.reflections += n;
    result_.counts.link_columns += n * setting_.network.sinks.n_rays() * n_;
  }

  // Turns what arrives into what the irradiances are short of, and measures it.
  void take_residual() {
    const auto sums = sums_.template add<double>(2, [&](std::size_t first, std::size_t last, double* into) {
      for (std::size_t i = first; i < last; ++i) {
        const double area_m2 = propagation_.area_m2(i);
        for (std::size_t c = 0; c < width_; ++c) {
          const std::size_t at = i * width_ + c;
          residual_[at] += direct(i, c) - irradiance_[at];
          const double next = irradiance_[at] + residual_[at];
          into[c] += next > 0.0 ? area_m2 * next : 0.0;
          into[width_ + c] += next > 0.0 ? area_m2 : 0.0;
        }
      }
    });
    std::vector<double> floor(width_);
    for (std::size_t c = 0; c < width_; ++c) {
      const double mean = sums[width_ + c] > 0.0 ? sums[c] / sums[width_ + c] : 0.0;
      if (columns_[c].stage != Stage::finished) columns_[c].mean = mean;
      floor[c] = std::max(kIrradianceFloor * mean, std::numeric_limits<double>::min());
    }
    const auto local =
        sums_.template largest<double>(1, [&](std::size_t first, std::size_t last, double* into) {
          for (std::size_t i = first; i < last; ++i) {
            const double* rho = propagation_.reflectance(i);
            for (std::size_t c = 0; c < width_; ++c) {
              const std::size_t at = i * width_ + c;
              const double next = std::max(irradiance_[at] + residual_[at], floor[c]);
              if (rho[c] > 0.0) into[c] = std::max(into[c], std::abs(residual_[at]) / next);
            }
          }
        });
    for (std::size_t c = 0; c < width_; ++c) {
      auto& column = columns_[c];
      if (column.stage == Stage::finished) continue;
      column.plain = column.plain || local[c] > kNoGain * column.local;
      column.local = local[c];
    }
  }

  static void judge(Column& column, const GatherOptions& options) {
    if (column.stage != Stage::open) return;
    ++column.sweeps;
    if (column.local <= options.tolerance || column.sweeps >= options.max_iterations)
      column.stage = Stage::finishing;
  }

  void improve(const GatherOptions& options) {
    std::vector<ConjugateResiduals::Goal> goals(width_);
    std::vector<char> plain(width_, 0);
    for (std::size_t c = 0; c < width_; ++c) {
      const auto& column = columns_[c];
      if (column.stage != Stage::open) continue;
      plain[c] = column.plain;
      const double gain = propagation_.has_lobes() ? kCycleGainWithLobes * column.local : 0.0;
      goals[c].local = std::max(kCycleGoal * options.tolerance, gain);
      goals[c].floor = kIrradianceFloor * column.mean;
      goals[c].most_sweeps = options.max_iterations - column.sweeps - 1;
      goals[c].active = !column.plain && goals[c].most_sweeps > 0;
    }
    if (std::count(plain.begin(), plain.end(), 1) > 0) {
      sums_.each([&](std::size_t i) {
        for (std::size_t c = 0; c < width_; ++c) {
          if (plain[c]) irradiance_[i * width_ + c] += residual_[i * width_ + c];
        }
      });
    }
    cycle_.improve(irradiance_, residual_, goals);
    int most = 0;
    for (std::size_t c = 0; c < width_; ++c) {
      columns_[c].sweeps += goals[c].sweeps;
      most = std::max(most, goals[c].sweeps);
    }
    count(most);
  }

  // The last reflection is the result: E = E0 + what arrives of the irradiances before.
  void finish(const std::vector<double>& lobes) {
    const auto sums = sums_.template add<double>(2, [&](std::size_t first, std::size_t last, double* into) {
      for (std::size_t i = first; i < last; ++i) {
        for (std::size_t c = 0; c < width_; ++c) {
          if (!finishing(c)) continue;
          const std::size_t at = i * width_ + c;
          // Conjugate residuals may undershoot where there is next to no light.
          const double next = irradiance_[at] + residual_[at], clipped = std::min(next, 0.0);
          residual_[at] -= clipped;
          irradiance_[at] = next - clipped;
          into[c] -= clipped * propagation_.area_m2(i);
          into[width_ + c] += direct(i, c) * propagation_.area_m2(i);
        }
      }
    });
    const auto& class_of = setting_.reflectances.class_of_column;
    const auto first = class_of.begin() + static_cast<std::ptrdiff_t>(first_);
    const auto reports =
        report_columns(propagation_, {irradiance_, residual_, lobes, setting_.lost_m2}, setting_.contraction,
                       {first, first + static_cast<std::ptrdiff_t>(n_)});
    for (std::size_t c = 0; c < n_; ++c) {
      if (!finishing(c)) continue;
      auto& report = result_.columns[first_ + c] = reports[c];
      report.iterations = columns_[c].sweeps;
      report.residual = columns_[c].local;
      report.received = sums[width_ + c];
      report.unbalanced -= sums[c];
      copy_cells(c);
    }
    if (setting_.shine) copy_shine();
    for (auto& column : columns_) {
      if (column.stage == Stage::finishing) column.stage = Stage::finished;
    }
  }

  void copy_cells(std::size_t c) {
    const auto column = result_.cell.column(first_ + c);
    for (std::size_t i = 0; i < cells_.size(); ++i) column[i] = static_cast<Real>(irradiance_[i * width_ + c]);
  }

  void copy_points(std::size_t c, const std::vector<double>& arriving) {
    if (result_.point.n_rows() == 0) return;
    const auto direct = setting_.point_direct.column((first_ + c) % setting_.point_direct.n_columns());
    const auto column = result_.point.column(first_ + c);
    for (std::size_t p = 0; p < result_.point.n_rows(); ++p)
      column[p] = static_cast<Real>(static_cast<double>(direct[p]) + arriving[p * width_ + c]);
  }

  void copy_points() {
    auto arriving = propagation_.to_points(irradiance_);
    if (setting_.smoothing) correct_points(arriving);
    for (std::size_t c = 0; c < n_; ++c) copy_points(c, arriving);
  }

  // By what the light of cells about twice as large would be another: x = A(D(E + x) + x), D what smoothing
  // changes and A a reflection. What such cells send otherwise is kept for the points.
  void correct_cell_size() {
    std::vector<double> change(irradiance_.size(), 0.0), light(irradiance_.size());
    for (int k = 0; k <= kChangeReflections; ++k) {
      sums_.each([&](std::size_t i) {
        for (std::size_t at = i * width_; at < (i + 1) * width_; ++at) light[at] = irradiance_[at] + change[at];
      });
      setting_.smoothing->change(light, width_, sent_change_);
      sums_.each([&](std::size_t i) {
        for (std::size_t at = i * width_; at < (i + 1) * width_; ++at) sent_change_[at] += change[at];
      });
      if (k < kChangeReflections) propagation_.reflect(sent_change_, change);
    }
    count(kChangeReflections);
    for (double& x : change) x *= -kOfTwiceTheSize;
    keep_flux(change);
    for (std::size_t c = 0; c < n_; ++c) {
      const auto column = result_.cell.column(first_ + c);
      for (std::size_t i = 0; i < cells_.size(); ++i)
        column[i] = static_cast<Real>(irradiance_[i * width_ + c] + change[i * width_ + c]);
    }
    copy_means(change, result_.surface_cells);
  }

  // Cells cannot lose more than they have, and what they do not lose others do not gain.
  void keep_flux(std::vector<double>& correction) {
    const auto sums = sums_.template add<double>(2, [&](std::size_t first, std::size_t last, double* into) {
      for (std::size_t i = first; i < last; ++i) {
        for (std::size_t c = 0; c < width_; ++c) {
          double& x = correction[i * width_ + c];
          const double least = std::min(direct(i, c) - irradiance_[i * width_ + c], 0.0), cut = std::max(x, least);
          into[c] += propagation_.area_m2(i) * (cut - x);
          into[width_ + c] += propagation_.area_m2(i) * std::max(cut, 0.0);
          x = cut;
        }
      }
    });
    gains_.assign(width_, 1.0);
    for (std::size_t c = 0; c < width_; ++c) {
      if (sums[c] > 0.0) gains_[c] = std::max(0.0, 1.0 - sums[c] / sums[width_ + c]);
    }
    sums_.each([&](std::size_t i) {
      for (std::size_t c = 0; c < width_; ++c) {
        double& x = correction[i * width_ + c];
        if (x > 0.0) x *= gains_[c];
      }
    });
  }

  void copy_means(const std::vector<double>& of_cells, Columns<Real>& to) const {
    for (std::size_t c = 0; c < n_; ++c) {
      const auto column = to.column(first_ + c);
      for (std::size_t s = 0; s < to.n_rows(); ++s) {
        double sum = 0.0, area_m2 = 0.0;
        for (std::size_t i = cells_.first(s); i < cells_.first(s + 1); ++i) {
          sum += propagation_.area_m2(i) * of_cells[i * width_ + c];
          area_m2 += propagation_.area_m2(i);
        }
        column[s] = area_m2 > 0.0 ? static_cast<Real>(sum / area_m2) : Real{0};
      }
    }
  }

  void correct_points(std::vector<double>& arriving) {
    const auto change = propagation_.to_points(sent_change_);
    for (std::size_t c = 0; c < n_; ++c) {
      const auto column = result_.point_cells.column(first_ + c);
      for (std::size_t p = 0; p < result_.point.n_rows(); ++p) {
        double correction = std::max(-kOfTwiceTheSize * change[p * width_ + c], -arriving[p * width_ + c]);
        if (correction > 0.0) correction *= gains_[c];
        arriving[p * width_ + c] += correction;
        column[p] = static_cast<Real>(correction);
      }
    }
  }

  // With every other ray, of the points and of the cells that they see.
  void compare_rays() {
    copy_differences(propagation_.to_points_by_half(irradiance_), result_.point_rays);
    if (setting_.contraction.in_flux) return;
    std::vector<double> less;
    propagation_.reflect_by_half(irradiance_, less);
    sums_.each([&](std::size_t i) {
      for (std::size_t c = 0; c < width_; ++c) less[i * width_ + c] -= irradiance_[i * width_ + c] - direct(i, c);
    });
    copy_differences(propagation_.to_points(less), result_.point_cell_rays);
    copy_means(less, result_.surface_rays);
  }

  void copy_differences(const std::vector<double>& from, Columns<Real>& to) const {
    for (std::size_t c = 0; c < n_; ++c) {
      const auto column = to.column(first_ + c);
      for (std::size_t p = 0; p < to.n_rows(); ++p) column[p] = static_cast<Real>(from[p * width_ + c]);
    }
  }

  // Lobes of columns that have finished change with those that have not: taken now.
  void copy_shine() {
    const auto arriving = propagation_.to_points(irradiance_);
    std::vector<bool> wanted(n_);
    for (std::size_t c = 0; c < n_; ++c) {
      wanted[c] = finishing(c);
      if (wanted[c]) copy_points(c, arriving);
    }
    propagation_.shine()->copy_psi(result_.psi, wanted);
  }

  const Setting<Real>& setting_;
  const Cells& cells_;
  std::size_t first_, n_;
  Gathered<Real>& result_;
  Propagation propagation_;
  std::size_t width_;
  const CellSums& sums_;
  ConjugateResiduals cycle_;
  std::vector<double> irradiance_, residual_;  // [n_cells, width]
  std::vector<double> gains_;                  // [width] share that is left of what the correction adds
  std::vector<double> sent_change_;            // [n_cells, width] of irradiance that twice as large cells send
  std::vector<Column> columns_;                // [width]
};

}  // namespace

template <class Real>
Gathered<Real> gather(const Network& network, const Cells& cells, const Columns<Real>& direct,
                      const Columns<Real>& point_direct, const Reflectances& reflectances,
                      const GatherOptions& options, const Job& job, const GatherShine* shine) {
  const std::size_t n_columns = reflectances.n_columns();
  Gathered<Real> result;
  result.cell = Columns<Real>(cells.size(), n_columns);
  const std::size_t n_points = network.point_sinks.n_rows();
  result.point = Columns<Real>(n_points, n_columns);
  result.point_rays = Columns<Real>(n_points, n_columns);
  result.columns.resize(n_columns);
  if (shine) result.psi.resize(shine->shine.n_states() * n_columns);
  Setting<Real> setting{network,
                              cells,
                              direct,
                              point_direct,
                              reflectances,
                              shine,
                              contraction(network, cells, reflectances, shine),
                              lost_by_cells(network, cells),
                              {}};
  if (!setting.contraction.in_flux) {
    result.point_cell_rays = Columns<Real>(n_points, n_columns);
    result.surface_rays = Columns<Real>(cells.n_surfaces(), n_columns);
  }
  if (options.corrects_cell_size && !setting.contraction.in_flux) {
    setting.smoothing.emplace(cells);
    result.point_cells = Columns<Real>(n_points, n_columns);
    result.surface_cells = Columns<Real>(cells.n_surfaces(), n_columns);
  }
  // Off-specular cells hold a value a patch for every column.
  const std::size_t block_columns = setting.contraction.in_flux ? kColumnsPerLane : kMaxColumns;
  for (std::size_t first = 0; first < n_columns; first += block_columns) {
    const std::size_t n = std::min(block_columns, n_columns - first);
    Block<Real>(setting, first, n, result).solve(options, job);
    job.report("solve", static_cast<double>(first + n) / static_cast<double>(n_columns));
  }
  return result;
}

template Gathered<float> gather(const Network&, const Cells&, const Columns<float>&, const Columns<float>&,
                                const Reflectances&, const GatherOptions&, const Job&, const GatherShine*);
template Gathered<double> gather(const Network&, const Cells&, const Columns<double>&, const Columns<double>&,
                                 const Reflectances&, const GatherOptions&, const Job&, const GatherShine*);

}  // namespace dim
