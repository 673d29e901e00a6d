#include "certified/nist_data.hpp"

#include <algorithm>
#include <sstream>

#include "flexspline/core/error.hpp"

namespace flexspline::estimators::certified {
namespace {

std::vector<double> numbers_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;) numbers.push_back(number);
  return numbers;
}

// "  b1 =   500         250           2.3894212918E+02  2.7070075241E+00": only rows of the table
// of starts and certified values begin so.
bool is_parameter(const std::string& line) {
  const auto at = line.find_first_not_of(' ');
  return at != std::string::npos && line[at] == 'b' && line.find('=') != std::string::npos;
}

void read_parameter(const std::string& line, NistData& data) {
  const auto row = numbers_in(line.substr(line.find('=') + 1));
  expects(row.size() == 4, "a parameter has two starts, a value and a deviation: " + line);
  data.starts[0].push_back(row[0]);
  data.starts[1].push_back(row[1]);
  data.parameters.push_back(row[2]);
  data.deviations.push_back(row[3]);
}

}  // namespace

NistData parse_nist(std::string_view text) {
  static const std::string kSumOfSquares = "Residual Sum of Squares:";
  NistData data;
  data.starts.resize(2);
  std::istringstream stream{std::string(text)};
  bool observations = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (is_parameter(line)) read_parameter(line, data);
    if (line.starts_with(kSumOfSquares)) {
      data.sum_of_squares = numbers_in(line.substr(kSumOfSquares.size())).at(0);
    }
    const auto row = numbers_in(line);
    if (observations && row.size() >= 2) {
      data.y.push_back(row[0]);
      data.x.emplace_back(row.begin() + 1, row.end());
    }
    // The word stands twice: before a description, and after the sum of squares before the table.
    if (line.starts_with("Data:") && data.sum_of_squares > 0.0) observations = true;
  }
  return data;
}

NistData nist_data(std::string_view name) {
  const auto found = std::ranges::find(nist_texts(), name, &NistText::name);
  expects(found != nist_texts().end(), "the program carries NIST's " + std::string(name));
  return parse_nist(found->text);
}

}  // namespace flexspline::estimators::certified
