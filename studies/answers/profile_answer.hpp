#pragma once

#include <string_view>

#include "flexspline/studies/answer.hpp"

namespace flexspline::studies {

class StudyRows;

/// How the estimator with every parameter fitted is called, behind its own name. Of the others the
/// last parameter is the one that is held.
inline constexpr std::string_view kFreeFit = "free";

/// Profile likelihoods from free and held fits of model files, of the first replicate.
KindAnswer answer_profiles(const StudyRows& rows);

}  // namespace flexspline::studies
