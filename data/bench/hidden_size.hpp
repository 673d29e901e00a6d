#pragma once

#include <vector>

#include "bench/hidden_run.hpp"

namespace flexspline::data {

/// Peaks of the runs without effects.
HiddenScale measure_scale(const HiddenBench& bench, const std::vector<HiddenSession>& sessions,
                          const std::vector<HiddenSignals>& null_runs);

/// What is left of an equation on ideal signals with the true laws of that recording, Nm. The
/// drive's is against the run of the same motion without effects.
std::vector<double> equation_residual(const HiddenGear& gear, HiddenEquation equation,
                                      const HiddenSignals& signals, const HiddenSignals& null_run);

/// An effect's amount for a size, and the size it then has.
struct HiddenSizing {
  HiddenAmount amount;
  double size_fraction = 0.0;
};

/// Errors: usage where the effect cannot have that size here.
Result<HiddenSizing> size_effect(const HiddenBench& bench,
                                 const std::vector<HiddenSession>& sessions,
                                 const std::vector<HiddenSignals>& null_runs,
                                 const HiddenScale& scale, const HiddenRow& row, double size);

}  // namespace flexspline::data
