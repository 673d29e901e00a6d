#include "diagnosis/model/cause_columns.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "flexspline/core/stop_operator.hpp"

namespace flexspline::studies {

using Eigen::ArrayXd;
using Eigen::Index;

bool travels(const Frame& frame) { return frame.rig != Rig::specimen || frame.travels; }

bool wound_up(const Frame& frame) { return frame.rig != Rig::specimen || !frame.travels; }

bool geared(const Frame& frame) { return frame.rig == Rig::free || frame.ratio > 1.0; }

// Row by row: sine and cosine of one angle are computed together.
Columns sine_pair(const ArrayXd& x, double order) {
  ArrayXd sine(x.size()), cosine(x.size());
  for (Index r = 0; r < x.size(); ++r) {
    const double angle = order * x[r];
    sine[r] = std::sin(angle);
    cosine[r] = std::cos(angle);
  }
  return {std::move(sine), std::move(cosine)};
}

Columns sine_pair(const ArrayXd& x, double order, const ArrayXd& factor) {
  Columns pair = sine_pair(x, order);
  for (ArrayXd& column : pair) column *= factor;
  return pair;
}

ArrayXd smooth_torque(const Frame& frame, const Reference& known) {
  return frame.smooth_torque - known.torque_offset;
}

Columns of_torque_signal(Equation equation, const Frame& frame, Columns terms) {
  if (equation != Equation::motor) return terms;
  for (ArrayXd& term : terms) term /= -frame.ratio;
  return terms;
}

Columns stop_operators(const Frame& frame, const ArrayXd& motion,
                       const std::vector<double>& yields) {
  Columns columns(yields.size());
  for (ArrayXd& column : columns) column.resize(frame.rows());
  for (const Segment& s : frame.segments) {
    // Side by side: each waits for its own last row, not for another's.
    std::vector<StopOperator> stops(yields.begin(), yields.end());
    for (ArrayXd& column : columns) column[s.first] = 0.0;
    for (Index r = s.first + 1; r < s.first + s.count; ++r) {
      const double step = motion[r] - motion[r - 1];
      for (std::size_t k = 0; k < stops.size(); ++k) columns[k][r] = stops[k].advance(step);
    }
  }
  return columns;
}

std::vector<double> geometric(double first, double last, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    values.push_back(first * std::pow(last / first, k / static_cast<double>(count - 1)));
  }
  return values;
}

std::vector<Term> elements(const std::vector<double>& grid, const Term& each) {
  std::vector<Term> terms;
  for (const double value : grid) {
    terms.push_back(each);
    const std::string number = fmt::format("_{}", terms.size());
    terms.back().name += number, terms.back().grid_name += number;
    terms.back().grid_value = value;
  }
  return terms;
}

namespace {

// Of a cubic between rows: central differences, and of the first and last row the secant.
ArrayXd slopes_of(const Frame& frame, const ArrayXd& signal) {
  ArrayXd slope = rate_of(frame, signal);
  const auto secant = [&](Index r) {
    return (signal[r + 1] - signal[r]) / (frame.time[r + 1] - frame.time[r]);
  };
  for (const Segment& s : frame.segments) {
    if (s.count < 2) continue;
    slope[s.first] = secant(s.first);
    slope[s.first + s.count - 1] = secant(s.first + s.count - 2);
  }
  return slope;
}

}  // namespace

ArrayXd later(const Frame& frame, const ArrayXd& signal, double delay) {
  const ArrayXd slope = slopes_of(frame, signal);
  ArrayXd shifted = signal;
  for (const Segment& s : frame.segments) {
    if (s.count < 2) continue;
    const Index last = s.first + s.count - 1;
    Index k = s.first;
    for (Index r = s.first; r <= last; ++r) {
      const double t = frame.time[r] + delay;
      while (k + 1 < last && frame.time[k + 1] < t) ++k;
      while (k > s.first && frame.time[k] > t) --k;
      const double interval = frame.time[k + 1] - frame.time[k];
      const double u = std::clamp((t - frame.time[k]) / interval, 0.0, 1.0);
      const double rise = signal[k + 1] - signal[k];
      const double bend =
          (1.0 - u) * (interval * slope[k] - rise) - u * (interval * slope[k + 1] - rise);
      shifted[r] = (1.0 - u) * signal[k] + u * signal[k + 1] + u * (1.0 - u) * bend;
    }
  }
  return shifted;
}

ArrayXd cold_share(const Frame& frame, double time_constant) {
  return (-frame.clock / time_constant).exp();
}

std::vector<double> periodic_torsion(const Frame& frame, const ArrayXd& angle,
                                     const std::vector<double>& orders) {
  const auto scaled = [](const ArrayXd& x) {
    return (x / std::max(x.abs().maxCoeff(), 1e-300)).eval();
  };
  const ArrayXd load = scaled(frame.smooth_torque);
  Columns columns = {load, load.cube(), scaled(frame.torque_rate), scaled(frame.load_speed)};
  const std::size_t first = columns.size();
  for (double order : orders) {
    for (ArrayXd& column : sine_pair(angle, order)) columns.push_back(std::move(column));
  }
  Eigen::MatrixXd rows(frame.rows(), static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    rows.col(static_cast<Index>(k)) = columns[k] * frame.usable;
  }
  const Eigen::VectorXd b =
      rows.householderQr().solve((frame.torsion * frame.usable).matrix().eval());
  std::vector<double> starts;
  for (std::size_t k = first; k < columns.size(); ++k) starts.push_back(-b[static_cast<Index>(k)]);
  return starts;
}

}  // namespace flexspline::studies
