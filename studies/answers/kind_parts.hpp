#pragma once

#include <map>
#include <string>
#include <vector>

#include "flexspline/studies/answer.hpp"
#include "flexspline/studies/case_row.hpp"
#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

/// Numbers by the name of a line and their place on its axis.
using Gathered = std::map<std::string, std::map<double, std::vector<double>>>;

/// Where a point of a sweep stands: its first key's value where that is a number, else its number.
double sweep_position(const SweepAxis& sweep, std::size_t point);

/// "bench.angle_noise / %".
std::string sweep_label(const SweepAxis& sweep);

/// Medians as lines over the axis; logarithmic where it spans more than a decade of positive
/// places.
AnswerPanel lines_of(const Gathered& gathered, const std::string& x_label,
                     const std::string& y_label);

/// The same as a table: a row a place, a column a line.
AnswerTable table_of(const std::string& id, const std::string& caption, const Gathered& gathered,
                     const std::string& x_name);

/// A number for every loop, over frequency and amplitude; NaN: no cell.
AnswerPanel loop_cells(const std::string& title, const std::vector<Loop>& loops,
                       const std::vector<double>& values);

/// How many residuals a fit of a case has: its samples, or as many as its method takes at most.
double residuals_of(const CasePlan& one, const CaseRow& row);

/// Where along the axis the median of the best line is least and largest, in a sentence.
std::string extremes_sentence(const Gathered& gathered, const std::string& axis);

}  // namespace flexspline::studies
