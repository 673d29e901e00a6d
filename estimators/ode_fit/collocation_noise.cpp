// Residuals of the collocation problem, and the process of coloured noise among its variables: at
// each instant a = transition (a + update (r - a)) of the instant before, which is linear.
#include <algorithm>

#include "ode_fit/collocation_nlp.hpp"

namespace flexspline::estimators {

void CollocationNlp::add_terms() {
  struct Last {
    std::size_t count = 0;
    std::size_t term = Term::kNone;
  };
  std::vector<std::vector<Last>> last;
  for (const auto& each : layout_.experiments) last.emplace_back(each.outputs());
  for (std::size_t r = 0; r < readings_.size(); ++r) {
    Reading& reading = readings_[r];
    const auto& source = experiment(reading.experiment);
    reading.first_term = terms_.size();
    for (std::size_t o = 0; o < source.outputs(); ++o) {
      if (!source.counts(reading.instant, o)) continue;
      Term term{.reading = r, .output = o};
      if (!source.whitening.empty()) {
        Last& before = last[reading.experiment][o];
        const auto& step = source.whitening[o].step(before.count++);
        term.weight = step.weight;
        term.transition = step.transition;
        term.update = step.update;
        term.before = before.term;
        before.term = terms_.size();
        if (term.before != Term::kNone) processes_.push_back(terms_.size());
      }
      terms_.push_back(term);
    }
    reading.last_term = terms_.size();
  }
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    terms_[processes_[k]].process = first_process() + k;
  }
}

double CollocationNlp::plain_residual(std::span<const double> x, const Term& term) const {
  const Reading& reading = readings_[term.reading];
  return experiment(reading.experiment).residual(reading.instant, term.output, read(x, reading));
}

double CollocationNlp::residual(std::span<const double> x, const Term& term) const {
  const double process = term.process == Term::kNone ? 0.0 : x[term.process];
  return term.weight * (plain_residual(x, term) - process);
}

void CollocationNlp::process_rows(std::span<const double> x, std::span<double> c) const {
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    const Term& term = terms_[processes_[k]];
    const Term& before = terms_[term.before];
    const double process = before.process == Term::kNone ? 0.0 : x[before.process];
    const double updated = process + before.update * (plain_residual(x, before) - process);
    c[k] = x[term.process] - term.transition * updated;
  }
}

void CollocationNlp::process_pattern(SparsePattern& pattern) const {
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    const Term& term = terms_[processes_[k]];
    const Term& before = terms_[term.before];
    pattern.add(laws() + k, term.process);
    if (before.process != Term::kNone) pattern.add(laws() + k, before.process);
    for (std::size_t i = 0; i < states_; ++i) {
      const Source at = reading_source(readings_[before.reading], i);
      if (!at.known()) pattern.add(laws() + k, at.unknown);
    }
  }
}

void CollocationNlp::process_slopes(std::span<double> values) const {
  std::size_t to = 0;
  for (const std::size_t index : processes_) {
    const Term& term = terms_[index];
    const Term& before = terms_[term.before];
    const Reading& reading = readings_[before.reading];
    values[to++] = 1.0;
    if (before.process != Term::kNone) values[to++] = -term.transition * (1.0 - before.update);
    for (std::size_t i = 0; i < states_; ++i) {
      const Source at = reading_source(reading, i);
      if (at.known()) continue;
      values[to++] = -term.transition * before.update *
                     experiment(reading.experiment).slope(before.output, i) * scale(at.unknown);
    }
  }
}

void CollocationNlp::process_curvature_pattern(SparsePattern& pattern) const {
  for (const std::size_t index : processes_) {
    const Term& term = terms_[index];
    pattern.add(term.process, term.process);
    for (std::size_t i = 0; i < states_; ++i) {
      const Source at = reading_source(readings_[term.reading], i);
      if (!at.known()) pattern.add(term.process, at.unknown);
    }
  }
}

void CollocationNlp::process_curvature(std::span<const double> x, double factor,
                                       std::span<double> values) const {
  std::size_t to = 0;
  for (const std::size_t index : processes_) {
    const Term& term = terms_[index];
    const Reading& reading = readings_[term.reading];
    const double bend =
        factor * term.weight * term.weight * layout_.loss.curvature(residual(x, term));
    values[to++] = bend;
    for (std::size_t i = 0; i < states_; ++i) {
      const Source at = reading_source(reading, i);
      if (at.known()) continue;
      values[to++] =
          -bend * experiment(reading.experiment).slope(term.output, i) * scale(at.unknown);
    }
  }
}

}  // namespace flexspline::estimators
