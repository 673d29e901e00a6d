#include "figures/residual_panels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "extent.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

constexpr std::size_t kMostStretches = 20;
constexpr std::size_t kSamplesOfOne = 6;  ///< at least, at the median
constexpr std::size_t kFewest = 3;        ///< samples of a mean that is shown
constexpr int kOrders = 10;

/// Sums of one stretch of the coordinate.
struct Stretch {
  double count = 0.0, position = 0.0, sum = 0.0, squares = 0.0;

  void take(double x, double value) {
    ++count;
    position += x;
    sum += value;
    squares += value * value;
  }
  double mean() const { return sum / count; }
  double standard_error() const {
    return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / (count - 1.0));
  }
};

std::vector<Stretch> stretches_of(const std::vector<double>& x, const std::vector<double>& values) {
  const std::size_t count =
      std::clamp<std::size_t>(values.size() / kSamplesOfOne, 2, kMostStretches);
  std::vector<Stretch> stretches(count);
  Extent extent;
  extent.take(x);
  const double width = (extent.upper - extent.lower) / static_cast<double>(count);
  if (!(width > 0.0)) return {};
  for (std::size_t i = 0; i < std::min(x.size(), values.size()); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(values[i])) continue;
    const auto at = static_cast<std::size_t>((x[i] - extent.lower) / width);
    stretches[std::min(at, count - 1)].take(x[i], values[i]);
  }
  std::erase_if(stretches, [](const Stretch& one) { return one.count < kFewest; });
  return stretches;
}

void add_means(Panel& panel, const std::vector<double>& x, const Remainder& left, bool bands) {
  Series line{left.name, "line", left.role, {}, {}, {}, {}};
  Series band{left.name + ", 95 %", "band", left.role, {}, {}, {}, {}};
  for (const Stretch& one : stretches_of(x, left.values)) {
    line.x.push_back(rounded(one.position / one.count, 4));
    line.y.push_back(rounded(one.mean(), 3));
    band.lower.push_back(one.mean() - 2.0 * one.standard_error());
    band.upper.push_back(one.mean() + 2.0 * one.standard_error());
  }
  if (line.x.size() < 2) return;
  if (bands) {
    band.x = line.x;
    band.y = line.y;
    panel.series.push_back(std::move(band));
  }
  panel.series.push_back(std::move(line));
}

/// Amplitude at each order, by projection on its sine and cosine.
Series orders_of(const std::vector<double>& phase, const Remainder& left) {
  Series series{left.name, "line", left.role, {}, {}, {}, {}};
  const std::size_t count = std::min(phase.size(), left.values.size());
  for (int order = 1; order <= kOrders; ++order) {
    double c = 0.0, s = 0.0, used = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(phase[i]) || !std::isfinite(left.values[i])) continue;
      c += left.values[i] * std::cos(order * phase[i]);
      s += left.values[i] * std::sin(order * phase[i]);
      ++used;
    }
    series.x.push_back(order);
    series.y.push_back(rounded(2.0 * std::hypot(c, s) / used, 3));
  }
  return series;
}

/// Orders of less than a turn mean nothing.
bool turns(const std::vector<double>& phase) {
  Extent extent;
  extent.take(phase);
  return extent.upper - extent.lower > 1.9 * std::numbers::pi;
}

}  // namespace

std::vector<Panel> residual_panels(const Coordinates& at, const std::vector<Remainder>& left,
                                   bool bands) {
  struct Over {
    std::string title;
    const std::vector<double>* x;
    std::string label;
  };
  const Over all[] = {{"by time", &at.time, "time / s"},
                      {"by " + at.units.motion_name(), &at.motion, at.units.motion_label()},
                      {"by velocity", &at.rate, at.units.rate_label()},
                      {"by load", &at.effort, at.units.effort_label()}};
  std::vector<Panel> panels;
  const auto keep = [&](Panel panel) {
    if (!panel.series.empty()) panels.push_back(std::move(panel));
  };
  for (const Over& one : all) {
    Panel panel;
    panel.title = one.title;
    panel.x.label = one.label;
    panel.y.label = "mean residual / " + at.units.effort;
    if (one.x->empty()) continue;
    for (const Remainder& remainder : left) add_means(panel, *one.x, remainder, bands);
    keep(std::move(panel));
  }
  if (!turns(at.phase)) return panels;
  Panel panel;
  panel.title = "by order " + at.turn;
  panel.x.label = "order";
  panel.y.label = "amplitude / " + at.units.effort;
  for (const Remainder& remainder : left) panel.series.push_back(orders_of(at.phase, remainder));
  keep(std::move(panel));
  return panels;
}

}  // namespace flexspline::reports
