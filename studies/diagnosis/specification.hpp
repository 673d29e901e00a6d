#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/model.hpp"
#include "flexspline/core/model_spec.hpp"

namespace flexspline::studies {

/// A fitted drive as a model file holds it, and what of it a model file cannot hold.
struct Specification {
  std::optional<ModelSpec> model;
  std::vector<std::string> notes;
};

/// The torsion law and the causes by their counterparts in the catalogue of effects. Not in it: the
/// inertias and the friction of motor and load that a baseline has, which are a rig's constants.
Specification specify(const Frame& frame, const DriveModel& model);

}  // namespace flexspline::studies
