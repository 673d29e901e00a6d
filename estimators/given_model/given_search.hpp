#pragma once

#include <cstdint>
#include <string>

#include "given_model/given_residuals.hpp"

namespace flexspline::estimators {

struct GivenSearchSettings {
  bool each_zero = false;  ///< every recording's motion has a zero of its own
  int start_steps = 15;    ///< of the shapes before all numbers are fitted together
  int iterations = 100;
  int starts = 1;       ///< the one given and others (drawn_start)
  int first_start = 0;  ///< number of the first of them; 0: the one given
  std::uint64_t seed = 1;
};

/// The lowest cost found, with the residuals it is of.
struct GivenSearch {
  GivenResiduals residuals;
  LeastSquaresSolution solution;
  std::string says{};  ///< of more starts than one: how many end there
};

/// The free numbers of a given model by least squares: from every start twice, from where the
/// search of the shapes leads and from the shapes given, as that search can end in another valley.
/// Of several starts the best counts as converged where two end there.
/// records: must outlive the result.
/// Errors: numerics, where the model cannot be simulated at the start given; other starts may fail.
Result<GivenSearch> search_given(const ModelSpec& model,
                                 const std::vector<GivenParameter>& parameters,
                                 const std::vector<GivenRecord>& records,
                                 const GivenSearchSettings& settings);

}  // namespace flexspline::estimators
