#pragma once

#include "flexspline/core/estimate.hpp"
#include "given_model/given_search.hpp"

namespace flexspline::estimators {

/// A fitted parameter away from its estimate.
struct HeldAway {
  std::size_t parameter = 0;  ///< number in the free estimate
  double deviations = 0.0;    ///< how far, in its standard deviations
};

/// A point of a profile: the free fit's model with one parameter held at value + deviations std,
/// within its bounds, all others fitted from where the free fit has them. Where it has no standard
/// deviation a tenth of its value stands for it. The estimate lists the held one last, without std.
/// Errors: usage, where there is no such parameter; those of search_given.
Result<Estimate> held_fit(const GivenModel& given, const Estimate& free,
                          const std::vector<GivenRecord>& records, GivenSearchSettings settings,
                          const HeldAway& away);

}  // namespace flexspline::estimators
