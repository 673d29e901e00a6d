#pragma once

#include <vector>

#include "flexspline/core/simulate.hpp"
#include "torsion/layout.hpp"
#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// Torque-driven, eq. (3): phi' = h(phi) g(tau - o - J phi'' - f(phi)) is integrated over the whole
/// record from its initial torsion, with the smooth torque as input and forward sensitivities;
/// residual (phi simulated + zero - measured) / sigma, a block a record. phi'' is the measured one.
class TorsionResiduals final : public LeastSquaresProblem {
 public:
  TorsionResiduals(const TorsionLayout& layout, const std::vector<PreparedRecord>& records,
                   IntegratorSettings settings)
      : layout_(layout), records_(records), settings_(settings) {}

  std::size_t blocks() const override { return records_.size(); }
  std::size_t residuals(std::size_t block) const override { return records_[block].rows.size(); }
  Result<void> evaluate(std::size_t block, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override;

  /// dF/dphi and dF/dtau of phi' = F along a trajectory: how noise of the torque enters.
  struct InputResponse {
    std::vector<double> decay;  ///< 1/s, negative
    std::vector<double> gain;   ///< rad/s per Nm
  };
  Result<InputResponse> input_response(std::size_t block, std::span<const double> p) const;

 private:
  const TorsionLayout& layout_;
  const std::vector<PreparedRecord>& records_;
  IntegratorSettings settings_;
};

}  // namespace flexspline::estimators
