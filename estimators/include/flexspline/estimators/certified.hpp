#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::estimators {

class LeastSquaresProblem;

/// The solvers that fits can be made with.
enum class Backend { ceres, ipopt };

std::string_view name_of(Backend backend);

/// A least-squares problem whose solution was published to many digits.
struct CertifiedProblem {
  std::string id;
  std::string collection;                   ///< nist | mgh
  std::vector<std::vector<double>> starts;  ///< to be fitted from each of them
  std::vector<double> lower{};              ///< empty: without bounds
  std::vector<double> upper{};
  std::vector<double> parameters{};      ///< certified; empty where only the cost is
  double sum_of_squares = kNotComputed;  ///< certified; NaN where doubles cannot express it
  std::vector<double> other_minima{};    ///< sums of squares of local minima, as published
  std::shared_ptr<const LeastSquaresProblem> residuals{};
};

/// Problems that share a model or a source: a row of the catalogue.
struct CertifiedFamily {
  std::string_view id;
  std::string_view model;
  std::string_view source;
  std::vector<CertifiedProblem> problems;
};

/// Every family, one file each in estimators/certified/families.
std::span<const CertifiedFamily> certified_families();

/// Every problem, by collection and id.
std::vector<const CertifiedProblem*> certified_problems();

/// Most digits that are counted: those of NIST's certificates.
inline constexpr double kMostDigits = 11.0;

/// Correct digits, -log10 of the relative error, in [0, kMostDigits]; where the certified value is
/// zero, of the absolute error. NaN stays NaN.
double correct_digits(double value, double certified);

/// One fit of one problem.
struct CertifiedRun {
  const CertifiedProblem* problem = nullptr;
  std::size_t start = 0;  ///< index into the problem's starts
  Backend backend = Backend::ceres;
  std::vector<double> parameters{};
  std::vector<double> parameter_digits{};  ///< one a certified parameter
  double worst_digits = kNotComputed;      ///< the least of them
  double cost_digits = kNotComputed;       ///< of the certified or the nearest other minimum
  double sum_of_squares = kNotComputed;
  bool other_minimum = false;  ///< ended at a published local minimum
  int iterations = 0;
  double seconds = kNotComputed;
  Termination termination = Termination::not_run;
  std::string failure{};                ///< why there is no result
  double judged_digits = kNotComputed;  ///< worst_digits, or cost_digits without parameters
  double required_digits = kNotComputed;

  bool passed() const { return judged_digits >= required_digits; }
};

/// Fits the problem from one of its starts. All problems are fitted with the same settings.
CertifiedRun run_certified(const CertifiedProblem& problem, std::size_t start, Backend backend);

}  // namespace flexspline::estimators
