#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexspline::reports {

/// A curve on points that several may share.
struct DrawnCurve {
  const std::vector<double>* x = nullptr;
  const std::vector<double>* y = nullptr;
};

/// The points that the eye sees: those without which one of the curves, all as long as the first,
/// would move by more than a thousandth of its extent in either direction (Ramer 1972, Douglas and
/// Peucker 1973); of more than `most`, the tolerance doubles until they are so few. Ends stay,
/// straight stretches keep none of their inside, turns and corners all; where a curve is no number,
/// one point says that its line breaks.
std::vector<bool> seen_points(std::span<const DrawnCurve> curves, std::size_t most);

void keep_points(std::vector<double>& values, const std::vector<bool>& keep);

/// One curve on points of its own.
void decimate(std::vector<double>& x, std::vector<double>& y, std::size_t most);

}  // namespace flexspline::reports
