#include "diagnosis/search/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "diagnosis/model/motion_error.hpp"
#include "diagnosis/model/motor_sign.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr int kBaselineSteps = 15;
constexpr int kNoisePasses = 3;         // the noise is measured on a fit that it weights
constexpr double kSmallestGain = 1e-5;  // of a sum of squares whose noise is not known
constexpr double kMostGain = 1e-3;      // of a sum of squares, however much the noise is coloured

bool touches(const ActiveCause& cause, const std::vector<Equation>& equations) {
  return std::ranges::any_of(cause.form->at,
                             [&](Equation e) { return std::ranges::count(equations, e) > 0; });
}

/// The causes of a model that act on some equations, and where they stand in it.
struct Part {
  DriveModel model;
  std::vector<std::size_t> position;
};

Part part_of(const DriveModel& model, const std::vector<Equation>& equations) {
  Part part{model, {}};
  part.model.causes.clear();
  for (std::size_t i = 0; i < model.causes.size(); ++i) {
    if (!touches(model.causes[i], equations)) continue;
    part.model.causes.push_back(model.causes[i]);
    part.position.push_back(i);
  }
  return part;
}

// What was fitted of some equations, put into the whole.
ModelFit merged(ModelFit whole, const ModelFit& fit, const Part& part,
                const std::vector<Equation>& equations) {
  for (Equation equation : equations) {
    const std::size_t e = index_of(equation);
    whole.model.own.resize(3);
    whole.model.own[e] = fit.model.own[e];
    whole.residual[e] = fit.residual[e];
    whole.prediction[e] = fit.prediction[e];
    whole.sum_of_squares[e] = fit.sum_of_squares[e];
    if (equation == Equation::torsion) whole.model.torsion_shape = fit.model.torsion_shape;
  }
  whole.model.coefficients.resize(whole.model.causes.size());
  for (std::size_t i = 0; i < part.position.size(); ++i) {
    whole.model.causes[part.position[i]] = fit.model.causes[i];
    whole.model.coefficients[part.position[i]] = fit.model.coefficients[i];
  }
  whole.evaluations += fit.evaluations;
  return whole;
}

// A step that lowers the chi square by no more is none; of the sum of squares, where noise is
// known.
double smallest_gain(const Findings& findings, const ModelFit& fit,
                     const std::vector<Equation>& equations, double smallest_fall) {
  double sum = 0.0, colour = std::numeric_limits<double>::infinity();
  for (Equation equation : equations) {
    const EquationNoise& noise = findings.noise[index_of(equation)];
    if (noise.level.empty()) return kSmallestGain;
    sum += fit.sum_of_squares[index_of(equation)];
    colour = std::min(colour, noise.colour);
  }
  return sum > 0.0 ? std::min(smallest_fall * colour / sum, kMostGain) : kSmallestGain;
}

Result<ModelFit> fit_part(const Frame& frame, const Findings& findings, const ModelFit& whole,
                          const std::vector<Equation>& equations, int steps,
                          double smallest_fall = kSearchedFall) {
  const Part part = part_of(whole.model, equations);
  auto fit = fit_model(frame, findings.fit_weight, equations, part.model, findings.reference,
                       {steps, smallest_gain(findings, whole, equations, smallest_fall)});
  if (!fit) return fit;
  return merged(whole, *fit, part, equations);
}

double rows_weighted(const Findings& findings, Equation equation) {
  return static_cast<double>((findings.weight[index_of(equation)] > 0.0).count());
}

using Noise = std::array<EquationNoise, 3>;

Noise measured_noise(const Frame& frame, const Findings& findings) {
  Noise noise;
  PerEquation of_motion = torque_of_motion_error(frame, findings.fit.model, findings.reference);
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    const ArrayXd residual = frame.judged_part(equation, findings.fit.residual[e]);
    noise[e] =
        noise_without(frame, equation, residual, std::move(of_motion[e]), findings.noise[e].level);
  }
  return noise;
}

void take_noise(const Frame& frame, Noise noise, Findings& findings) {
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    findings.weight[e] = weights_of(frame, equation, noise[e]);
    findings.fit_weight[e] = weights_of_fit(frame, findings.weight[e], noise[e].alike);
  }
  findings.noise = std::move(noise);
  findings.fit.model.sign_shares = fitted_sign(frame, findings.fit, findings.reference,
                                               findings.weight[index_of(Equation::motor)]);
  findings.reference = reference_of(frame, findings.fit.model);
}

