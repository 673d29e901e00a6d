#include "diagnosis/search/locate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <unsupported/Eigen/FFT>

#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kBins = 20;
constexpr int kDirectedBins = 10;
constexpr int kGridBins = 5;
constexpr double kHighestOrder = 40.0;
constexpr Index kOfATurn = 4;  // steps between two orders that a travel tells apart
constexpr double kRidge = 1e-9;

// Indicator columns of equally filled bins, each times a factor.
Columns bins(const ArrayXd& x, int count, const ArrayXd& factor) {
  std::vector<double> sorted(x.begin(), x.end());
  std::ranges::sort(sorted);
  Columns columns;
  double low = -std::numeric_limits<double>::infinity();
  for (int b = 1; b <= count; ++b) {
    const double high =
        b == count
            ? std::numeric_limits<double>::infinity()
            : sorted[sorted.size() * static_cast<std::size_t>(b) / static_cast<std::size_t>(count)];
    columns.push_back((x > low && x <= high).select(factor, 0.0));
    low = high;
  }
  return columns;
}

Columns bins(const ArrayXd& x, int count) { return bins(x, count, ArrayXd::Ones(x.size())); }

Columns directed_bins(const ArrayXd& x, const ArrayXd& direction, int count) {
  return bins(x, count, direction);
}

// Every bin of one with every bin of another.
Columns grid(const ArrayXd& x, const ArrayXd& y, int count) {
  Columns columns;
  for (const ArrayXd& row : bins(x, count)) {
    for (const ArrayXd& cell : bins(y, count, row)) columns.push_back(cell);
  }
  return columns;
}

// A straight line in the course of each recording, from a value to one, plain and times a factor.
Columns by_recording(const Frame& f, const ArrayXd& factor, double from) {
  Columns columns;
  for (const Segment& s : f.segments) {
    ArrayXd course = ArrayXd::Zero(f.rows());
    course.segment(s.first, s.count) = ArrayXd::LinSpaced(s.count, from, 1.0);
    columns.push_back(course);
    columns.push_back(course * factor);
  }
  return columns;
}

/// Sums of squares with and without columns, over weighted rows.
struct Reduction {
  double before = 0.0;
  double after = 0.0;
  int columns = 0;
  double largest = 0.0;  ///< that the columns take away
};

Reduction reduction(const ArrayXd& residual, const ArrayXd& weight, const Columns& columns) {
  const Index k = static_cast<Index>(columns.size());
  Eigen::MatrixXd x(residual.size(), k);
  for (Index j = 0; j < k; ++j) x.col(j) = columns[static_cast<std::size_t>(j)] * weight;
  const Eigen::VectorXd y = residual * weight;
  Eigen::MatrixXd normal = x.transpose() * x;
  normal.diagonal().array() += kRidge * normal.trace() / static_cast<double>(k) + 1e-300;
  const Eigen::VectorXd right = x.transpose() * y;
  const Eigen::VectorXd b = normal.ldlt().solve(right);
  Reduction r{y.squaredNorm(), 0.0, static_cast<int>(k)};
  r.after = std::max(r.before - right.dot(b), 1e-12 * r.before);
  r.largest = (weight > 0.0).select((x * b).array() / weight, 0.0).abs().maxCoeff();
  return r;
}

class Scan {
 public:
  Scan(const Frame& frame, const Findings& findings, Equation equation)
      : f_(frame),
        equation_(equation),
        residual_(findings.fit.residual[index_of(equation)]),
        weight_(findings.weight[index_of(equation)]),
        prediction_(findings.fit.prediction[index_of(equation)]),
        rows_(static_cast<double>((weight_ > 0.0).count())),
        colour_(findings.noise[index_of(equation)].colour),
        largest_(frame.largest_torque(equation)) {}

  std::vector<CoordinateScore> all() {
    const ArrayXd& speed = speed_of(f_, equation_);
    const ArrayXd direction = rounded_sign(speed, 0.01 * speed.abs().maxCoeff());
    if (equation_ == Equation::torsion) score("torsion", bins(f_.torsion, kBins), "torsion");
    score("velocity", bins(speed, kBins), "speed");
    score("acceleration", acceleration_columns(), "acceleration");
    score("load", directed_bins(f_.torque.abs(), direction, kDirectedBins),
          "load, with the sign of the motion");
    score("reversal_memory",
          directed_bins(since_reversal(f_, position_of(f_, equation_), speed), direction,
                        kDirectedBins),
          "way since the last reversal");
    score("lag", {rate_of(f_, prediction_)}, "rate of the torque itself");
    score("time", by_recording(f_, direction, 1.0), "time of the session");
    score("time", by_recording(f_, direction, -1.0), "time within each recording");
    score("constant", {ArrayXd::Ones(f_.rows())}, "");
    scores_.back().says =
        fmt::format("what is left of the {} equation is constant", name_of(equation_));
    if (f_.rig == Rig::free) {
      score("load_angle", bins(f_.load_angle, kBins), "load angle");
      turns();
    } else if (f_.travels) {
      turns();
    }
    return std::move(scores_);
  }

  // What two order that neither orders alone.
  std::vector<CoordinateScore> products() {
    score("velocity", grid(position_of(f_, equation_), speed_of(f_, equation_), kGridBins),
          "speed, otherwise at every position");
    score("time", by_recording(f_, prediction_ / largest_, 1.0),
          "torque, otherwise in every recording");
    return std::move(scores_);
  }

