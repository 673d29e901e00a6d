#include "bench/slip_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "bench/nonnegative_least_squares.hpp"
#include "bench/rising_spline.hpp"
#include "bench/smooth_base.hpp"

namespace flexspline::data {
namespace {

/// In units of 0.2 deg.
constexpr std::array<double, 6> kYields = {0.08, 0.2, 0.35, 0.5, 0.7, 0.9};
constexpr int kIntervals = 200;  // of half a cycle; the turning points are left out

/// A slip element of unit stiffness in its steady loop between -1 and 1.
double rising_branch(double x, double yield) { return std::min(x + 1.0 - yield, yield); }
double falling_branch(double x, double yield) { return -rising_branch(-x, yield); }

struct SlipFit {
  Eigen::VectorXd stiffness;  ///< Nm per 0.2 deg, one a yield
  Eigen::VectorXd remainder;  ///< coefficients of f
  double misfit_percent = 0.0;
};

/// The equations of both fits: one row an instant of the paper's half cycle.
struct LoopSamples {
  Eigen::MatrixXd half_heights{kIntervals - 1, kYields.size()};
  Eigen::MatrixXd midlines{kIntervals - 1, kYields.size()};
  Eigen::MatrixXd rising{kIntervals - 1, RisingSpline::kSize};
  Eigen::VectorXd damping{kIntervals - 1};
  Eigen::VectorXd stiffness{kIntervals - 1};
};

void fill_row(LoopSamples& loop, Eigen::Index row, double angle) {
  const double x = std::cos(angle);
  for (std::size_t i = 0; i < kYields.size(); ++i) {
    const double up = rising_branch(x, kYields[i]);
    const double down = falling_branch(x, kYields[i]);
    loop.half_heights(row, static_cast<Eigen::Index>(i)) = 0.5 * (up - down);
    loop.midlines(row, static_cast<Eigen::Index>(i)) = 0.5 * (up + down);
  }
  const auto basis = RisingSpline::basis(x);
  loop.rising.row(row) = Eigen::Map<const Eigen::RowVectorXd>(basis.data(), RisingSpline::kSize);
  loop.damping[row] = table_one_damping(kPaperSpeed * std::sin(angle));
  loop.stiffness[row] = table_one_stiffness(kPaperAmplitude * x);
}

SlipFit fit_slip_elements() {
  LoopSamples loop;
  for (int k = 1; k < kIntervals; ++k) {
    fill_row(loop, k - 1, k * std::numbers::pi / kIntervals);
  }
  SlipFit fit;
  fit.stiffness = nonnegative_least_squares(loop.half_heights, loop.damping);
  const Eigen::VectorXd residual = loop.half_heights * fit.stiffness - loop.damping;
  fit.misfit_percent = 100.0 * residual.norm() / std::sqrt(static_cast<double>(residual.size())) /
                       loop.damping.maxCoeff();
  fit.remainder =
      nonnegative_least_squares(loop.rising, loop.stiffness - loop.midlines * fit.stiffness);
  return fit;
}

const SlipFit& slip_fit() {
  static const SlipFit fit = fit_slip_elements();
  return fit;
}

}  // namespace

BenchTruth slip_truth(double share) {
  const SlipFit& fit = slip_fit();
  BenchTruth truth;
  truth.stiffness = [f = RisingSpline(fit.remainder)](double phi) {
    return f(phi / kPaperAmplitude);
  };
  truth.damping = no_damping;
  truth.log_modulation = no_modulation;
  for (std::size_t i = 0; i < kYields.size(); ++i) {
    const double stiffness = share * fit.stiffness[static_cast<Eigen::Index>(i)];
    truth.slip_elements.emplace_back(stiffness / kPaperAmplitude, kYields[i] * kPaperAmplitude);
  }
  return truth;
}

double slip_fit_misfit_percent() { return slip_fit().misfit_percent; }

}  // namespace flexspline::data
