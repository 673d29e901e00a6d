#pragma once

#include "flexspline/core/signals.hpp"
#include "flexspline/estimators/given_parameters.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

/// A recording along which a given model's torque is simulated.
struct GivenRecord {
  TorsionRecord record;
  Motion motion;                  ///< reconstructed, with what has no residual: memories need it
  std::vector<std::size_t> rows;  ///< samples that get a residual
  std::vector<double> weight;     ///< of each residual: the root of the samples it stands for,
                                  ///< over what its error is relative to
};

/// How much an error of the torque counts.
enum class ErrorWeight {
  even,      ///< wherever it occurs
  relative,  ///< over the torque measured there, or a tenth of all recordings' root mean square
};

/// Of each record at most most_path samples are simulated, evenly spread, and at most most_rows of
/// those get a residual; invalid samples none. Thinning is made good by weights, so that it does
/// not matter to what a valid sample counts; the squares of the weights are one in the mean over
/// all residuals. Errors: numerics, where a motion cannot be reconstructed.
Result<std::vector<GivenRecord>> given_records(const std::vector<TorsionRecord>& records,
                                               std::size_t most_rows, std::size_t most_path,
                                               ErrorWeight weight = ErrorWeight::even);

/// Root mean square of the torque measured where there are residuals, Nm (N).
double rms_effort(const std::vector<GivenRecord>& records);

/// Measured less simulated torque, Nm (N), times the weights of the recording, of a given model: a
/// block a recording. Unknowns: the parameters that are not held, then (each_zero) where every
/// recording's motion has its zero: within the longest recorded motion of its own. The Jacobian is
/// by central differences, one-sided at a bound.
class GivenResiduals final : public LeastSquaresProblem {
 public:
  GivenResiduals(const ModelSpec& model, std::vector<GivenParameter> parameters,
                 const std::vector<GivenRecord>& records, bool each_zero);

  std::size_t blocks() const override { return records_.size(); }
  std::size_t residuals(std::size_t block) const override { return records_[block].rows.size(); }
  Result<void> evaluate(std::size_t block, std::span<const double> q, std::span<double> residual,
                        std::span<double> jacobian) const override;

  /// Every unknown with its name, start and bounds.
  const std::vector<GivenParameter>& unknowns() const { return unknowns_; }
  std::size_t of_model() const { return free_.size(); }
  ModelSpec model_at(std::span<const double> q) const;
  /// What the model predicts at the rows of a block.
  Result<std::vector<double>> predict(std::size_t block, std::span<const double> q) const;
  std::vector<double> measured(std::size_t block) const;
  const std::vector<double>& weight(std::size_t block) const { return records_[block].weight; }
  /// A step of an unknown that is small against its size, yet seen through rounding.
  double step(std::size_t unknown, std::span<const double> q) const;
  /// Typical sizes of the unknowns, for steps where they are near zero.
  void set_sizes(std::vector<double> sizes) { sizes_ = std::move(sizes); }

 private:
  bool acts(std::size_t unknown, std::size_t block) const {
    return unknown < free_.size() || unknown - free_.size() == block;
  }

  ModelSpec model_;
  std::vector<double> values_;     ///< of all parameters of the model
  std::vector<std::size_t> free_;  ///< which of them are unknowns
  std::vector<GivenParameter> unknowns_;
  std::vector<double> sizes_;
  const std::vector<GivenRecord>& records_;
};

}  // namespace flexspline::estimators
