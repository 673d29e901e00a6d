#include "diagnosis/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "flexspline/core/estimate.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr int kBaselineSteps = 15;
constexpr int kFirstSteps = 3;
constexpr int kRefineSteps = 4;
constexpr int kFinishSteps = 12;
constexpr int kNoisePasses = 3;           // the noise is measured on a fit that it weights
constexpr double kWorthRefining = 0.03;   // of the best first gain
constexpr double kWorthFinishing = 0.3;   // of the best gain when refined
constexpr std::size_t kMostRefined = 12;  // the best was never beyond the seventh in 188 searches
constexpr std::size_t kMostThreads = 8;

// Equations whose fit a set of causes ties together, from those of one cause outward.
std::vector<Equation> linked(const Frame& frame, const std::vector<ActiveCause>& causes,
                             const ActiveCause& seed) {
  std::set<Equation> reached;
  for (Equation e : seed.form->at) {
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

Result<ModelFit> fit_part(const Frame& frame, const Findings& findings, const ModelFit& whole,
                          const std::vector<Equation>& equations, int steps) {
  const Part part = part_of(whole.model, equations);
  auto fit =
      fit_model(frame, findings.fit_weight, equations, part.model, findings.reference, steps);
  if (!fit) return fit;
  return merged(whole, *fit, part, equations);
}

double on_grid(const Shape& s, double share) {
  return s.logarithmic ? s.lower * std::pow(s.upper / s.lower, share)
                       : s.lower + share * (s.upper - s.lower);
}

// The first shape on its grid, the others in the middle of theirs.
std::vector<std::vector<double>> starts(const CauseForm& form, const Frame& frame) {
  if (form.shapes == nullptr) return {{}};
  if (form.start != nullptr) return {form.start(frame)};
  const auto shapes = form.shapes(frame);
  const Shape& first = shapes.front();
  std::vector<double> middle;
  for (const Shape& s : shapes) middle.push_back(on_grid(s, 0.5));
  std::vector<std::vector<double>> list;
  const int count = first.discrete ? static_cast<int>(first.upper - first.lower) + 1 : first.grid;
  for (int k = 0; k < count; ++k) {
    list.push_back(middle);
    list.back().front() = first.discrete ? first.lower + k : on_grid(first, (k + 0.5) / count);
  }
  return list;
}

double chi_square(const Findings& findings, const ModelFit& fit, const Frame& frame) {
  double sum = 0.0;
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    sum += fit.sum_of_squares[e] / findings.noise[e].colour;
  }
  return sum;
}

int parameters_of(const ActiveCause& cause, const ModelFit& fit) {
  const Eigen::VectorXd& a = fit.model.coefficients.back();
  int count = static_cast<int>(cause.shape.size());
  for (Eigen::Index k = 0; k < a.size(); ++k) count += a[k] != 0.0 ? 1 : 0;
  return std::max(count, 1);
}

double size_of(const Frame& frame, const Findings& findings, const Trial& trial) {
  double size = 0.0;
  for (Equation equation : trial.cause.form->at) {
    if (!frame.has(equation)) continue;
    const ArrayXd part = contribution(frame, trial.fit.model, findings.reference,
                                      trial.fit.model.causes.size() - 1, equation);
    size = std::max(size, (part.abs() * frame.usable).maxCoeff() / frame.largest_torque(equation));
  }
  return size;
}

// What the baseline does not take back of a cause.
double change_of(const Frame& frame, const Findings& findings, const Trial& trial) {
  double change = 0.0;
  for (Equation equation : trial.cause.form->at) {
    if (!frame.has(equation)) continue;
    const std::size_t e = index_of(equation);
    const ArrayXd part = trial.fit.prediction[e] - findings.fit.prediction[e];
    change =
        std::max(change, (part.abs() * frame.usable).maxCoeff() / frame.largest_torque(equation));
  }
  return change;
}

double rows_weighted(const Findings& findings, Equation equation) {
  return static_cast<double>((findings.weight[index_of(equation)] > 0.0).count());
}

double effective_rows(const Frame& frame, const Findings& findings, const CauseForm& form) {
  double rows = 0.0;
  for (Equation e : form.at) {
    if (frame.has(e)) rows += rows_weighted(findings, e) / findings.noise[index_of(e)].colour;
  }
  return rows;
}

/// A form at the best of its starts.
struct FirstLook {
  const CauseRow* row;
  const CauseForm* form;
  std::vector<double> shape;
  double gain = -1.0;
  std::size_t tried = 0;
};

FirstLook first_look(const Frame& frame, const Findings& findings, const CauseRow& row,
                     const CauseForm& form) {
  FirstLook look{&row, &form, {}, -1.0, 0};
  const double before = chi_square(findings, findings.fit, frame);
  for (auto& shape : starts(form, frame)) {
    ++look.tried;
    // A change of the motion starts from next to nothing: a few steps show what it is worth.
    const int steps = form.start != nullptr ? kFirstSteps : 0;
    const auto fit = extended(frame, findings, {&row, &form, shape}, steps);
    if (!fit) continue;
    const double gain = before - chi_square(findings, *fit, frame);
    if (gain > look.gain || look.shape.empty()) {
      look.gain = std::max(gain, look.gain);
      look.shape = std::move(shape);
    }
  }
  return look;
}

/// What the search over starts and causes gains on noise alone, in chi square.
double search_penalty(std::size_t tried) { return 2.0 * std::log(static_cast<double>(tried)); }

// A change of the motion asks for another h: the fit from where nothing of it is known.
Result<ModelFit> from_scratch(const Frame& frame, Findings findings, const ActiveCause& cause) {
  findings.fit.model.torsion_shape = first_guess(frame).torsion_shape;
  return extended(frame, findings, cause, kRefineSteps);
}

void take_better(Result<ModelFit>& fit, Result<ModelFit> other) {
  const auto total = [](const Result<ModelFit>& f) {
    return f ? f->sum_of_squares[0] + f->sum_of_squares[1] + f->sum_of_squares[2]
             : std::numeric_limits<double>::infinity();
  };
  if (total(other) < total(fit)) fit = std::move(other);
}

// What a fit with a cause gains, and how large that cause is in it.
Trial judged(const Frame& frame, const Findings& findings, ModelFit fit, std::size_t tried) {
  Trial trial{.cause = fit.model.causes.back(), .fit = std::move(fit)};
  trial.parameters = parameters_of(trial.cause, trial.fit);
  trial.gain = chi_square(findings, findings.fit, frame) - chi_square(findings, trial.fit, frame);
  trial.net_gain = trial.gain - search_penalty(tried) -
                   trial.parameters * std::log(effective_rows(frame, findings, *trial.cause.form));
  const double misfit = excess(frame, findings, findings.fit);
  trial.removed = misfit > 0.0 ? std::clamp(trial.gain / misfit, 0.0, 1.0) : kNotComputed;
  trial.size = size_of(frame, findings, trial);
  trial.change = change_of(frame, findings, trial);
  return trial;
}

Trial refined(const Frame& frame, const Findings& findings, const FirstLook& look,
              std::size_t tried) {
  const ActiveCause cause{look.row, look.form, look.shape};
  auto fit = extended(frame, findings, cause, kRefineSteps);
  if (look.form->transform != nullptr) take_better(fit, from_scratch(frame, findings, cause));
  return fit ? judged(frame, findings, std::move(*fit), tried) : Trial{.cause = cause};
}

// The same fit to its end.
void finish(const Frame& frame, const Findings& findings, std::size_t tried, Trial& trial) {
  auto fit = fit_part(frame, findings, trial.fit,
                      linked(frame, trial.fit.model.causes, trial.cause), kFinishSteps);
  if (fit) trial = judged(frame, findings, std::move(*fit), tried);
}

std::size_t searchers(unsigned wanted) {
  return wanted > 0 ? wanted : std::min(threads_for(0), kMostThreads);
}

std::vector<FirstLook> look_at_all(const Frame& frame, const Findings& findings, unsigned threads) {
  std::vector<FirstLook> looks;
  for (const auto rows : {causes(), baseline_parts()}) {
    for (const CauseRow& row : rows) {
      const bool present = std::ranges::any_of(findings.fit.model.causes,
                                               [&](const ActiveCause& c) { return c.row == &row; });
      if (present) continue;
      for (const CauseForm* form : forms_on(row, frame)) looks.push_back({&row, form, {}, -1.0, 0});
    }
  }
  in_parallel(looks.size(), searchers(threads), [&](std::size_t i) {
    looks[i] = first_look(frame, findings, *looks[i].row, *looks[i].form);
  });
  return looks;
}

void keep_best_of_each(std::vector<Trial>& trials) {
  std::ranges::stable_sort(trials, std::ranges::greater{}, &Trial::net_gain);
  std::vector<Trial> best;
  for (Trial& trial : trials) {
    const bool known =
        std::ranges::any_of(best, [&](const Trial& t) { return t.cause.row == trial.cause.row; });
    if (!known) best.push_back(std::move(trial));
  }
  trials = std::move(best);
}

void measure_noise(const Frame& frame, Findings& findings) {
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    findings.noise[e].level = noise_levels(frame, findings.fit.residual[e]);
    findings.noise[e].colour = noise_colour(frame, findings.fit.residual[e]);
    findings.noise[e].alike = rows_alike(frame, findings.fit.residual[e]);
    findings.weight[e] = weights_of(frame, findings.noise[e].level);
    findings.fit_weight[e] = weights_of_fit(frame, findings.weight[e], findings.noise[e].alike);
  }
  findings.reference = reference_of(frame, findings.fit.model);
}

}  // namespace

