#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// A cause of a form, with shapes at its start or in the middle of their ranges.
inline ActiveCause active(const Frame& frame, const CauseRow& row, const CauseForm& form) {
  ActiveCause cause{&row, &form, {}};
  if (form.start != nullptr) {
    cause.shape = form.start(frame);
  } else if (form.shapes != nullptr) {
    for (const Shape& s : form.shapes(frame)) {
      cause.shape.push_back(s.discrete      ? s.lower + 1.0
                            : s.logarithmic ? std::sqrt(s.lower * s.upper)
                                            : s.lower + 0.55 * (s.upper - s.lower));
    }
  }
  return cause;
}

/// Coefficients with which the columns of a cause are together a share of the largest torque.
inline Eigen::VectorXd coefficients_of(const Frame& frame, const ActiveCause& cause,
                                       const Reference& reference, double share) {
  if (cause.form->columns == nullptr) return {};
  const Equation at = first_equation(frame, *cause.form);
  const auto columns = cause.form->columns(at, frame, reference, cause.shape);
  Eigen::VectorXd b(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double most = std::max((columns[k] * frame.usable).abs().maxCoeff(), 1e-300);
    b[static_cast<Eigen::Index>(k)] =
        share * frame.largest_torque(at) / most / static_cast<double>(columns.size());
  }
  return b;
}

/// The baseline as fitted with one cause of that share; the baseline's own numbers stay.
inline DriveModel with_cause(const Frame& frame, const Findings& findings, const CauseRow& row,
                             const CauseForm& form, double share = 0.04) {
  DriveModel model = findings.fit.model;
  ActiveCause cause = active(frame, row, form);
  model.coefficients.push_back(coefficients_of(frame, cause, findings.reference, share));
  model.causes.push_back(std::move(cause));
  return model;
}

/// The first form of a cause that the frame allows.
inline std::pair<const CauseRow*, const CauseForm*> form_named(const Frame& frame,
                                                               std::string_view id) {
  for (const CauseRow& row : causes()) {
    if (row.id != id) continue;
    const auto forms = forms_on(row, frame);
    if (!forms.empty()) return {&row, forms.front()};
  }
  return {nullptr, nullptr};
}

}  // namespace flexspline::studies
