#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dim {

enum class ScaleKind { linear, logarithmic };

struct Tick {
  double value = 0;
  std::string label;  ///< empty: a minor tick
};

/// The scale of a false-colour picture: low < high, low > 0 where logarithmic.
struct Scale {
  ScaleKind kind = ScaleKind::linear;
  double low = 0;
  double high = 1;

  /// 0 at low, 1 at high; outside that range beyond them; -infinity for v <= 0 on a logarithmic scale.
  double position(double v) const;
};

/// A scale with round ends (1, 2, 2.5 or 5 times a power of ten apart; logarithmic: 1, 2, 5) over the values.
///
/// Linear scales start at 0 (values below it extend it) and end at or above the value that all but 0.5 % of
/// the values keep below, so that a spot beside a luminaire does not use up the scale. Logarithmic ones reach
/// at most four decades down from there. Without values: 0..1 or 0.1..1.
/// @param values  finite; order does not matter
Scale automatic_scale(ScaleKind kind, std::vector<float> values);

/// @throws InputError  the ends are not finite, not in order, or low <= 0 on a logarithmic scale
void check_scale(const Scale& scale);

/// Round values along a scale, ascending, for at most max_labels labels (at least 2), which share one number
/// of decimals on a linear scale. Ends that are not round are labelled by nobody: the nearest ticks inside
/// are.
std::vector<Tick> ticks(const Scale& scale, int max_labels);

}  // namespace dim