Result<void> fit_all(const Frame& frame, Findings& findings, int steps) {
  ModelFit whole = findings.fit;
  std::set<Equation> done;
  for (Equation equation : frame.equations) {
    if (done.contains(equation)) continue;
    CauseForm alone;
    alone.at = {equation};
    const auto group = linked(frame, whole.model.causes, {nullptr, &alone, {}});
    auto fit = fit_part(frame, findings, whole, group, steps);
    if (!fit) return tl::unexpected(fit.error());
    whole = std::move(*fit);
    done.insert(group.begin(), group.end());
  }
  findings.fit = std::move(whole);
  return {};
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
    measure_noise(frame, findings);
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
    findings.weight[e] = findings.fit_weight[e] = frame.usable;
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
  return fit_part(frame, findings, whole, linked(frame, whole.model.causes, cause), steps);
}

Result<ModelFit> reduced(const Frame& frame, const Findings& findings, std::size_t cause,
                         int steps) {
  ModelFit whole = findings.fit;
  const auto equations = linked(frame, whole.model.causes, whole.model.causes[cause]);
  whole.model.causes.erase(whole.model.causes.begin() + static_cast<long>(cause));
  whole.model.coefficients.erase(whole.model.coefficients.begin() + static_cast<long>(cause));
  return fit_part(frame, findings, whole, equations, steps);
}

std::vector<Trial> try_causes(const Frame& frame, const Findings& findings, unsigned threads) {
  auto looks = look_at_all(frame, findings, threads);
  std::size_t tried = 0;
  for (const FirstLook& look : looks) tried += look.tried;
  std::ranges::stable_sort(looks, std::ranges::greater{}, &FirstLook::gain);
  std::size_t worth = 0;
  while (worth < looks.size() && worth < kMostRefined &&
         looks[worth].gain > kWorthRefining * looks.front().gain) {
    ++worth;
  }
  std::vector<Trial> trials(worth);
  in_parallel(worth, searchers(threads),
              [&](std::size_t i) { trials[i] = refined(frame, findings, looks[i], tried); });
  double best = 0.0;
  for (const Trial& trial : trials) best = std::max(best, trial.gain);
  in_parallel(worth, searchers(threads), [&](std::size_t i) {
    if (trials[i].gain > kWorthFinishing * best) finish(frame, findings, tried, trials[i]);
  });
  keep_best_of_each(trials);
  return trials;
}

}  // namespace flexspline::studies
