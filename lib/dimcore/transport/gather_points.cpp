#include "transport/gather.hpp"
#include "transport/gather_kernel.hpp"

namespace dim {

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

template Columns<float> gather_points(const Network&, const Cells&, const Columns<float>&,
                                      const std::vector<float>&, const Columns<float>&, const Reflectances&,
                                      const GatherShine*);
template Columns<double> gather_points(const Network&, const Cells&, const Columns<double>&,
                                       const std::vector<float>&, const Columns<double>&, const Reflectances&,
                                       const GatherShine*);

}  // namespace dim
