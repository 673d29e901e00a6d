#include "diagnosis/model/cancelling.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

double rms(const Frame& frame, const ArrayXd& x) {
  return std::sqrt((frame.usable * x.square()).sum() / std::max(frame.usable.sum(), 1.0));
}

/// What a cause adds to an equation.
struct Part {
  std::size_t cause = 0;
  ArrayXd torque;
};

// Of the causes that act on an equation; none where they are fewer than two.
std::vector<Part> parts_of(const Frame& frame, const DriveModel& model, const Reference& reference,
                           Equation equation) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < model.causes.size(); ++i) {
    if (std::ranges::count(model.causes[i].form->at, equation) > 0) parts.push_back({i, {}});
  }
  if (parts.size() < 2) return {};
  for (Part& part : parts) {
    part.torque = contribution(frame, model, reference, part.cause, equation);
  }
  return parts;
}

}  // namespace

std::vector<Cancelling> cancelling(const Frame& frame, const DriveModel& model,
                                   const Reference& reference, double most_left) {
  std::vector<Cancelling> pairs;
  for (Equation equation : frame.equations) {
    const auto parts = parts_of(frame, model, reference, equation);
    for (auto one = parts.begin(); one != parts.end(); ++one) {
      for (auto other = one + 1; other != parts.end(); ++other) {
        const double smaller = std::min(rms(frame, one->torque), rms(frame, other->torque));
        const double left = rms(frame, one->torque + other->torque) / smaller;
        if (left < most_left) pairs.push_back({one->cause, other->cause, equation, left});
      }
    }
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
