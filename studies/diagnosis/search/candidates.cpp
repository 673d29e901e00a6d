#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "diagnosis/search/linearised.hpp"
#include "diagnosis/search/strong_orders.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr int kFirstSteps = 3;
constexpr int kRefineSteps = 4;
constexpr int kFinishSteps = 12;
constexpr double kWorthRefining = 0.03;   // of the best first gain
constexpr double kWorthFinishing = 0.6;   // of the best gain when refined
constexpr std::size_t kMostRefined = 12;  // the best was never beyond the seventh in 188 searches
constexpr std::size_t kMostThreads = 8;
constexpr int kEachOrder = 36;         // up to here every order is tried
constexpr std::size_t kStrongest = 4;  // of those beyond

double on_grid(const Shape& s, double share) {
  return s.logarithmic ? s.lower * std::pow(s.upper / s.lower, share)
                       : s.lower + share * (s.upper - s.lower);
}

/// Where a form starts from, and of how many values of its first shape these are the ones to try.
struct Starts {
  std::vector<std::vector<double>> shapes;
  std::size_t tried;
};

// Every value of a small grid; of orders beyond the first dozens those that what is left shows.
std::vector<double> first_values(const CauseForm& form, const Shape& s, const Frame& frame,
                                 const Findings& findings) {
  std::vector<double> values;
  if (!s.discrete) {
    for (int k = 0; k < s.grid; ++k) values.push_back(on_grid(s, (k + 0.5) / s.grid));
    return values;
  }
  const auto lowest = static_cast<int>(s.lower), highest = static_cast<int>(s.upper);
  const int each = std::min(highest, std::max(lowest, kEachOrder));
  for (int order = lowest; order <= each; ++order) values.push_back(order);
  if (each == highest) return values;
  const auto strong =
      strong_orders(frame, findings, form.at.front(), each + 1, highest, kStrongest);
  values.insert(values.end(), strong.begin(), strong.end());
  return values;
}

// The first shape on its grid, the others in the middle of theirs.
Starts starts(const CauseForm& form, const Frame& frame, const Findings& findings) {
  if (form.shapes == nullptr) return {{{}}, 1};
  if (form.start != nullptr) return {{form.start(frame)}, 1};
  const auto shapes = form.shapes(frame);
  const Shape& first = shapes.front();
  std::vector<double> middle;
  for (const Shape& s : shapes) middle.push_back(on_grid(s, 0.5));
  std::vector<std::vector<double>> list;
  for (const double value : first_values(form, first, frame, findings)) {
    list.push_back(middle);
    list.back().front() = value;
  }
  const double count = first.discrete ? first.upper - first.lower + 1.0 : first.grid;
  return {std::move(list), static_cast<std::size_t>(count)};
}

int parameters_of(const ActiveCause& cause, const ModelFit& fit) {
  const Eigen::VectorXd& a = fit.model.coefficients.back();
  int count = static_cast<int>(cause.shape.size());
  for (Eigen::Index k = 0; k < a.size(); ++k) count += a[k] != 0.0 ? 1 : 0;
  return std::max(count, 1);
}

double effective_rows(const Frame& frame, const Findings& findings, const CauseForm& form) {
  double rows = 0.0;
  for (Equation e : form.at) {
    const std::size_t i = index_of(e);
    if (!frame.has(e)) continue;
    rows += static_cast<double>((findings.weight[i] > 0.0).count()) / findings.noise[i].colour;
  }
  return rows;
}

/// A form at the best of its starts.
struct FirstLook {
  const CauseRow* row;
  const CauseForm* form;
  const Linearised* about;
  std::vector<double> shape;
  double gain = -1.0;
  std::size_t tried = 0;
};

/// The model in first order about its fit, once for all causes that link the same equations.
class Neighbourhood {
 public:
  Neighbourhood(const Frame& frame, const Findings& findings)
      : frame_(frame), findings_(findings) {}

  const Linearised& of(const CauseForm& form) {
    const auto equations = linked_equations(frame_, findings_.fit.model.causes, form);
    auto& known = known_[equations];
    if (known == nullptr) known = std::make_unique<Linearised>(frame_, findings_, equations);
    return *known;
  }

 private:
  const Frame& frame_;
  const Findings& findings_;
  std::map<std::vector<Equation>, std::unique_ptr<const Linearised>> known_;
};

void look_at(const Frame& frame, const Findings& findings, FirstLook& look) {
  const Starts from = starts(*look.form, frame, findings);
  look.tried = from.tried;
  for (const auto& shape : from.shapes) {
    // A change of the motion starts from next to nothing: a few steps show what it is worth.
    const int steps = look.form->start != nullptr ? kFirstSteps : 0;
    const auto fit = look.about->with({look.row, look.form, shape}, steps);
    if (!fit || !(fit->gain > look.gain || look.shape.empty())) continue;
    look.gain = std::max(fit->gain, look.gain);
    look.shape = fit->shape;
  }
}

void refine(FirstLook& look) {
  if (look.shape.empty()) return;
  const auto fit = look.about->with({look.row, look.form, look.shape}, kRefineSteps);
  if (!fit || !(fit->gain > look.gain)) return;
  look.gain = fit->gain;
  look.shape = fit->shape;
}

