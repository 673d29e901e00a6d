#pragma once

#include <string>
#include <vector>

#include "flexspline/studies/answer.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

class StudyRows;

/// Which recording separates two causes: both models are fitted to what is recorded, and to that
/// with a candidate more; how much better one then fits is D = n ln(C/C'), the difference of
/// -2 ln L for n independent residuals, C the cost of the worse and C' that of the better one. It
/// is that of the simulated gear at hand with its noise, in the median over replicates, and no
/// probability. Adds a figure, a table and a sentence to the answer.
/// causes: two ids of estimators as written; suffixes: what the case without and those with each
/// candidate are called behind them, in the order of the candidates.
void add_discrimination(const StudyRows& rows, const std::vector<std::string>& causes,
                        const std::string& recorded, const std::vector<std::string>& suffixes,
                        const std::vector<Loop>& candidates, KindAnswer& answer);

}  // namespace flexspline::studies
