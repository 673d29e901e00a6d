#pragma once

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// dg/dp, a row an inequality.
Eigen::MatrixXd inequality_gradients(const OdeInequalities& inequalities,
                                     std::span<const double> p);

/// Notes those that hold with equality at the solution, with their gradients by all unknowns.
void note_active_inequalities(const OdeLayout& layout, OdeSolution& solution);

}  // namespace flexspline::estimators
