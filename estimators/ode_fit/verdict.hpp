#pragma once

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// What the recordings tell of the unknowns, in words: which unknown the others absorb (cosine of
/// its column of the Jacobian with their span), which combination is flat, and, where something is
/// not told well, which recording would help most of those that are tried: the same again with
/// twice or half the initial state, twice as long, twice as dense, or with a state measured that is
/// not. `free` spans the directions that bounds and inequalities leave; columns of the Jacobian are
/// those of q; noise is the standard deviation of the residuals. Not tried: other inputs, which the
/// description of a system does not show.
Identifiability verdict(const OdeLayout& layout, std::span<const double> q,
                        const Eigen::MatrixXd& free, const Eigen::MatrixXd& jacobian, double noise,
                        bool propose_recording);

}  // namespace flexspline::estimators
