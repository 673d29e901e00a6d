#pragma once

#include <vector>

#include "import/column_roles.hpp"
#include "import/survey.hpp"

namespace flexspline::data {

/// A table that may become a recording.
struct Candidate {
  TableSurvey survey;
  std::vector<ColumnRole> roles;
};

/// Makes one of the tables of a file, those from `first` on, where none alone has what a bench
/// needs and some together have: the fewest, from the fastest on. With --join all of them, whatever
/// they have. Says so in the plan.
void join_candidates(std::vector<Candidate>& tables, std::size_t first, ImportPlan& plan);

}  // namespace flexspline::data
