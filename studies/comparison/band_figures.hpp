#pragma once

#include <string>
#include <vector>

#include "flexspline/core/estimate.hpp"
#include "flexspline/studies/case_row.hpp"
#include "inputs/prepared_input.hpp"

namespace flexspline::studies {

/// What the 95 % bands of an estimate are worth. Numbers "width_<f>_percent": median width over the
/// training range, of the largest value of the function there. Where the truth is known, lists
/// "pit_<f>": Phi((truth - value) / std) at a few arguments inside the band's domain, std the
/// band's half width over 1.96; uniform on [0, 1] where the band means what it says.
void add_band_figures(const Estimate& estimate, const PreparedInput& input,
                      const std::vector<std::string>& trained, CaseRow& row);

}  // namespace flexspline::studies
