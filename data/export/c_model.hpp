#pragma once

#include <string>
#include <vector>

#include "flexspline/data/exporter.hpp"

namespace flexspline::data {

/// A model in C99: <name>.h and <name>.c.
struct CModel {
  std::string header;
  std::string source;
  int states = 0;  ///< of the rig, then the memory of the effects
};

/// What C cannot hold is taken out: effects on instruments, whole signals, gives in series.
Result<Carried> carry_in_c(const RigModel& model);

/// Errors: a law or effect without a form in C, an inertia that is not positive.
Result<CModel> c_model(const RigModel& model, const ExportHead& head);

/// The remarks of an export, one a line behind a prefix.
std::string commented(const ExportHead& head, const std::string& prefix);

}  // namespace flexspline::data
