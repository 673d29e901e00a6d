#pragma once

#include <string>

#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::app {

/// A diagnosis on a screen: the verdict, what was left out with its size and parameters, where, the
/// error on recordings held out beside the noise, what looks mistaken, and what to record next.
std::string summary_of(const studies::Diagnosis& diagnosis);

}  // namespace flexspline::app
