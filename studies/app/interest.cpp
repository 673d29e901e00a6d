#include "interest.hpp"

#include <fmt/format.h>

#include "flexspline/studies/diagnosis.hpp"
#include "quantity_text.hpp"

namespace flexspline::app {
namespace {

constexpr double kLeast = 1e-4;
constexpr double kMost = 0.5;

}  // namespace

ArgumentInfo interest_argument() {
  return {.name = "--interest",
          .meaning = "share of the largest torque below which nothing is named; default: 0.8 %",
          .value = "SHARE"};
}

Result<double> interest_of(const Arguments& arguments) {
  if (!arguments.has("interest")) return studies::DiagnosisSettings{}.interest;
  const auto share =
      parse_quantity("interest", arguments.text("interest"), Dimension::dimensionless);
  if (share && !(*share >= kLeast && *share <= kMost)) {
    return failure(
        ErrorCode::usage,
        fmt::format("--interest is {:g} %, which is not from 0.01 to 50 %", 100.0 * *share),
        "give a share of the largest torque, --interest 0.8%");
  }
  return share;
}

}  // namespace flexspline::app
