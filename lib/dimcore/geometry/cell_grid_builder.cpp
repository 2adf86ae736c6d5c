#include "geometry/cell_grid_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <tuple>

#include "base/low_discrepancy.hpp"

namespace dim {
namespace {

constexpr std::int32_t kOutside = std::numeric_limits<std::int32_t>::min();

Ring2 rectangle(const Vec2& low, const Vec2& high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

// A number that depends on where the segment lies and not on which end comes first. Coordinates are rounded
// to 2^-24 of the extent, with an offset that keeps round figures away from where rounding jumps.
std::uint64_t place_hash(const Segment2& s, double extent_m) {
  const auto hash = [&](const Vec2& p) {
    const auto rounded = [&](double x) {
      return static_cast<std::uint64_t>(
          static_cast<std::int64_t>(std::floor(std::ldexp(x / extent_m, 24) + 0.3)));
    };
    return mix(mix(rounded(p.x)) ^ rounded(p.y));
  };
  return mix(hash(s.a) + hash(s.b));
}

Vec2 centre(const Ring2& ring) {
  Vec2 sum(0.0);
  for (const auto& p : ring) sum += p;
  return sum / static_cast<double>(ring.size());
}

bool is_rectangle(const Ring2& ring, const Vec2& low, const Vec2& high, double rounding_m) {
  if (ring.size() != 4) return false;
  return std::all_of(ring.begin(), ring.end(), [&](const Vec2& p) {
    const Vec2 off = glm::min(glm::abs(p - low), glm::abs(p - high));
    return std::max(off.x, off.y) <= rounding_m;
  });
}

}  // namespace

CellGridBuilder::CellGridBuilder(CellGrid& grid, const Polygon& polygon, std::span<const Segment2> joints,
                                 double narrow_m)
    : grid_(grid), polygon_(polygon) {
  constexpr double kNarrow = 1e-8, kRounding = 1e-4;
  narrow_m_ = narrow_m > 0.0 ? narrow_m : kNarrow * glm::length(grid.size_m_);
  rounding_m_ = kRounding * narrow_m_;
  if (!grid.regular_) collect_barriers(joints);
}

// Edges before joints, so that what is outside is known before joints are looked at. Among themselves in an
// order that looks random but follows from their places: a tree of lines in order, wall after wall, would be
// as deep as there are walls.
void CellGridBuilder::collect_barriers(std::span<const Segment2> joints) {
  const double extent_m = glm::length(grid_.size_m_);
  const auto add = [&](const Segment2& segment, bool edge) {
    if (glm::length(segment.b - segment.a) > rounding_m_)
      barriers_.push_back({segment, edge, place_hash(segment, extent_m)});
  };
  if (!polygon_.is_rectangle()) {
    for (const auto& ring : polygon_.rings()) {
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) add({ring[j], ring[i]}, true);
    }
  }
  for (const auto& joint : joints) add(joint, false);
  std::sort(barriers_.begin(), barriers_.end(),
            [](const Barrier& p, const Barrier& q) { return p.edge != q.edge ? p.edge : p.order < q.order; });
}

Vec2 CellGridBuilder::low(int i, int j) const {
  const auto at = [](int k, int n, double size) { return k == n ? size : size * k / n; };
  return {at(i, grid_.nu_, grid_.size_m_.x), at(j, grid_.nv_, grid_.size_m_.y)};
}

Vec2 CellGridBuilder::middle(int i, int j) const { return (low(i, j) + low(i + 1, j + 1)) / 2.0; }

// Notes every square that a barrier comes near to.
void CellGridBuilder::find_passages() {
  const auto range = [&](double from, double to, double per_m, int n) {
    const auto step = [&](double x) { return std::clamp(std::floor(x * per_m), -1.0, double(n)); };
    return std::pair(std::max(0, static_cast<int>(step(from - narrow_m_))),
                     std::min(n - 1, static_cast<int>(step(to + narrow_m_))));
  };
  for (std::size_t b = 0; b < barriers_.size(); ++b) {
    const Vec2 p = barriers_[b].segment.a, q = barriers_[b].segment.b;
    const Vec2 least = glm::min(p, q), most = glm::max(p, q), way = q - p;
    const auto [j0, j1] = range(least.y, most.y, grid_.per_m_.y, grid_.nv_);
    for (int j = j0; j <= j1; ++j) {
      double x0 = least.x, x1 = most.x;
      if (j0 < j1) {
        const double y0 = low(0, j).y - narrow_m_, y1 = low(0, j + 1).y + narrow_m_;
        const auto at = [&](double y) { return p.x + way.x * std::clamp((y - p.y) / way.y, 0.0, 1.0); };
        std::tie(x0, x1) = std::minmax({at(y0), at(y1)});
      }
      const auto [i0, i1] = range(x0, x1, grid_.per_m_.x, grid_.nu_);
      for (int i = i0; i <= i1; ++i)
        passages_.push_back({static_cast<std::uint64_t>(j) * static_cast<std::uint64_t>(grid_.nu_) +
                                 static_cast<std::uint64_t>(i),
                             static_cast<std::uint32_t>(b)});
    }
  }
  std::sort(passages_.begin(), passages_.end(), [](const Passage& s, const Passage& t) {
    return s.square != t.square ? s.square < t.square : s.barrier < t.barrier;
  });
}

std::span<const CellGridBuilder::Passage> CellGridBuilder::passages(std::size_t square) const {
  const auto before = [](const Passage& p, std::size_t s) { return p.square < s; };
  const auto first = std::lower_bound(passages_.begin(), passages_.end(), square, before);
  const auto last = std::lower_bound(first, passages_.end(), square + 1, before);
  return {first, last};
}

// A point of each square of which is known early whether it lies in the polygon. Off the middle, so that
// neither round figures nor symmetry put an edge on it.
Vec2 CellGridBuilder::reference(int i, int j) const {
  const Vec2 from = low(i, j), to = low(i + 1, j + 1);
  return from + Vec2(0.5176, 0.4827) * (to - from);
}

// Crossings of edges with the line of each row's references, in order.
void CellGridBuilder::find_references() {
  if (polygon_.is_rectangle()) return;
  inside_.assign(grid_.cell_of_square_.size(), false);
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(grid_.nv_));
  for (const auto& barrier : barriers_) {
    if (!barrier.edge) continue;
    const auto& [a, b] = barrier.segment;
    const double least = std::min(a.y, b.y) * grid_.per_m_.y, most = std::max(a.y, b.y) * grid_.per_m_.y;
    const int j1 = std::min(grid_.nv_ - 1, static_cast<int>(most) + 1);
    for (int j = std::max(0, static_cast<int>(least) - 1); j <= j1; ++j) {
      const double y = reference(0, j).y;
      if ((a.y > y) != (b.y > y))
        crossings[static_cast<std::size_t>(j)].push_back((b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x);
    }
  }
  for (int j = 0; j < grid_.nv_; ++j) {
    auto& row = crossings[static_cast<std::size_t>(j)];
    std::sort(row.begin(), row.end());
    std::size_t passed = 0;
    for (int i = 0; i < grid_.nu_; ++i) {
      const double x = reference(i, j).x;
      while (passed < row.size() && row[passed] < x) ++passed;
      inside_[static_cast<std::size_t>(j * grid_.nu_ + i)] = passed % 2 == 1;
    }
  }
}

// Whether a point of the square being made lies in the polygon: by the edges on the way from the reference.
bool CellGridBuilder::is_inside(const Vec2& p) const {
  if (polygon_.is_rectangle()) return true;
  const Vec2 from = reference(square_[0], square_[1]);
  bool inside = inside_[static_cast<std::size_t>(square_[1] * grid_.nu_ + square_[0])];
  const Line2 way = line_through({from, p});
  for (const auto& passage : near_) {
    const Barrier& barrier = barriers_[passage.barrier];
    if (!barrier.edge) break;
    const auto& [a, b] = barrier.segment;
    if ((way.height(a) > 0.0) == (way.height(b) > 0.0)) continue;
    const Line2 edge = line_through(barrier.segment);
    if ((edge.height(from) > 0.0) != (edge.height(p) > 0.0)) inside = !inside;
  }
  return inside;
}

void CellGridBuilder::build() {
  if (!grid_.regular_) {
    grid_.cell_of_square_.assign(static_cast<std::size_t>(grid_.nu_) * static_cast<std::size_t>(grid_.nv_),
                                 kOutside);
    grid_.middles_.assign(grid_.cell_of_square_.size(), 0);
    find_passages();
    find_references();
  }
  std::size_t next = 0;
  for (int j = 0; j < grid_.nv_; ++j) {
    for (int i = 0; i < grid_.nu_; ++i) {
      const auto square = static_cast<std::size_t>(j * grid_.nu_ + i);
      const std::size_t first = next;
      while (next < passages_.size() && passages_[next].square == square) ++next;
      near_ = std::span(passages_).subspan(first, next - first);
      square_ = {i, j};
      make_square();
    }
  }
  if (grid_.regular_) return;
  if (!narrow_.empty()) absorb_narrow();
  store_shapes();
  fill_empty_squares();
}

void CellGridBuilder::make_square() {
  const auto [i, j] = square_;
  const Vec2 from = low(i, j), to = low(i + 1, j + 1);
  if (grid_.regular_) {
    add_square(from, to);
    return;
  }
  std::vector<std::uint32_t> through;
  const Ring2 square = rectangle(from, to);
  for (const auto& passage : near_) {
    if (passes_through(passage.barrier, square)) through.push_back(passage.barrier);
  }
  auto& root = grid_.cell_of_square_[static_cast<std::size_t>(j * grid_.nu_ + i)];
  if (!through.empty())
    root = divide(square, through, false);
  else if (is_inside((from + to) / 2.0))
    root = add_square(from, to);
  mark_middle();
}

// Where barriers stand between the square's middle and its neighbours', or on the middle itself.
void CellGridBuilder::mark_middle() {
  const auto [i, j] = square_;
  const Vec2 own = middle(i, j);
  auto* of_square = &grid_.middles_[static_cast<std::size_t>(j * grid_.nu_ + i)];
  if (!is_inside(own)) *of_square |= CellGrid::kNoMiddle;
  for (const auto& passage : near_) {
    const Segment2& barrier = barriers_[passage.barrier].segment;
    if (distance_m(own, barrier) <= narrow_m_) *of_square |= CellGrid::kNoMiddle;
    if (i + 1 < grid_.nu_ && segments_meet(barrier, {own, middle(i + 1, j)}))
      *of_square |= CellGrid::kCutFromRight;
    if (j + 1 < grid_.nv_ && segments_meet(barrier, {own, middle(i, j + 1)}))
      *of_square |= CellGrid::kCutFromUpper;
    if (i > 0 && segments_meet(barrier, {own, middle(i - 1, j)})) of_square[-1] |= CellGrid::kCutFromRight;
    if (j > 0 && segments_meet(barrier, {own, middle(i, j - 1)}))
      of_square[-grid_.nu_] |= CellGrid::kCutFromUpper;
  }
}

// Halves the piece along the first barrier that passes through it. Edges come first; what no edge passes
// through is all inside or all outside.
std::int32_t CellGridBuilder::divide(const Ring2& piece, const std::vector<std::uint32_t>& through,
                                     bool known_inside) {
  const Barrier* barrier = through.empty() ? nullptr : &barriers_[through.front()];
  const bool edge = barrier && barrier->edge;
  if (!edge && !known_inside && !is_inside(centre(piece))) return kOutside;
  if (!barrier) return add_cell(piece);
  CellGrid::Node node{line_through(barrier->segment), 0, 0};
  Ring2 left, right;
  split_convex(piece, node.line, rounding_m(*barrier), left, right);
  const auto through_part = [&](const Ring2& part) {
    std::vector<std::uint32_t> those;
    std::copy_if(through.begin() + 1, through.end(), std::back_inserter(those),
                 [&](std::uint32_t b) { return passes_through(b, part); });
    return those;
  };
  node.left = divide(left, through_part(left), !edge);
  node.right = divide(right, through_part(right), !edge);
  if (node.left == kOutside) return node.right;
  if (node.right == kOutside) return node.left;
  grid_.nodes_.push_back(node);
  return ~static_cast<std::int32_t>(grid_.nodes_.size() - 1);
}

bool CellGridBuilder::passes_through(std::uint32_t barrier, const Ring2& piece) const {
  const Barrier& b = barriers_[barrier];
  return dim::passes_through(b.segment, piece, rounding_m(b));
}

std::int32_t CellGridBuilder::add_square(const Vec2& low, const Vec2& high) {
  const Vec2 size = high - low;
  grid_.cells_.push_back({low, high, (low + high) / 2.0, size.x * size.y});
  return static_cast<std::int32_t>(grid_.cells_.size() - 1);
}

std::int32_t CellGridBuilder::add_cell(const Ring2& piece) {
  GridCell cell;
  cell.low = cell.high = piece.front();
  for (const auto& p : piece) {
    cell.low = glm::min(cell.low, p);
    cell.high = glm::max(cell.high, p);
  }
  const auto moments = area_moments(piece);
  cell.area_m2 = moments[0];
  cell.centroid = {moments[1] / moments[0], moments[2] / moments[0]};
  cell.whole = is_rectangle(piece, cell.low, cell.high, rounding_m_);
  const auto index = static_cast<std::uint32_t>(grid_.cells_.size());
  if (!cell.whole) {
    cell.shape = static_cast<std::uint32_t>(shapes_.size());
    shapes_.push_back(piece);
  }
  if (mean_width_m(piece) < narrow_m_) narrow_.push_back(index);
  grid_.cells_.push_back(cell);
  return static_cast<std::int32_t>(index);
}

// Gives each narrow cell to the one beside it, where there is one.
void CellGridBuilder::absorb_narrow() {
  std::vector<std::int32_t> hosts(grid_.cells_.size(), -1);
  std::vector<std::int32_t> found;
  for (const auto cell : narrow_) found.push_back(host_of(cell));
  for (std::size_t k = 0; k < narrow_.size(); ++k) {
    if (found[k] < 0) continue;
    hosts[narrow_[k]] = found[k];
    grid_.cells_[static_cast<std::size_t>(found[k])].area_m2 += grid_.cells_[narrow_[k]].area_m2;
  }
  renumber(hosts);
}

// Of the cells a little way off on both sides: one that no barrier separates, else any; never a narrow one.
std::int32_t CellGridBuilder::host_of(std::size_t cell) const {
  const GridCell& own = grid_.cells_[cell];
  const Ring2 ring = own.whole ? rectangle(own.low, own.high) : shapes_[own.shape];
  Segment2 longest{ring.back(), ring.front()};
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    if (glm::length(ring[i + 1] - ring[i]) > glm::length(longest.b - longest.a))
      longest = {ring[i], ring[i + 1]};
  }
  const Vec2 across = 2.0 * narrow_m_ * line_through(longest).normal;
  std::int32_t any = -1;
  for (const double side : {1.0, -1.0}) {
    const Vec2 beyond = own.centroid + side * across;
    const Vec2& size = grid_.size_m_;
    if (beyond.x < 0.0 || beyond.y < 0.0 || beyond.x > size.x || beyond.y > size.y) continue;
    const auto root = grid_.cell_of_square_[static_cast<std::size_t>(grid_.square_at(beyond))];
    if (root == kOutside) continue;
    const int host = grid_.descend(root, beyond);
    if (std::binary_search(narrow_.begin(), narrow_.end(), static_cast<std::uint32_t>(host))) continue;
    if (!meets_barrier({own.centroid, beyond})) return host;
    any = host;
  }
  return any;
}

