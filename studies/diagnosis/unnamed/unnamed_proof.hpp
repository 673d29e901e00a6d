#pragma once

#include <functional>

#include "diagnosis/proof/prove.hpp"

namespace flexspline::studies {

/// What an unnamed part explains of an equation in every row, chosen and fitted with the rows alone
/// that have a weight; by the fold whose fit it adds to.
using PartOfFold =
    std::function<Eigen::ArrayXd(const ModelFit& fold, const Eigen::ArrayXd& weight)>;

/// Errors on the rows held out of the final model without and with an unnamed part of an equation.
HoldoutProof proof_of_part(const Frame& frame, const Findings& final, const Proof& proof,
                           Equation equation, const PartOfFold& part);

/// Rms of what a part takes of held-out rows.
double taken_by_part(const HoldoutProof& part);

/// True where the 95 % interval of the ratio of the errors ends below 1, and what the part takes is
/// more than limits.trifle() of the largest torque, rms.
bool is_proved_part(const Frame& frame, const HoldoutProof& part, Equation equation,
                    const Limits& limits);

}  // namespace flexspline::studies
