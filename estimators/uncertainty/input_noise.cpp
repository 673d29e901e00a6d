#include "uncertainty/input_noise.hpp"

#include <cmath>

#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

// sum_i J_i d r_i / d tau_m for every instant m: the adjoint of the linearised equation, backwards.
Eigen::MatrixXd response_to_input(const PreparedRecord& one,
                                  const TorsionResiduals::InputResponse& input,
                                  const Eigen::MatrixXd& jacobian) {
  const std::size_t n = one.record.time.size();
  Eigen::MatrixXd response = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), jacobian.cols());
  Eigen::RowVectorXd adjoint = Eigen::RowVectorXd::Zero(jacobian.cols());
  std::size_t row = one.rows.size();
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) {
      const double dt = one.record.time[i + 1] - one.record.time[i];
      const double z = 0.5 * (input.decay[i] + input.decay[i + 1]) * dt;
      const double gain = 0.5 * (input.gain[i] + input.gain[i + 1]) * dt;
      const double held = std::abs(z) > 1e-9 ? std::expm1(z) / z : 1.0;
      response.row(static_cast<Eigen::Index>(i)) = gain * held * adjoint;
      adjoint *= std::exp(z);
    }
    if (row > 0 && one.rows[row - 1] == i) {
      --row;
      adjoint += jacobian.row(static_cast<Eigen::Index>(row)) / one.motion_sigma;
    }
  }
  return response;
}

std::vector<double> effort_residual(const PreparedRecord& one) {
  std::vector<double> residual(one.record.effort.size());
  for (std::size_t i = 0; i < residual.size(); ++i) {
    residual[i] = one.record.effort[i] - one.smooth.effort[i];
  }
  return residual;
}

}  // namespace

Result<Eigen::MatrixXd> input_noise_covariance(const TorsionResiduals& problem,
                                               const std::vector<PreparedRecord>& records,
                                               const Linearisation& at,
                                               std::span<const double> p) {
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(at.jacobian.cols(), at.jacobian.cols());
  Eigen::Index row = 0;
  for (std::size_t b = 0; b < records.size(); ++b) {
    const auto height = static_cast<Eigen::Index>(records[b].rows.size());
    const auto input = problem.input_response(b, p);
    if (!input) return tl::unexpected(input.error());
    const Eigen::MatrixXd response =
        response_to_input(records[b], *input, at.jacobian.middleRows(row, height));
    const double sigma = records[b].effort_sigma;
    const double variance = sigma * sigma * long_run_ratio(effort_residual(records[b]));
    middle += variance * response.transpose() * response;
    row += height;
  }
  return middle;
}

}  // namespace flexspline::estimators
