#pragma once

#include <string>
#include <vector>

#include "geometry/segment.hpp"

namespace dim {

/// Lines of a picture are in pixels from its upper left corner (see Perspective).

/// The same lines with as few segments as possible: those that meet end to end and run straight on to 0.001
/// pixel become one. Sorted by their ends, each with its left (else upper) end first.
std::vector<Segment2> joined(std::vector<Segment2> segments);

/// An SVG picture of the segments, black on white, coordinates to 0.01 pixel. `title` is any UTF-8 text.
std::string to_svg(const std::vector<Segment2>& segments, int width, int height, const std::string& title);

}  // namespace dim
