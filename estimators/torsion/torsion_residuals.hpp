#pragma once

#include <vector>

#include "flexspline/core/simulate.hpp"
#include "torsion/innovation_filter.hpp"
#include "torsion/layout.hpp"
#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// Torque-driven, eq. (3): phi' = h(phi) g(tau - o - J phi'' - f(phi)) is integrated over the whole
/// record from its initial torsion, with the smooth torque as input and forward sensitivities; the
/// residuals are the innovations of phi simulated + zero - reconstructed, a block a record. phi''
/// is the measured one.
class TorsionResiduals final : public LeastSquaresProblem {
 public:
  TorsionResiduals(const TorsionLayout& layout, const std::vector<PreparedRecord>& records,
                   IntegratorSettings settings)
      : layout_(layout), records_(records), settings_(settings) {}

  /// Fixes the filters that weigh the residuals, at p. Call it before evaluate.
  /// Errors: numerics, where a record cannot be integrated there.
  Result<void> weigh(std::span<const double> p);

  std::size_t blocks() const override { return records_.size(); }
  std::size_t residuals(std::size_t block) const override { return records_[block].rows.size(); }
  Result<void> evaluate(std::size_t block, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override;

 private:
  const TorsionLayout& layout_;
  const std::vector<PreparedRecord>& records_;
  IntegratorSettings settings_;
  std::vector<InnovationFilter> filters_;
};

}  // namespace flexspline::estimators
