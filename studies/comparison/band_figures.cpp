#include "comparison/band_figures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "comparison/function_errors.hpp"

namespace flexspline::studies {
namespace {

constexpr double kHalfWidths = 1.959963984540054;  // of a standard deviation, 95 %
// Shares of the training range at which bands are held against the truth: few and apart, so that
// neighbours of one fit are not the same number again.
constexpr double kProbed[] = {-0.8, -0.4, 0.4, 0.8};

/// Linear between the band's own arguments; NaN outside them.
double at(const std::vector<double>& x, const std::vector<double>& y, double where) {
  if (x.size() < 2 || !(where >= x.front()) || !(where <= x.back())) return kNotComputed;
  const auto after = std::ranges::upper_bound(x, where);
  const auto i = std::clamp<std::ptrdiff_t>(after - x.begin(), 1, std::ssize(x) - 1);
  const auto k = static_cast<std::size_t>(i);
  const double u = (where - x[k - 1]) / (x[k] - x[k - 1]);
  return (1.0 - u) * y[k - 1] + u * y[k];
}

double width_percent(const FunctionBand& band) {
  std::vector<double> widths;
  double largest = 0.0;
  for (std::size_t i = 0; i < band.argument.size(); ++i) {
    const double x = band.argument[i];
    if (x < band.valid_from || x > band.valid_to) continue;
    widths.push_back(band.upper[i] - band.lower[i]);
    largest = std::max(largest, std::abs(band.value[i]));
  }
  if (widths.empty() || !(largest > 0.0)) return kNotComputed;
  std::ranges::nth_element(widths, widths.begin() + std::ssize(widths) / 2);
  return 100.0 * widths[widths.size() / 2] / largest;
}

std::vector<double> pits(const FunctionBand& band, const std::function<double(double)>& truth,
                         double edge) {
  std::vector<double> found;
  for (const double share : kProbed) {
    const double x = share * edge;
    const double half = 0.5 * (at(band.argument, band.upper, x) - at(band.argument, band.lower, x));
    const double z = (truth(x) - at(band.argument, band.value, x)) * kHalfWidths / half;
    if (half > 0.0 && std::isfinite(z)) found.push_back(0.5 * std::erfc(-z / std::sqrt(2.0)));
  }
  return found;
}

}  // namespace

void add_band_figures(const Estimate& estimate, const PreparedInput& input,
                      const std::vector<std::string>& trained, CaseRow& row) {
  const bool known = input.truth && input.truth->slip_elements.empty();
  const Reach reach = reach_of(input, trained);
  for (const FunctionBand& band : estimate.bands) {
    row.numbers["width_" + band.function + "_percent"] = width_percent(band);
    if (!known) continue;
    const data::BenchTruth& truth = *input.truth;
    std::function<double(double)> function = truth.stiffness;
    if (band.function == "g_inverse") function = truth.damping;
    if (band.function == "h") {
      function = [&](double phi) {
        return truth.log_modulation ? std::exp(truth.log_modulation(phi)) : 1.0;
      };
    }
    const double edge = band.function == "g_inverse" ? reach.speed : reach.motion;
    row.lists["pit_" + band.function] = pits(band, function, edge);
  }
}

}  // namespace flexspline::studies
