#pragma once

#include <memory>
#include <string>
#include <utility>

#include "certified/model_residuals.hpp"
#include "certified/nist_data.hpp"
#include "flexspline/estimators/certified.hpp"

namespace flexspline::estimators::certified {

inline constexpr std::string_view kNist =
    "NIST/ITL Statistical Reference Datasets, nonlinear regression";

/// y - Formula::value(b, x1) at every observation, over b, as NIST writes its models.
template <class Formula>
struct NistModel {
  static constexpr std::size_t kParameters = Formula::kParameters;
  NistData data;

  std::size_t size() const { return data.y.size(); }
  template <class S>
  S residual(std::size_t i, const std::array<S, kParameters>& b) const {
    return data.y[i] - Formula::value(b, data.x[i][0]);
  }
};

template <class Model>
CertifiedProblem nist_problem_of(const std::string& name) {
  NistData data = nist_data(name);
  CertifiedProblem problem{.id = name,
                           .collection = "nist",
                           .starts = data.starts,
                           .parameters = data.parameters,
                           .sum_of_squares = data.sum_of_squares};
  problem.residuals = std::make_shared<ModelResiduals<Model>>(Model{std::move(data)});
  return problem;
}

template <class Formula>
CertifiedProblem nist_problem(const std::string& name) {
  return nist_problem_of<NistModel<Formula>>(name);
}

}  // namespace flexspline::estimators::certified
