#pragma once

#include <map>
#include <string>
#include <vector>

#include "flexspline/core/model_spec.hpp"

namespace flexspline {

inline LawSpec law_spec(std::string law, double scale, std::vector<double> knots,
                        std::vector<double> coefficients) {
  return {.law = std::move(law),
          .scale = scale,
          .knots = std::move(knots),
          .coefficients = std::move(coefficients),
          .valid_to = 0.0};
}

/// Laws to hold every row of the catalogue against; a new row needs an example here.
inline const std::map<std::string, std::vector<LawSpec>>& law_examples() {
  static const std::map<std::string, std::vector<LawSpec>> examples = {
      {"odd_polynomial", {law_spec("odd_polynomial", 0.0035, {}, {4.8, 11.8, -0.7})}},
      {"monotone_spline",
       {law_spec("monotone_spline", 0.0035, {0.25, 0.5, 0.75}, {3.0, 2.0, 7.0, 1.0, 9.0, 4.0}),
        law_spec("monotone_spline", 2.0, {0.004, 0.035, 0.4},
                 {40.0, 0.3, 7.0, 0.1, 2.0, 4.0, 30.0, 0.2, 5.0, 0.3, 1.0, 6.0}),
        law_spec("monotone_spline", 1.0, {}, {1.0, 2.0, 3.0})}},
      {"bounded_modulation",
       {law_spec("bounded_modulation", 0.0035, {}, {0.15, 0.3, -0.2, 0.4}),
        law_spec("bounded_modulation", 1.0, {}, {})}},
      {"exponential_modulation",
       {law_spec("exponential_modulation", 0.0035, {}, {0.1, -0.15}),
        law_spec("exponential_modulation", 1.0, {}, {})}},
      {"held_modulation",
       {law_spec("held_modulation", 0.0035, {}, {0.7, -0.4}),
        law_spec("held_modulation", 1.0, {}, {})}},
      {"inverse_odd_polynomial",
       {law_spec("inverse_odd_polynomial", 0.02, {}, {8.0, 12.0, 20.0}),
        law_spec("inverse_odd_polynomial", 1.0, {}, {50.0, -20.0})}},
      {"power_law",
       {law_spec("power_law", 0.0035, {}, {4.5, 1.79}),
        law_spec("power_law", 2.0, {}, {3.0, 0.6})}},
      {"free_spline",
       {law_spec("free_spline", 2.0, {-0.4, 1.0}, {1.0, -2.0, 4.0, 0.5, 3.0, 2.0, -1.0})}}};
  return examples;
}

}  // namespace flexspline