// Weights that hardly change do not change the fit.
bool are_settled(const Frame& frame, const Noise& now, const Noise& before) {
  return std::ranges::all_of(frame.equations, [&](Equation equation) {
    const std::size_t e = index_of(equation);
    return now[e].alike == before[e].alike && is_settled(now[e].colour, before[e].colour) &&
           std::ranges::equal(now[e].level, before[e].level, is_settled);
  });
}

}  // namespace

std::vector<Equation> linked_equations(const Frame& frame, const std::vector<ActiveCause>& causes,
                                       const CauseForm& form) {
  std::set<Equation> reached;
  for (Equation e : form.at) {
    if (frame.has(e)) reached.insert(e);
  }
  for (bool grown = true; grown;) {
    const std::size_t before = reached.size();
    for (const ActiveCause& cause : causes) {
      const bool touches =
          std::ranges::any_of(cause.form->at, [&](Equation e) { return reached.contains(e); });
      for (Equation e : cause.form->at) {
        if (touches && frame.has(e)) reached.insert(e);
      }
    }
    grown = reached.size() > before;
  }
  return {reached.begin(), reached.end()};
}

Result<void> fit_all(const Frame& frame, Findings& findings, int steps, double smallest_fall) {
  ModelFit whole = findings.fit;
  std::set<Equation> done;
  for (Equation equation : frame.equations) {
    if (done.contains(equation)) continue;
    CauseForm alone;
    alone.at = {equation};
    const auto group = linked_equations(frame, whole.model.causes, alone);
    auto fit = fit_part(frame, findings, whole, group, steps, smallest_fall);
    if (!fit) return tl::unexpected(fit.error());
    whole = std::move(*fit);
    done.insert(group.begin(), group.end());
  }
  findings.fit = std::move(whole);
  return {};
}

double chi_square(const Frame& frame, const Findings& findings, const ModelFit& fit) {
  double sum = 0.0;
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    sum += fit.sum_of_squares[e] / findings.noise[e].colour;
  }
  return sum;
}

double excess(const Frame& frame, const Findings& findings, const ModelFit& fit) {
  double sum = 0.0;
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    const double beyond = fit.sum_of_squares[e] - rows_weighted(findings, equation);
    sum += std::max(beyond, 0.0) / findings.noise[e].colour;
  }
  return sum;
}

Result<void> refresh(const Frame& frame, Findings& findings, int steps) {
  for (int pass = 0; pass < kNoisePasses; ++pass) {
    Noise noise = measured_noise(frame, findings);
    if (pass > 0 && are_settled(frame, noise, findings.noise)) return {};
    take_noise(frame, std::move(noise), findings);
    const auto fitted = fit_all(frame, findings, steps);
    if (!fitted) return fitted;
  }
  return {};
}

Result<Findings> fit_baseline(const Frame& frame) {
  Findings findings;
  findings.fit.model = first_guess(frame);
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    findings.weight[e] = findings.fit_weight[e] = frame.rows_of(equation);
  }
  findings.reference = reference_of(frame, findings.fit.model);
  for (Equation equation : frame.equations) {
    auto fit = fit_part(frame, findings, findings.fit, {equation}, kBaselineSteps);
    if (!fit) return tl::unexpected(fit.error());
    findings.fit = std::move(*fit);
  }
  const auto done = refresh(frame, findings, kBaselineSteps);
  if (!done) return tl::unexpected(done.error());
  return findings;
}

Result<ModelFit> extended(const Frame& frame, const Findings& findings, const ActiveCause& cause,
                          int steps) {
  ModelFit whole = findings.fit;
  whole.model.causes.push_back(cause);
  return fit_part(frame, findings, whole, linked_equations(frame, whole.model.causes, *cause.form),
                  steps);
}

Result<ModelFit> by_its_own_laws(const Frame& frame, Findings findings, const ModelFit& fit,
                                 int steps) {
  findings.reference = reference_of(frame, fit.model);
  return fit_part(frame, findings, fit,
                  linked_equations(frame, fit.model.causes, *fit.model.causes.back().form), steps);
}

Result<ModelFit> reduced(const Frame& frame, const Findings& findings, std::size_t cause, int steps,
                         double smallest_fall) {
  ModelFit whole = findings.fit;
  const auto equations =
      linked_equations(frame, whole.model.causes, *whole.model.causes[cause].form);
  whole.model.causes.erase(whole.model.causes.begin() + static_cast<long>(cause));
  whole.model.coefficients.erase(whole.model.coefficients.begin() + static_cast<long>(cause));
  return fit_part(frame, findings, whole, equations, steps, smallest_fall);
}

}  // namespace flexspline::studies
