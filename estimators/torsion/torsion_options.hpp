#pragma once

#include <vector>

#include "flexspline/estimators/method.hpp"
#include "flexspline/estimators/uncertainty.hpp"
#include "torsion/static_fit.hpp"

namespace flexspline::estimators {

/// Options that every fit of the torsion law has, after those of the method itself.
std::vector<OptionInfo> with_torsion_options(std::vector<OptionInfo> own);

/// What they say. intervals stays 0: the class is chosen by the data.
StaticFitSettings static_settings(const FitProblem& problem, const MethodRow& method);
UncertaintySettings uncertainty_settings(const FitProblem& problem, const MethodRow& method);

}  // namespace flexspline::estimators
