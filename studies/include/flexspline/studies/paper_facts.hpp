#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

/// One number of Dhaouadi and Ghorbel (2003), or that follows from theirs, computed again.
struct PaperFact {
  std::string id;
  std::string says;
  double value;
  std::string unit;
  std::string published;  ///< as it is known; the value rounded to `digits` has to agree
  int digits;             ///< significant ones
};

/// Everything that Table I and Table II say, by closed forms and quadrature alone: no estimator and
/// no virtual bench takes part.
std::vector<PaperFact> paper_facts();

/// "16.54": the value with so many significant digits, as it is published.
std::string rounded(double value, int digits);

/// paper.json: the facts, Tables I (with what the paper's method recovers from a virtual recording
/// of it) and II, figures 4 to 12. depends_on as in the cases.
/// Errors: the bench or the method failed; cannot_write.
Result<void> write_paper(const StudyConfig& study, const std::string& depends_on,
                         const std::filesystem::path& file);

}  // namespace flexspline::studies
