#pragma once

#include <cstddef>

#include "flexspline/studies/engine.hpp"
#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

/// What a study will take, from a few of its cases computed for that and thrown away.
struct Pilot {
  std::size_t measured = 0;  ///< cases
  double seconds = 0.0;      ///< of the whole study, on one worker
  double bytes = 0.0;        ///< of its journals
};

/// Computes cases evenly through the plan, of every cell one first, as many as there is time for
/// (one at least), and multiplies the median of each estimator by how many cases it has. A case
/// that fails counts as it is.
Pilot measure_pilot(const StudyPlan& plan, double seconds);

/// The same of cases that are all alike. They write nothing.
Pilot measure_cases(CaseSource& cases, double seconds);

}  // namespace flexspline::studies
