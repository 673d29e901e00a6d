// Limits and defaults that the pages print are those of the code.
#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "flexspline/data/bench.hpp"
#include "flexspline/data/table_reader.hpp"
#include "readers/plausible.hpp"

namespace flexspline::data {
namespace {

TEST(PageConstants, LargestValuesOfTheUnits) {
  std::vector<claims::Number> numbers;
  for (const Dimension dimension :
       {Dimension::time, Dimension::angle, Dimension::length, Dimension::angular_velocity,
        Dimension::velocity, Dimension::torque, Dimension::force, Dimension::current,
        Dimension::voltage, Dimension::temperature}) {
    numbers.push_back({std::string(name_of(dimension)), plausible_range(dimension).high});
  }
  numbers.push_back({"the unit 1", 1.0});
  numbers.push_back({"dimensionless", plausible_range(Dimension::dimensionless).high});
  claims::expect("docs/dataset.md", "largest-values", numbers);
}

TEST(PageConstants, LimitsOfFilesThatAreImported) {
  const TableLimits limits;
  claims::expect("docs/import.md", "import-limits",
                 {{"columns", static_cast<double>(limits.columns)},
                  {"million rows", 1e-6 * static_cast<double>(limits.rows)},
                  {"tables", static_cast<double>(limits.tables)},
                  {"depth", static_cast<double>(limits.depth)}});
  claims::expect(
      "docs/import.md", "import-contained",
      {{"GiB", static_cast<double>(limits.memory_bytes >> 30U)}, {"silence", limits.silence_s}});
}

TEST(PageConstants, DefaultsOfTheVirtualBench) {
  const BenchExcitation excitation;
  claims::expect("docs/study-file.md", "bench-defaults",
                 {{"torque_noise_samples", BenchSensors().torque_noise_samples},
                  {"cycles", static_cast<double>(excitation.cycles)},
                  {"samples_per_cycle", static_cast<double>(excitation.samples_per_cycle)}});
}

}  // namespace
}  // namespace flexspline::data
