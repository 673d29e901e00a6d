#include "diagnosis/rate_error.hpp"

namespace flexspline::studies {

PerEquation torque_of_rate_error(const Frame& frame, const DriveModel& model,
                                 const Reference& reference) {
  PerEquation torque;
  if (!frame.has(Equation::torsion) || frame.torsion_rate_error.size() == 0) return torque;
  Frame other = frame;
  other.kept.reset();  // columns of the motion as it was
  other.torsion_rate = frame.torsion_rate + frame.torsion_rate_error;
  const PerEquation above = evaluate(other, model, reference).residual;
  other.torsion_rate = frame.torsion_rate - frame.torsion_rate_error;
  const PerEquation below = evaluate(other, model, reference).residual;
  for (std::size_t e = 0; e < torque.size(); ++e) torque[e] = 0.5 * (above[e] - below[e]).abs();
  return torque;
}

}  // namespace flexspline::studies
