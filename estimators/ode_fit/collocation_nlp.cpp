#include "ode_fit/collocation_nlp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexspline::estimators {
namespace {

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

}  // namespace

CollocationNlp::CollocationNlp(const OdeLayout& layout, const TwiceOdeSystem& system,
                               const std::vector<Mesh>& meshes)
    : layout_(layout),
      system_(system),
      states_(layout.states()),
      parameters_(system.parameters()),
      unknown_count_(layout.unknowns.size()) {
  for (std::size_t e = 0; e < meshes.size(); ++e) {
    const Mesh& mesh = meshes[e];
    const std::size_t first = nodes_.size();
    for (std::size_t k = 0; k < mesh.at_measure.size(); ++k) {
      const std::size_t end = mesh.at_measure[k];
      readings_.push_back({e, k, end == 0 ? Reading::kStart : first + end * kStages - 1});
    }
    for (std::size_t k = 0; k < mesh.elements() * kStages; ++k) {
      const std::size_t element = k / kStages;
      nodes_.push_back(
          {e, k % kStages, element == 0, mesh.time(element, k % kStages), mesh.width(element)});
    }
  }
  add_terms();
}

std::size_t CollocationNlp::variables() const { return first_process() + processes_.size(); }

void CollocationNlp::bounds(std::span<double> lower, std::span<double> upper) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::ranges::fill(lower, -kInfinity);
  std::ranges::fill(upper, kInfinity);
  for (std::size_t k = 0; k < unknown_count_; ++k) {
    lower[k] = layout_.unknowns[k].lower / layout_.unknowns[k].scale;
    upper[k] = layout_.unknowns[k].upper / layout_.unknowns[k].scale;
  }
}

double CollocationNlp::scale(std::size_t variable) const {
  if (variable >= first_process()) return 1.0;
  return variable < unknown_count_ ? layout_.unknowns[variable].scale
                                   : layout_.state_scale[(variable - unknown_count_) % states_];
}

Source CollocationNlp::element_start(std::size_t node, std::size_t i) const {
  const Node& at = nodes_[node];
  if (at.in_first_element) return experiment(at.experiment).initial[i];
  return {first_variable(node - at.stage - 1) + i, 0.0};
}

Source CollocationNlp::reading_source(const Reading& reading, std::size_t i) const {
  if (reading.node == Reading::kStart) return experiment(reading.experiment).initial[i];
  return {first_variable(reading.node) + i, 0.0};
}

std::vector<double> CollocationNlp::read(std::span<const double> x, const Reading& reading) const {
  std::vector<double> y;
  for (std::size_t i = 0; i < states_; ++i) y.push_back(value(x, reading_source(reading, i)));
  return y;
}

// States, then parameters.
std::vector<double> CollocationNlp::arguments(std::span<const double> x, std::size_t node) const {
  std::vector<double> z;
  for (std::size_t i = 0; i < states_; ++i) z.push_back(value(x, first_variable(node) + i));
  for (std::size_t k = 0; k < parameters_; ++k) z.push_back(value(x, k));
  return z;
}

bool CollocationNlp::objective(std::span<const double> x, double& f) const {
  f = 0.0;
  for (const Term& term : terms_) f += layout_.loss.value(residual(x, term));
  return std::isfinite(f);
}

bool CollocationNlp::gradient(std::span<const double> x, std::span<double> g) const {
  std::ranges::fill(g, 0.0);
  for (const Term& term : terms_) {
    const Reading& reading = readings_[term.reading];
    const double influence = term.weight * layout_.loss.influence(residual(x, term));
    for (std::size_t i = 0; i < states_; ++i) {
      const Source at = reading_source(reading, i);
      if (at.known()) continue;
      g[at.unknown] +=
          influence * experiment(reading.experiment).slope(term.output, i) * scale(at.unknown);
    }
    if (term.process != Term::kNone) g[term.process] -= influence;
  }
  return all_finite(g);
}

bool CollocationNlp::constraint(std::span<const double> x, std::span<double> c) const {
  std::vector<double> rate(states_);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    const auto z = arguments(x, n);
    system_.rate(node.time, std::span<const double>(z).first(states_),
                 std::span<const double>(z).subspan(states_), std::span(rate));
    for (std::size_t i = 0; i < states_; ++i) {
      double slope = radau().of_start[node.stage] * value(x, element_start(n, i));
      for (std::size_t k = 0; k < kStages; ++k) {
        slope +=
            radau().derivative[node.stage][k] * value(x, first_variable(n - node.stage + k) + i);
      }
      c[n * states_ + i] = (slope - node.width * rate[i]) / layout_.state_scale[i];
    }
  }
  if (inequalities() > 0) layout_.inequalities->values(parameters(x), c.last(inequalities()));
  process_rows(x, c.subspan(laws(), processes_.size()));
  return all_finite(c);
}

void CollocationNlp::constraint_bounds(std::span<double> lower, std::span<double> upper) const {
  SparseNlp::constraint_bounds(lower, upper);
  for (std::size_t k = 0; k < inequalities(); ++k) {
    const std::size_t row = laws() + processes_.size() + k;
    lower[row] = layout_.inequalities->lower(k);
    upper[row] = layout_.inequalities->upper(k);
  }
}

std::vector<double> CollocationNlp::parameters(std::span<const double> x) const {
  std::vector<double> p;
  for (std::size_t k = 0; k < parameters_; ++k) p.push_back(value(x, k));
  return p;
}

std::vector<double> CollocationNlp::pack(std::span<const double> q,
                                         const std::vector<NodeStates>& states) const {
  std::vector<double> x(q.begin(), q.end());
  for (const auto& each : states) x.insert(x.end(), each.stage.begin(), each.stage.end());
  for (std::size_t v = 0; v < x.size(); ++v) x[v] /= scale(v);
  x.resize(variables(), 0.0);
  return x;
}

std::vector<double> CollocationNlp::unknowns(std::span<const double> x) const {
  std::vector<double> q;
  for (std::size_t k = 0; k < unknown_count_; ++k) q.push_back(value(x, k));
  return q;
}

std::vector<NodeStates> CollocationNlp::node_states(std::span<const double> x) const {
  const auto q = unknowns(x);
  std::vector<NodeStates> result;
  for (const auto& each : layout_.experiments) {
    result.push_back({states_, {}, {}});
    for (const auto& source : each.initial) result.back().start.push_back(source.at(q));
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    auto& stage = result[nodes_[n].experiment].stage;
    for (std::size_t i = 0; i < states_; ++i) stage.push_back(value(x, first_variable(n) + i));
  }
  return result;
}

}  // namespace flexspline::estimators
