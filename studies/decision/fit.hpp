#pragma once

#include "decision/system.hpp"

namespace flexspline::studies::decision {

/// A state with its variances, and what speaks for it.
struct Fit {
  DriveState state;
  std::vector<Eigen::VectorXd> ratio;  ///< variance over noise, by equation and component
  DriveState built;                    ///< the state that the system is about
  System system;
  VarianceFit variances;
  double log_likelihood = 0.0;
  /// Log likelihood less half a ln n for every parameter of the causes, and less what is set
  /// against a function without a name for every component of the remainder.
  double score = 0.0;
  int parameters = 0;
  int components = 0;  ///< of the remainder that have a variance
};

/// Prior odds of a catalogued cause over a nameless function that does as well, natural logarithm.
inline constexpr double kNameless = 30.0;

/// Whether the discrepancy's components may have a variance; without, they are left out.
enum class Remainder { estimated, none };

/// Gauss and Newton on the nonlinear parameters, damped, with the variances estimated on the way.
/// ratio: where they start; empty: the baseline's laws first, then the rest from near 0.
Fit fit_state(const Bench& bench, DriveState state, std::vector<Eigen::VectorXd> ratio, int passes,
              Remainder remainder = Remainder::estimated);

/// Without the components of the remainder that are not worth kNameless.
void prune(const Bench& bench, Fit& fit);

/// The fit from another one's, whose variances are at least this share of what they were there.
Fit refit(const Bench& bench, const Fit& from, DriveState state, int passes);

/// Columns that a cause's coefficients have, and shapes: what a model pays for it.
int parameters_of(const Taken& cause);

/// What is left of an equation when fixed effects, causes and nuisances are taken out (the
/// remainder and the noise), and the remainder's predictor: rows that count.
Eigen::VectorXd unexplained(const Bench& bench, const Fit& fit, std::size_t equation);
Eigen::VectorXd remainder(const Bench& bench, const Fit& fit, std::size_t equation);

/// What one component predicts.
Eigen::VectorXd part_of(const Bench& bench, const Fit& fit, std::size_t equation,
                        std::size_t component);

/// Noise anew: by the residual about the whole model or about all but the remainder, whichever has
/// the greater marginal likelihood; and the fit with it.
Fit with_fitted_noise(Bench& bench, Fit fit);

}  // namespace flexspline::studies::decision
