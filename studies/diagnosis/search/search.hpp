#pragma once

#include <string>
#include <vector>

#include "diagnosis/model/model.hpp"
#include "diagnosis/model/noise.hpp"

namespace flexspline::studies {

/// Of the shapes, in a fit that starts from one of nearly the same model.
inline constexpr int kRefreshSteps = 8;

/// What is known of a drive at a stage of the search.
struct Findings {
  ModelFit fit;
  Reference reference;
  std::array<EquationNoise, 3> noise;
  PerEquation weight;      ///< of every usable row
  PerEquation fit_weight;  ///< of those that a fit looks at
};

/// A cause tried on top of the findings, shapes refined.
struct Trial {
  ActiveCause cause;
  ModelFit fit{};         ///< the whole model with it
  double gain = 0.0;      ///< fall of the chi square
  double net_gain = 0.0;  ///< less what as many parameters and that search gain on noise
  int parameters = 0;
  double removed = 0.0;  ///< share of the misfit beyond noise, at most 1
  double size = 0.0;     ///< largest contribution over the largest torque of its equation
  double change = 0.0;   ///< largest change of the prediction over the same: what is seen of it
};

/// Fall of the chi square by which a step of a fit is worth another: in the search, where a limit
/// of 18 is not told from 18.1, and of a fit that is judged or printed, a seventh of a deviation.
constexpr double kSearchedFall = 0.1;
constexpr double kJudgedFall = 0.02;

/// The equations whose fit a form and a set of causes tie together.
std::vector<Equation> linked_equations(const Frame& frame, const std::vector<ActiveCause>& causes,
                                       const CauseForm& form);

/// The baseline, weighted by the noise that it leaves.
Result<Findings> fit_baseline(const Frame& frame);

/// Weights, colour and reference anew from the residuals of the fit, and the fit with them.
Result<void> refresh(const Frame& frame, Findings& findings, int steps);

/// Every parameter of the model fitted anew with the weights that stand.
Result<void> fit_all(const Frame& frame, Findings& findings, int steps,
                     double smallest_fall = kSearchedFall);

/// The fit with one more cause; equations that it does not touch stay as they are.
Result<ModelFit> extended(const Frame& frame, const Findings& findings, const ActiveCause& cause,
                          int steps);

/// A fit whose last cause changes the motion once more, its causes by the laws along the motion as
/// it has become: what goes by a law was held against that before the change.
Result<ModelFit> by_its_own_laws(const Frame& frame, Findings findings, const ModelFit& fit,
                                 int steps);

/// The fit of the same model without one of its causes.
Result<ModelFit> reduced(const Frame& frame, const Findings& findings, std::size_t cause, int steps,
                         double smallest_fall = kSearchedFall);

/// One cause on top of the findings, its shapes refined from those given; no gain where its fit
/// fails. Its net gain has no penalty for a search.
Trial try_cause(const Frame& frame, const Findings& findings, const ActiveCause& cause);

/// Every cause and part of the baseline that is not yet in the model, best net gain first; one
/// entry each. The same for any number of threads; 0: as many as the machine has.
std::vector<Trial> try_causes(const Frame& frame, const Findings& findings, unsigned threads = 0);

/// Sums of squares of a fit over the noise's colour, all equations.
double chi_square(const Frame& frame, const Findings& findings, const ModelFit& fit);

/// Misfit beyond noise, in chi square, summed over the equations.
double excess(const Frame& frame, const Findings& findings, const ModelFit& fit);

}  // namespace flexspline::studies
