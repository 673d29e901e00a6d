#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexspline::estimators::certified {

/// What one file of NIST's StRD nonlinear regression says.
struct NistData {
  std::vector<std::vector<double>> starts;  ///< start 1 and start 2
  std::vector<double> parameters;           ///< certified
  std::vector<double> deviations;           ///< certified standard deviations
  double sum_of_squares = 0.0;              ///< certified
  std::vector<double> y;
  std::vector<std::vector<double>> x;  ///< the predictors, one list an observation
};

/// The text of every file in certified/nist, by stem, as carried by the program.
struct NistText {
  std::string_view name;
  std::string_view text;
};
const std::vector<NistText>& nist_texts();

/// A file as carried by the program. A name that is not there is a defect.
NistData nist_data(std::string_view name);

/// Reads NIST's text form.
NistData parse_nist(std::string_view text);

}  // namespace flexspline::estimators::certified
