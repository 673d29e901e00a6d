#pragma once

#include <vector>

#include "torsion/layout.hpp"
#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// Displacement-driven, eq. (4): (tau measured - simulated along the reconstructed motion) / sigma,
/// a block a record. Linear in all but h, delay and zeros.
class TorqueResiduals final : public LeastSquaresProblem {
 public:
  TorqueResiduals(const TorsionLayout& layout, const std::vector<PreparedRecord>& records)
      : layout_(layout), records_(records) {}

  std::size_t blocks() const override { return records_.size(); }
  std::size_t residuals(std::size_t block) const override { return records_[block].rows.size(); }
  Result<void> evaluate(std::size_t block, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override;
  /// d tau / d phi of the model at the rows of a record, Nm/rad: how noise of the motion enters.
  Result<std::vector<double>> motion_slope(std::size_t block, std::span<const double> p) const;

 private:
  const TorsionLayout& layout_;
  const std::vector<PreparedRecord>& records_;
};

}  // namespace flexspline::estimators