/// What the search over starts and causes gains on noise alone, in chi square.
double search_penalty(std::size_t tried) { return 2.0 * std::log(static_cast<double>(tried)); }

// A joint that travels, for one, has no shapes to start from elsewhere.
bool starts_from_scratch(const Frame& frame, const Findings& findings) {
  return findings.fit.model.torsion_shape == first_guess(frame).torsion_shape;
}

// A change of the motion asks for another h: the fit from where nothing of it is known.
Result<ModelFit> from_scratch(const Frame& frame, Findings findings, const ActiveCause& cause) {
  findings.fit.model.torsion_shape = first_guess(frame).torsion_shape;
  return extended(frame, findings, cause, kFinishSteps);
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
  trial.gain = chi_square(frame, findings, findings.fit) - chi_square(frame, findings, trial.fit);
  trial.net_gain = trial.gain - search_penalty(tried) -
                   trial.parameters * std::log(effective_rows(frame, findings, *trial.cause.form));
  const double misfit = excess(frame, findings, findings.fit);
  trial.removed = misfit > 0.0 ? std::clamp(trial.gain / misfit, 0.0, 1.0) : kNotComputed;
  trial.size = share_of_torque(frame, trial.fit.model, findings.reference,
                               trial.fit.model.causes.size() - 1);
  trial.change = change_of_torque(frame, *trial.cause.form, trial.fit, findings.fit);
  return trial;
}

// To its end, but for what stands far behind: that is fitted at its shapes.
Trial tried_out(const Frame& frame, const Findings& findings, const FirstLook& look, double best,
                std::size_t tried) {
  const ActiveCause cause{look.row, look.form, look.shape};
  const bool contends = look.gain > kWorthFinishing * best;
  auto fit = extended(frame, findings, cause, contends ? kFinishSteps : 0);
  if (contends && look.form->transform != nullptr) {
    if (!starts_from_scratch(frame, findings)) {
      take_better(fit, from_scratch(frame, findings, cause));
    }
    const bool first = findings.fit.model.causes.empty();
    if (fit && !first) take_better(fit, by_its_own_laws(frame, findings, *fit, kFinishSteps));
  }
  return fit ? judged(frame, findings, std::move(*fit), tried) : Trial{.cause = cause};
}

std::size_t searchers(unsigned wanted) {
  return wanted > 0 ? wanted : std::min(threads_for(0), kMostThreads);
}

std::vector<FirstLook> look_at_all(const Frame& frame, const Findings& findings,
                                   Neighbourhood& near, unsigned threads) {
  std::vector<FirstLook> looks;
  for (const auto rows : {causes(), baseline_parts(), outside_causes()}) {
    for (const CauseRow& row : rows) {
      const bool present = std::ranges::any_of(findings.fit.model.causes,
                                               [&](const ActiveCause& c) { return c.row == &row; });
      if (present) continue;
      for (const CauseForm* form : forms_on(row, frame))
        looks.push_back({&row, form, &near.of(*form), {}, -1.0, 0});
    }
  }
  in_parallel(looks.size(), searchers(threads),
              [&](std::size_t i) { look_at(frame, findings, looks[i]); });
  return looks;
}

void keep_the_best(std::vector<FirstLook>& looks) {
  std::ranges::stable_sort(looks, std::ranges::greater{}, &FirstLook::gain);
  std::size_t worth = 0;
  while (worth < looks.size() && worth < kMostRefined &&
         looks[worth].gain > kWorthRefining * looks.front().gain) {
    ++worth;
  }
  looks.resize(worth);
}

// Of each cause its best form; of a part of the baseline all, as which of them goes first is not
// for the gain alone to say.
void keep_best_of_each(std::vector<Trial>& trials) {
  std::ranges::stable_sort(trials, std::ranges::greater{}, &Trial::net_gain);
  std::vector<Trial> best;
  for (Trial& trial : trials) {
    const bool known = std::ranges::any_of(best, [&](const Trial& t) {
      return t.cause.row == trial.cause.row && !t.cause.row->of_baseline();
    });
    if (!known) best.push_back(std::move(trial));
  }
  trials = std::move(best);
}

}  // namespace

Trial try_cause(const Frame& frame, const Findings& findings, const ActiveCause& cause) {
  auto fit = extended(frame, findings, cause, kFinishSteps);
  return fit ? judged(frame, findings, std::move(*fit), 1) : Trial{.cause = cause};
}

std::vector<Trial> try_causes(const Frame& frame, const Findings& findings, unsigned threads) {
  Neighbourhood near(frame, findings);
  auto looks = look_at_all(frame, findings, near, threads);
  std::size_t tried = 0;
  for (const FirstLook& look : looks) tried += look.tried;
  keep_the_best(looks);
  in_parallel(looks.size(), searchers(threads), [&](std::size_t i) { refine(looks[i]); });
  double best = 0.0;
  for (const FirstLook& look : looks) best = std::max(best, look.gain);
  std::vector<Trial> trials(looks.size());
  in_parallel(looks.size(), searchers(threads), [&](std::size_t i) {
    trials[i] = tried_out(frame, findings, looks[i], best, tried);
  });
  keep_best_of_each(trials);
  return trials;
}

}  // namespace flexspline::studies
