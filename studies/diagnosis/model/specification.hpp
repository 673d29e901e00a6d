#pragma once

#include <string>
#include <vector>

#include "diagnosis/model/model.hpp"
#include "flexspline/core/drive_spec.hpp"

namespace flexspline::studies {

/// A fitted drive as a model file holds it, and what of it a model file cannot hold.
struct Specification {
  RigModel model;
  std::vector<std::string> notes;
};

/// The whole rig: its constants, known or of the baseline, the torsion law, and the causes by their
/// counterparts in the catalogue of effects. remarks: of each cause of the model from the first on,
/// what the file is to say of it. Left out, with a note: a cause that no effect is like; two
/// corrections that nearly cancel, as only their sum is identified; an inertia that would not be
/// positive.
Specification specify(const Frame& frame, const DriveModel& model,
                      const std::vector<std::string>& remarks = {});

}  // namespace flexspline::studies
