#include "diagnosis/unnamed/unnamed_proof.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/frame/folds.hpp"
#include "diagnosis/proof/held_out_error.hpp"

namespace flexspline::studies {

using Eigen::ArrayXd;

HoldoutProof proof_of_part(const Frame& frame, const Findings& final, const Proof& proof,
                           Equation equation, const PartOfFold& part) {
  const std::size_t e = index_of(equation);
  const auto folds = folds_of(frame);
  ArrayXd before = ArrayXd::Zero(frame.rows()), after = before, held = before;
  for (std::size_t k = 0; k < folds.size(); ++k) {
    const ArrayXd rows = folds[k] * frame.rows_of(equation);
    const ArrayXd& residual = proof.by_fold[k].residual[e];
    held += rows;
    before += residual * rows;
    after += (residual - part(proof.by_fold[k], final.weight[e] * (1.0 - folds[k]))) * rows;
  }
  before = as_noise_alone(frame, final.noise[e], before);
  after = as_noise_alone(frame, final.noise[e], after);
  HoldoutProof h;
  h.rmse_before = rms_on(before, held);
  h.rmse_after = rms_on(after, held);
  h.ratio = h.rmse_after / h.rmse_before;
  h.noise_floor = noise_of(frame, final.noise[e], after, held);
  take_interval(frame, held, before, after, h);
  return h;
}

double taken_by_part(const HoldoutProof& h) {
  return std::sqrt(std::max(h.rmse_before * h.rmse_before - h.rmse_after * h.rmse_after, 0.0));
}

bool is_proved_part(const Frame& frame, const HoldoutProof& part, Equation equation,
                    const Limits& limits) {
  return part.ci95_upper < 1.0 &&
         taken_by_part(part) > limits.trifle() * frame.largest_torque(equation);
}

}  // namespace flexspline::studies