bool CellGridBuilder::meets_barrier(const Segment2& way) const {
  for (const Vec2& end : {way.a, way.b}) {
    for (const auto& passage : passages(static_cast<std::size_t>(grid_.square_at(end)))) {
      if (segments_meet(barriers_[passage.barrier].segment, way)) return true;
    }
  }
  return false;
}

// Takes cells that have a host out of the list and puts their hosts in their places elsewhere.
void CellGridBuilder::renumber(const std::vector<std::int32_t>& hosts) {
  std::vector<std::int32_t> moved(hosts.size());
  std::vector<GridCell> kept;
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    if (hosts[i] >= 0) continue;
    moved[i] = static_cast<std::int32_t>(kept.size());
    kept.push_back(grid_.cells_[i]);
  }
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    if (hosts[i] >= 0) moved[i] = moved[static_cast<std::size_t>(hosts[i])];
  }
  const auto move = [&](std::int32_t& at) {
    if (at >= 0) at = moved[static_cast<std::size_t>(at)];
  };
  for (auto& node : grid_.nodes_) move(node.left), move(node.right);
  for (auto& at : grid_.cell_of_square_) move(at);
  grid_.cells_ = std::move(kept);
}

void CellGridBuilder::store_shapes() {
  std::uint32_t n = 0;
  grid_.first_corner_.push_back(0);
  for (auto& cell : grid_.cells_) {
    if (cell.whole) continue;
    const Ring2& ring = shapes_[cell.shape];
    grid_.corners_.insert(grid_.corners_.end(), ring.begin(), ring.end());
    grid_.first_corner_.push_back(static_cast<std::uint32_t>(grid_.corners_.size()));
    cell.shape = n++;
  }
}

// Hits may lie outside the polygon by rounding: empty squares stand for the one nearest to them.
void CellGridBuilder::fill_empty_squares() {
  auto& of_square = grid_.cell_of_square_;
  std::deque<int> front;
  for (std::size_t s = 0; s < of_square.size(); ++s) {
    if (of_square[s] != kOutside) front.push_back(static_cast<int>(s));
  }
  while (!front.empty()) {
    const int square = front.front();
    front.pop_front();
    const int i = square % grid_.nu_, j = square / grid_.nu_;
    constexpr std::array<std::array<int, 2>, 4> kSteps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    for (const auto& [di, dj] : kSteps) {
      const int ni = i + di, nj = j + dj;
      if (ni < 0 || nj < 0 || ni >= grid_.nu_ || nj >= grid_.nv_) continue;
      auto& neighbour = of_square[static_cast<std::size_t>(nj * grid_.nu_ + ni)];
      if (neighbour != kOutside) continue;
      neighbour = of_square[static_cast<std::size_t>(square)];
      front.push_back(nj * grid_.nu_ + ni);
    }
  }
}

}  // namespace dim
