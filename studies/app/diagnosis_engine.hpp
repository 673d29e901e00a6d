#pragma once

#include "command.hpp"
#include "flexspline/studies/trial.hpp"

namespace flexspline::app {

/// What decides a diagnosis, and below which share of torque nothing interests.
ArgumentInfo engine_argument();
ArgumentInfo interest_argument();

/// The engine that was asked for.
/// Errors: usage, an engine that there is not, a share out of range, what is for the other engine.
Result<studies::Diagnose> engine_of(const Arguments& arguments);

/// The same in words, as a trial keeps it; none for the usual one.
Result<std::map<std::string, std::string>> engine_words(const Arguments& arguments);

}  // namespace flexspline::app
