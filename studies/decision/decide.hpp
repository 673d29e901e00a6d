#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "decision/search.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies::decision {

/// A cause that is named, with its class.
struct Named {
  std::size_t cause = 0;                  ///< of the model
  double gain = 0.0;                      ///< of score over the model without it
  double probability = 0.0;               ///< of its class
  double size = 0.0;                      ///< largest of what it adds, over the largest torque
  std::vector<std::string> alternatives;  ///< the others of its class, at most two
  double stability = kNotComputed;        ///< share of outer folds that name it or one of them
};

/// Where the fit of a stage differs from the recordings: a coordinate of an equation.
struct Located {
  Equation equation = Equation::torsion;
  std::string coordinate;
  std::string says;
  double share = 0.0;       ///< of the mean square of all components
  double size = 0.0;        ///< 99th percentile over the largest torque
  std::size_t segment = 0;  ///< where it is largest
  double from_s = 0.0;
  double to_s = 0.0;
};

/// An interval of one recording whose innovations stand out.
struct Burst {
  Equation equation = Equation::torsion;
  std::size_t segment = 0;
  Eigen::Index first = 0;  ///< row of the frame
  Eigen::Index count = 0;
  double ratio = 0.0;  ///< of its power over the recording's
  double size = 0.0;   ///< root mean square beyond the noise, over the largest torque
};

/// What is left when the causes are in.
struct Left {
  double size = 0.0;  ///< 99th percentile of its predictor over the largest torque
  bool real = false;  ///< a component is worth more than a name would have to be, and it matters
};

struct Decision {
  Bench bench;
  Fit baseline;
  Fit fit;
  std::vector<Named> named;
  std::vector<Candidate> tried;  ///< of the last round
  std::vector<Located> located;  ///< in the baseline's fit
  std::vector<Located> remains;  ///< in the last one
  std::optional<Burst> burst;
  Left left;
};

/// The steps of the decision on the rows of one frame: noise, locate, name, class, abstain.
Decision decide(const Frame& frame, const Calibration& calibration, unsigned threads,
                const DiagnosisProgress& progress);

std::vector<Located> locate(const Bench& bench, const Fit& fit);
std::optional<Burst> find_burst(const Bench& bench, const Fit& fit, const Calibration& calibration);
Left what_is_left(const Bench& bench, const Fit& fit, const Calibration& calibration);
std::vector<Named> name_causes(const Bench& bench, const Fit& fit, const Calibration& calibration);

}  // namespace flexspline::studies::decision
