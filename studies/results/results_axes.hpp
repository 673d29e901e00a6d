#pragma once

#include <map>
#include <string>
#include <vector>

#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {

/// The dimensions of results.nc, as the rows give them.
struct ResultsAxes {
  std::vector<double> amplitudes;   ///< of held-out loops of the bench, ascending
  std::vector<double> frequencies;  ///< the same
  std::vector<std::string> parameters;
  std::vector<std::string> numbers;  ///< names of CaseRow::numbers
  std::vector<std::string> units;    ///< input x estimator x parameter, once the others are known
  std::size_t rows = 0;              ///< recordings of all cases
};

ResultsAxes axes_of(const StudyRows& rows);

/// Whether a recording is a held-out loop of the bench.
bool on_grid(const CasePlan& one, const CaseRow::Recording& recording);

/// Amplitudes come back from degrees with rounding errors that would make axes of their own.
double tidy(double value);

template <class T>
std::size_t index_in(const std::vector<T>& list, const T& value) {
  std::size_t i = 0;
  while (i < list.size() && !(list[i] == value)) ++i;
  return i;
}

/// Number of a case's input and estimator in the study.
std::size_t input_index(const StudyConfig& study, const CasePlan& one);
std::size_t estimator_index(const StudyConfig& study, const CasePlan& one);

}  // namespace flexspline::studies
