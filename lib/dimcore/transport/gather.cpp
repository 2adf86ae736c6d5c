#include "transport/gather.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
    if (!setting_.shine) copy_points();
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
    const auto arriving = propagation_.to_points(irradiance_);
    for (std::size_t c = 0; c < n_; ++c) copy_points(c, arriving);
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
  result.point = Columns<Real>(network.point_sinks.n_rows(), n_columns);
  result.columns.resize(n_columns);
  if (shine) result.psi.resize(shine->shine.n_states() * n_columns);
  const Setting<Real> setting{network,
                              cells,
                              direct,
                              point_direct,
                              reflectances,
                              shine,
                              contraction(network, cells, reflectances, shine),
                              lost_by_cells(network, cells)};
  // Off-specular cells hold a value a patch for every column.
  const std::size_t block_columns = setting.contraction.in_flux ? kColumnsPerLane : kMaxColumns;
  for (std::size_t first = 0; first < n_columns; first += block_columns) {
    const std::size_t n = std::min(block_columns, n_columns - first);
    Block<Real>(setting, first, n, result).solve(options, job);
    job.report("solve", static_cast<double>(first + n) / static_cast<double>(n_columns));
  }
  return result;
}

template <class Real>
Columns<Real> gather_points(const Network& network, const Cells& cells, const Columns<Real>& cell,
                            const std::vector<float>& psi, const Columns<Real>& point_direct,
                            const Reflectances& reflectances, const GatherShine* shine) {
  Columns<Real> point(network.point_sinks.n_rows(), cell.n_columns());
  if (point.n_rows() == 0) return point;
  const std::size_t block_columns = psi.empty() ? kMaxColumns : kColumnsPerLane;
  for (std::size_t first = 0; first < cell.n_columns(); first += block_columns) {
    const std::size_t n = std::min(block_columns, cell.n_columns() - first);
    Propagation propagation(network, cells, reflectances, first, n, shine);
    if (propagation.shine()) propagation.shine()->set_psi(psi);
    const std::size_t width = propagation.width();
    std::vector<double> irradiance(cells.size() * width, 0.0);
    for (std::size_t c = 0; c < n; ++c) {
      const auto column = cell.column(first + c);
      for (std::size_t i = 0; i < cells.size(); ++i) irradiance[i * width + c] = static_cast<double>(column[i]);
    }
    const auto arriving = propagation.to_points(irradiance);
    for (std::size_t c = 0; c < n; ++c) {
      const auto direct = point_direct.column((first + c) % point_direct.n_columns());
      const auto column = point.column(first + c);
      for (std::size_t p = 0; p < point.n_rows(); ++p)
        column[p] = static_cast<Real>(static_cast<double>(direct[p]) + arriving[p * width + c]);
    }
  }
  return point;
}

#define DIM_INSTANTIATE(Real)                                                                             \
  template Gathered<Real> gather(const Network&, const Cells&, const Columns<Real>&, const Columns<Real>&, \
                                 const Reflectances&, const GatherOptions&, const Job&, const GatherShine*); \
  template Columns<Real> gather_points(const Network&, const Cells&, const Columns<Real>&,                 \
                                       const std::vector<float>&, const Columns<Real>&, const Reflectances&, \
                                       const GatherShine*);
DIM_INSTANTIATE(float)
DIM_INSTANTIATE(double)
#undef DIM_INSTANTIATE

}  // namespace dim
