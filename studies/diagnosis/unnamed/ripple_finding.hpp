#pragma once

#include <string>
#include <vector>

#include "diagnosis/proof/prove.hpp"
#include "diagnosis/search/ripple.hpp"
#include "diagnosis/search/selection.hpp"

namespace flexspline::studies {

/// The cause that the catalogue has for a ripple of this order in a joint's torque, and the others
/// over the motor's angle, as alternatives: what lies between the motor and the sensor turns the
/// phase with the speed and its sign, so that the phase tells no friction from another torque.
struct RippleName {
  const CauseRow* row = nullptr;
  const CauseForm* form = nullptr;
  double order = 0.0;
  std::vector<std::string> others;
  RippleProof proof;
  NameEvidence evidence;  ///< no table looks at the fast changes: nothing is left over beside it
};

/// A ripple over the motor's angle that counts.
struct RippleFinding {
  Ripple ripple;
  bool taken = false;              ///< a cause of the model has that coordinate
  std::optional<RippleName> name;  ///< where it is named
};

/// The ripple that no cause took. Named where the catalogue has a cause of its order for joints
/// that travel, and a recording confirms the order that the others tell, however small it is
/// against the torque: of the fast changes in steady strokes it has to be a quarter, and the name,
/// or one of its alternatives, right with limits.probability.
std::optional<RippleFinding> find_ripple(const Frame& frame, const Selection& selection,
                                         const HoldoutProof& holdout, const Limits& limits);

}  // namespace flexspline::studies