 private:
  Columns acceleration_columns() const {
    const ArrayXd& a = acceleration_of(f_, equation_);
    return {a / a.abs().maxCoeff()};
  }

  void score(std::string_view coordinate, const Columns& columns, std::string_view words,
             double tried = 1.0) {
    const Reduction r = reduction(residual_, weight_, columns);
    const double n = rows_ / colour_;
    CoordinateScore s;
    s.equation = equation_;
    s.coordinate = coordinate;
    s.statistic =
        n * std::log(r.before / r.after) - r.columns * std::log(n) - 2.0 * std::log(tried);
    s.share = 1.0 - r.after / r.before;
    s.size = r.largest / largest_;
    s.says =
        fmt::format("what is left of the {} equation follows the {}", name_of(equation_), words);
    scores_.push_back(std::move(s));
  }

  struct Order {
    double per_turn;
    bool with_sign;  ///< of the motion
  };

  // Of rows by the motor's angle, at every multiple of a step in orders: a Fourier transform over
  // bins of the angle, eight or more to the shortest period.
  Eigen::VectorXd power_by_order(const ArrayXd& y, double step, Index orders) const {
    const auto bins = static_cast<Index>(std::bit_ceil(static_cast<std::size_t>(8 * orders)));
    const ArrayXd place = (f_.motor_angle - f_.motor_angle.minCoeff()) *
                          (step * static_cast<double>(bins) / (2.0 * std::numbers::pi));
    Eigen::VectorXd binned = Eigen::VectorXd::Zero(bins);
    for (Index r = 0; r < y.size(); ++r) {
      const auto k = static_cast<Index>(place[r]);
      const double part = place[r] - static_cast<double>(k);
      binned[k] += (1.0 - part) * y[r];
      binned[k + 1] += part * y[r];
    }
    Eigen::VectorXcd spectrum;
    Eigen::FFT<double>().fwd(spectrum, binned);
    return spectrum.head(orders).cwiseAbs2();
  }

  // Of the multiples of a step from the second on, as long as there is a row for every period.
  Order strongest_order(const ArrayXd& direction, double step) const {
    const Index orders =
        std::min(static_cast<Index>(kHighestOrder / step), kOfATurn * f_.rows()) + 1;
    const ArrayXd plain = residual_ * weight_.square();
    Eigen::MatrixX2d power(orders, 2);
    power << power_by_order(plain, step, orders), power_by_order(plain * direction, step, orders);
    Index order = 0, sign = 0;
    power.bottomRows(orders - 2).maxCoeff(&order, &sign);
    return {static_cast<double>(order + 2) * step, sign == 1};
  }

  // Every order that the travel can tell apart: sine and cosine, plain and with the sign of motion.
  void turns() {
    const double travel = f_.motor_angle.maxCoeff() - f_.motor_angle.minCoeff();
    const double turns = travel / (2.0 * std::numbers::pi);
    if (turns < 1.0) return;
    const double step = 1.0 / (kOfATurn * turns);
    const ArrayXd direction = rounded_sign(f_.motor_speed, 0.01 * f_.speed_range);
    const auto [order, flips] = strongest_order(direction, step);
    const double tried = 2.0 * kHighestOrder / step;
    const ArrayXd factor = flips ? direction : ArrayXd::Ones(f_.rows());
    score("motor_angle", sine_pair(f_.motor_angle, order, factor),
          fmt::format("motor angle, {:.2f} times a turn{}", order,
                      flips ? ", with the sign of the motion" : ""),
          tried);
  }

  const Frame& f_;
  Equation equation_;
  const ArrayXd& residual_;
  const ArrayXd& weight_;
  const ArrayXd& prediction_;
  double rows_;
  double colour_;
  double largest_;  // torque of the equation
  std::vector<CoordinateScore> scores_;
};

}  // namespace

std::vector<CoordinateScore> locate(const Frame& frame, const Findings& findings) {
  std::vector<CoordinateScore> scores;
  for (Equation equation : frame.equations) {
    for (CoordinateScore& s : Scan(frame, findings, equation).all()) scores.push_back(std::move(s));
  }
  std::ranges::stable_sort(scores, std::ranges::greater{}, &CoordinateScore::statistic);
  return scores;
}

std::vector<CoordinateScore> locate_anything(const Frame& frame, const Findings& findings) {
  auto scores = locate(frame, findings);
  for (Equation equation : frame.equations) {
    std::ranges::move(Scan(frame, findings, equation).products(), std::back_inserter(scores));
  }
  std::ranges::stable_sort(scores, std::ranges::greater{}, &CoordinateScore::statistic);
  return scores;
}

WorstWindow worst_window(const Frame& frame, const Findings& findings, Equation equation) {
  const std::size_t e = index_of(equation);
  const ArrayXd power = (findings.fit.residual[e] * findings.weight[e]).square();
  WorstWindow worst;
  double largest = -1.0;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const Segment& s = frame.segments[i];
    const Index width = std::max<Index>(s.count / 20, 8);
    for (Index r = 0; r + width < s.count; r += width / 2) {
      const double mean = power.segment(s.first + r, width).mean();
      if (mean <= largest) continue;
      largest = mean;
      worst = {i, frame.time[s.first + r], frame.time[s.first + r + width]};
    }
  }
  return worst;
}

}  // namespace flexspline::studies
