#include "diagnosis/frame/shared_baseline.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <list>
#include <mutex>

#include "diagnosis/frame/low_pass.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr std::size_t kMostPlain = 4;     // some megabytes each
constexpr std::size_t kMostWeighted = 8;  // a megabyte or two each
constexpr std::size_t kMostFilters = 4;   // before and after a difference, and of another thread

/// What columns depend on, as a sum of 128 bits: two sums by different multipliers.
class Sum {
 public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    low_ = mixed(low_ ^ bits, 0xbf58476d1ce4e5b9U);
    high_ = mixed(high_ ^ bits, 0x94d049bb133111ebU);
  }
  void add(const ArrayXd& values) {
    add(static_cast<double>(values.size()));
    for (const double value : values) add(value);
  }
  friend bool operator==(const Sum&, const Sum&) = default;

 private:
  static std::uint64_t mixed(std::uint64_t sum, std::uint64_t by) {
    sum *= by;
    return sum ^ (sum >> 29U);
  }
  std::uint64_t low_ = 1;
  std::uint64_t high_ = 2;
};

Sum sum_of(const Frame& frame, Equation equation, std::span<const double> shape) {
  Sum sum;
  sum.add(static_cast<double>(equation) + (frame.travels ? 16.0 : 0.0) +
          (frame.firm_spring ? 32.0 : 0.0));
  sum.add(static_cast<double>(frame.rig));
  for (const double value :
       {frame.torsion_range, frame.rate_range, frame.slow_rate, frame.speed_range, frame.torque_lag,
        frame.lowest, frame.highest, frame.torque_range}) {
    sum.add(value);
  }
  for (const double value : shape) sum.add(value);
  if (equation == Equation::torsion) sum.add(frame.torsion), sum.add(frame.torsion_rate);
  if (equation == Equation::load || frame.torque_by_inertia) sum.add(frame.load_speed);
  if (equation == Equation::motor) sum.add(frame.motor_speed);
  if (equation == Equation::motor && frame.rig == Rig::servo) {
    sum.add(frame.gravity), sum.add(frame.load_acceleration);
  }
  return sum;
}

/// The latest of some kind of columns.
template <typename T, std::size_t most>
class Recent {
 public:
  template <typename Build>
  std::shared_ptr<const T> get(const Sum& sum, const Build& build) {
    if (auto known = find(sum)) return known;
    auto columns = std::make_shared<const T>(build());
    const std::scoped_lock lock(mutex_);
    kept_.push_front({sum, columns});
    if (kept_.size() > most) kept_.pop_back();
    return columns;
  }

 private:
  struct Kept {
    Sum sum;
    std::shared_ptr<const T> columns;
  };

  std::shared_ptr<const T> find(const Sum& sum) {
    const std::scoped_lock lock(mutex_);
    const auto one = std::ranges::find(kept_, sum, &Kept::sum);
    if (one == kept_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, one);
    return one->columns;
  }

  std::mutex mutex_;
  std::list<Kept> kept_;  // the latest first
};

WeightedBaseline weighted(const Frame& frame, Equation equation, std::span<const double> shape,
                          const WeightedRows& rows) {
  const auto all = frame.torque_lag > 0.0 ? shared_baseline(frame, equation, shape) : nullptr;
  const BaselineColumns some =
      all ? BaselineColumns{all->columns(rows.at, Eigen::all), all->lower, 0, 0, all->prior}
          : baseline_columns(motion_at(frame, rows.at), equation, shape);
  Eigen::MatrixXd columns(rows.size(), some.columns.cols());
  columns << (some.columns.array().colwise() * rows.weight).matrix(), some.prior;
  return {some.lower, std::make_shared<const estimators::SharedColumns>(std::move(columns))};
}

}  // namespace

class KeptBaselines {
 public:
  Recent<BaselineColumns, kMostPlain> plain;
  Recent<WeightedBaseline, kMostWeighted> weighted;
  Recent<LowPass, kMostFilters> filters;
};

std::shared_ptr<KeptBaselines> no_baselines_yet() { return std::make_shared<KeptBaselines>(); }

WeightedRows::WeightedRows(const ArrayXd& all, Eigen::Index prior) : prior_(prior) {
  for (Eigen::Index r = 0; r < all.size(); ++r) {
    if (all[r] > 0.0) at.push_back(r);
  }
  weight = all(at);
}

// By hand: an index given to Eigen is copied each time.
Eigen::VectorXd WeightedRows::of(const ArrayXd& signal) const {
  Eigen::VectorXd some = Eigen::VectorXd::Zero(size());
  for (Eigen::Index i = 0; i < weight.size(); ++i) {
    some[i] = signal[at[static_cast<std::size_t>(i)]] * weight[i];
  }
  return some;
}

std::shared_ptr<const LowPass> shared_low_pass(const Frame& frame, double time_constant) {
  const auto build = [&] { return LowPass(frame, time_constant); };
  if (frame.kept == nullptr) return std::make_shared<const LowPass>(build());
  Sum sum;
  sum.add(time_constant);
  sum.add(frame.time);
  for (const Segment& s : frame.segments) {
    sum.add(static_cast<double>(s.first)), sum.add(static_cast<double>(s.count));
  }
  return frame.kept->filters.get(sum, build);
}

std::shared_ptr<const BaselineColumns> shared_baseline(const Frame& frame, Equation equation,
                                                       std::span<const double> shape) {
  const auto build = [&] { return baseline_columns(frame, equation, shape); };
  if (frame.kept == nullptr) return std::make_shared<const BaselineColumns>(build());
  return frame.kept->plain.get(sum_of(frame, equation, shape), build);
}

Eigen::VectorXd weighted_sum(const Frame& frame, Equation equation, std::span<const double> shape,
                             const WeightedRows& rows, const Eigen::VectorXd& b) {
  if (equation != Equation::torsion) {
    return weighted_baseline(frame, equation, shape, rows)->columns->columns * b;
  }
  Eigen::VectorXd sum(rows.size());
  if (frame.torque_lag > 0.0) {
    const BaselineTorque all = baseline_torque(frame, shape, b);
    sum << (all.sum()(rows.at) * rows.weight).matrix(), all.prior;
  } else {
    const BaselineTorque some = baseline_torque(motion_at(frame, rows.at), shape, b);
    sum << (some.sum() * rows.weight).matrix(), some.prior;
  }
  return sum;
}

std::shared_ptr<const WeightedBaseline> weighted_baseline(const Frame& frame, Equation equation,
                                                          std::span<const double> shape,
                                                          const WeightedRows& rows) {
  const auto build = [&] { return weighted(frame, equation, shape, rows); };
  if (frame.kept == nullptr) return std::make_shared<const WeightedBaseline>(build());
  Sum sum = sum_of(frame, equation, shape);
  for (const Eigen::Index row : rows.at) sum.add(static_cast<double>(row));
  sum.add(rows.weight);
  return frame.kept->weighted.get(sum, build);
}

}  // namespace flexspline::studies
