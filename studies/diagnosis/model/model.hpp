#pragma once

#include <array>
#include <optional>
#include <vector>

#include "diagnosis/model/cause.hpp"
#include "flexspline/estimators/separable.hpp"

namespace flexspline::studies {

/// A cause taken into the model, with the shapes it has there.
struct ActiveCause {
  const CauseRow* row = nullptr;
  const CauseForm* form = nullptr;
  std::vector<double> shape;
};

/// One value an equation: weights of rows, residuals.
using PerEquation = std::array<Eigen::ArrayXd, 3>;

inline std::size_t index_of(Equation equation) { return static_cast<std::size_t>(equation); }

/// The baseline and causes, as fitted. Baseline: torsion tau = f(phi) + g^-1(phi'/h(phi)), f and
/// g^-1 odd and rising, ln h = c1 x^2 + c2 x^4, phi from a zero of its own, with an offset on a
/// specimen; a travelling
/// specimen f(angle) free, dry friction of several widths and viscous friction; load tau = J2
/// theta_l'' + B2 theta_l'; motor tau_m = J1 theta_m'' + B1 theta_m' + tau/N and dry friction, a
/// mixture of tanh(theta_m'/w).
struct DriveModel {
  std::vector<double> torsion_shape;  ///< c1, c2, zero; travelling: none
  std::vector<ActiveCause> causes;
  std::vector<Eigen::VectorXd> own;           ///< linear coefficients of the baseline by equation
  std::vector<Eigen::VectorXd> coefficients;  ///< of each cause
  Eigen::VectorXd sign_shares{};  ///< fitted_sign(); empty: of the baseline's dry friction
};

struct ModelFit {
  DriveModel model;
  PerEquation residual;                    ///< measured less predicted, all rows
  PerEquation prediction;                  ///< of the measured torque
  std::array<double, 3> sum_of_squares{};  ///< weighted, over the rows that were fitted
  int free_parameters = 0;                 ///< those not on a bound, shapes included
  int evaluations = 0;
};

/// When a fit ends.
struct Effort {
  int most_steps = 0;           ///< of the shapes; 0: those given
  double smallest_gain = 1e-5;  ///< of the sum of squares: a step that gains less is the last
};

/// The model before anything is known of the recordings.
DriveModel first_guess(const Frame& frame);

/// Fits baseline and causes to the rows with a weight: linear parameters exactly, shapes by
/// steps. Equations that no cause links are independent of each
/// other; only those listed are fitted, the others of the result are empty.
/// Errors: numerics, recordings with values out of range.
Result<ModelFit> fit_model(const Frame& frame, const PerEquation& weight,
                           const std::vector<Equation>& equations, const DriveModel& start,
                           const Reference& reference, const Effort& effort);

/// The model's residuals on all rows of a frame, its parameters as they are.
ModelFit evaluate(const Frame& frame, const DriveModel& model, const Reference& reference);

/// The baseline's laws along the rows.
Reference reference_of(const Frame& frame, const DriveModel& model);

/// What a cause adds to the prediction of an equation, all rows.
Eigen::ArrayXd contribution(const Frame& frame, const DriveModel& model, const Reference& reference,
                            std::size_t cause, Equation equation);

/// The largest of that over the largest torque of its equation, over usable rows.
double share_of_torque(const Frame& frame, const DriveModel& model, const Reference& reference,
                       std::size_t cause);

/// The largest difference of two fits' predictions in the equations of a form, over the largest
/// torque of its equation, over usable rows.
double change_of_torque(const Frame& frame, const CauseForm& form, const ModelFit& with,
                        const ModelFit& without);

/// Equations that the causes act on, closed under links between them.
std::vector<Equation> equations_touched(const Frame& frame, const std::vector<ActiveCause>& causes);

}  // namespace flexspline::studies
