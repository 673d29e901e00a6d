#include "diagnosis/cancelling.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

double rms(const Frame& frame, const ArrayXd& x) {
  return std::sqrt((frame.usable * x.square()).sum() / std::max(frame.usable.sum(), 1.0));
}

void add_pairs(const Frame& frame, const std::vector<ArrayXd>& parts, Equation equation,
               const Limits& limits, std::vector<Cancelling>& pairs) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = i + 1; k < parts.size(); ++k) {
      const double smaller = std::min(rms(frame, parts[i]), rms(frame, parts[k]));
      const double sum = rms(frame, parts[i] + parts[k]);
      if (smaller > 0.0 && sum < limits.half * smaller)
        pairs.push_back({i, k, equation, sum / smaller});
    }
  }
}

}  // namespace

std::vector<Cancelling> cancelling(const Frame& frame, const DriveModel& model,
                                   const Reference& reference, const Limits& limits) {
  std::vector<Cancelling> pairs;
  if (model.causes.size() < 2) return pairs;
  for (Equation equation : frame.equations) {
    std::vector<ArrayXd> parts;
    for (std::size_t i = 0; i < model.causes.size(); ++i) {
      parts.push_back(contribution(frame, model, reference, i, equation));
    }
    add_pairs(frame, parts, equation, limits, pairs);
  }
  return pairs;
}

std::string in_words(const DriveModel& model, const Cancelling& pair) {
  const CauseForm& first = *model.causes[pair.first].form;
  const CauseForm& second = *model.causes[pair.second].form;
  return fmt::format(
      "{} ({}) and {} ({}): in the {} equation they nearly cancel, their sum is {:.0f} % of the "
      "smaller one, so that these recordings identify the sum and neither of the two; record a "
      "motion that separates them",
      model.causes[pair.first].row->id, first.equation, model.causes[pair.second].row->id,
      second.equation, name_of(pair.equation), 100.0 * pair.left);
}

}  // namespace flexspline::studies
