#include "export/c_law.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "export/c_expression.hpp"

namespace flexspline::data {
namespace {

std::string list_of(const std::vector<double>& values) {
  std::string text;
  for (double v : values) text += (text.empty() ? "" : ", ") + c_number(v);
  return text;
}

std::string array_of(const std::string& name, const std::vector<double>& values) {
  return fmt::format("  static const double {}[{}] = {{{}}};\n", name, values.size(),
                     list_of(values));
}

// sum = (sum step) over the coefficients from the last to the first.
std::string horner(const LawSpec& spec, const std::string& step) {
  if (spec.coefficients.empty()) return "  const double sum = 0.0;\n";
  return array_of("c", spec.coefficients) +
         fmt::format(
             "  double sum = 0.0;\n  int k;\n  for (k = {}; k >= 0; --k) {{\n    {}\n  }}\n",
             spec.coefficients.size() - 1, step);
}

std::string argument(const LawSpec& spec) {
  return fmt::format("  const double u = x / {};\n", c_number(spec.scale));
}

std::string odd_polynomial(const LawSpec& s) {
  return argument(s) + horner(s, "sum = sum * u * u + c[k];") + "  return sum * u;\n";
}

std::string bounded_modulation(const LawSpec& s) {
  return argument(s) + horner(s, "sum = (sum + c[k]) * u;") +
         "  return exp(1.5 * tanh(sum / 1.5));\n";
}

std::string exponential_modulation(const LawSpec& s) {
  return argument(s) + horner(s, "sum = (sum + c[k]) * u * u;") + "  return exp(sum);\n";
}

std::string held_modulation(const LawSpec& s) {
  return argument(s) + horner(s, "sum = (sum + c[k]) * u * u;") +
         "  return exp(sum < -2.0 ? -2.0 : (sum > 2.0 ? 2.0 : sum));\n";
}

std::string power_law(const LawSpec& s) {
  const double n = s.coefficients[1];
  std::string text = argument(s) + "  const double m = fabs(u);\n  double p;\n";
  text += n < 1.0 ? fmt::format("  if (m < 1e-9) return {} * u * pow(1e-9, {});\n",
                                c_number(s.coefficients[0]), c_number(n - 1.0))
                  : "";
  return text + fmt::format("  p = pow(m, {});\n  return u < 0.0 ? {} * -p : {} * p;\n",
                            c_number(n), c_number(s.coefficients[0]), c_number(s.coefficients[0]));
}

// Newton's iteration for y with sum c_k y^(2k+1) = |u|, kept between bounds by halving.
std::string inverse_odd_polynomial(const LawSpec& s) {
  return argument(s) + array_of("c", s.coefficients) +
         fmt::format(R"(  const double wanted = fabs(u);
  double low = 0.0, high = 1.0, y = wanted / c[0];
  int round, k;
  for (round = 0; round < 1100; ++round) {{
    double height = 0.0;
    for (k = {0}; k >= 0; --k) height = height * high * high + c[k];
    if (height * high >= wanted) break;
    high *= 2.0;
  }}
  if (y > high) y = high;
  for (round = 0; round < 200; ++round) {{
    double height = 0.0, rise = 0.0, error, next;
    for (k = {0}; k >= 0; --k) {{
      height = height * y * y + c[k];
      rise = rise * y * y + (2.0 * (double)k + 1.0) * c[k];
    }}
    error = height * y - wanted;
    if (error == 0.0) break;
    if (error > 0.0) high = y; else low = y;
    next = y - error / rise;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (fabs(next - y) <= 1e-15 * y) {{ y = next; break; }}
    y = next;
  }}
  return u < 0.0 ? -y : y;
)",
                     s.coefficients.size() - 1);
}

std::string spline(const Law& law) {
  const CubicPieces cubic = cubic_pieces(law);
  std::string text = array_of("at", cubic.breaks);
  text += fmt::format("  static const double c[{}][4] = {{\n", cubic.pieces.size());
  for (const auto& piece : cubic.pieces) {
    text += "    {" + list_of({piece.begin(), piece.end()}) + "},\n";
  }
  return text + fmt::format(R"(  }};
  double inside = x, d;
  int k = 0;
  if (x < at[0]) inside = at[0];
  if (x > at[{0}]) inside = at[{0}];
  while (k < {1} && inside >= at[k + 1]) ++k;
  d = inside - at[k];
  return c[k][0] + d * (c[k][1] + d * (c[k][2] + d * c[k][3])) +
         (x - inside) * (c[k][1] + d * (2.0 * c[k][2] + d * 3.0 * c[k][3]));
)",
                            cubic.pieces.size(), cubic.pieces.size() - 1);
}

std::vector<double> breaks_of(const LawSpec& spec) {
  std::vector<double> breaks;
  if (spec.law == "monotone_spline") {
    for (auto knot = spec.knots.rbegin(); knot != spec.knots.rend(); ++knot) {
      breaks.push_back(-*knot);
    }
    breaks.insert(breaks.begin(), -1.0);
    breaks.push_back(0.0);
    breaks.insert(breaks.end(), spec.knots.begin(), spec.knots.end());
    breaks.push_back(1.0);
  } else if (spec.law == "free_spline") {
    const std::size_t intervals = spec.coefficients.size() - 3;
    for (std::size_t k = 0; k <= intervals; ++k) {
      breaks.push_back(spec.knots[0] + (spec.knots[1] - spec.knots[0]) * static_cast<double>(k) /
                                           static_cast<double>(intervals));
    }
  }
  for (double& b : breaks) b *= spec.scale;
  return breaks;
}

// The cubic with the law's values and slopes at both ends of an interval, taken just inside it.
std::array<double, 4> cubic_between(const Law& law, double from, double to) {
  const double w = to - from;
  const double low = law.value(from);
  const double rise = (law.value(to) - low) / w;
  const double inside = 1e-12 * w;
  const double first = law.slope(from + inside);
  const double last = law.slope(to - inside);
  return {low, first, (3.0 * rise - 2.0 * first - last) / w, (first + last - 2.0 * rise) / (w * w)};
}

}  // namespace

CubicPieces cubic_pieces(const Law& law) {
  CubicPieces cubic{breaks_of(law.spec()), {}};
  for (std::size_t k = 0; k + 1 < cubic.breaks.size(); ++k) {
    cubic.pieces.push_back(cubic_between(law, cubic.breaks[k], cubic.breaks[k + 1]));
  }
  return cubic;
}

Result<std::string> c_law(const LawSpec& spec, const std::string& name) {
  constexpr std::pair<std::string_view, std::string (*)(const LawSpec&)> kForms[] = {
      {"odd_polynomial", odd_polynomial},
      {"bounded_modulation", bounded_modulation},
      {"exponential_modulation", exponential_modulation},
      {"held_modulation", held_modulation},
      {"power_law", power_law},
      {"inverse_odd_polynomial", inverse_odd_polynomial}};
  const auto law = make_law(spec);
  if (!law) return tl::unexpected(law.error());
  const auto function = [&](const std::string& body) {
    return fmt::format("static double {}(double x) {{\n{}}}\n", name, body);
  };
  if (spec.coefficients.empty()) {
    return function("  (void)x;\n  return 1.0;\n");
  }
  const bool falls = std::ranges::any_of(spec.coefficients, [](double c) { return c < 0.0; });
  if (spec.law == "inverse_odd_polynomial" && falls) {
    return failure(ErrorCode::bad_data,
                   "an inverse_odd_polynomial whose polynomial stops rising has no C form",
                   "fit it as a monotone_spline");
  }
  for (const auto& [id, body] : kForms) {
    if (spec.law == id) return function(body(spec));
  }
  if (!cubic_pieces(**law).pieces.empty()) return function(spline(**law));
  return failure(ErrorCode::bad_data, fmt::format("the law {} has no C form", spec.law),
                 "fit another law");
}

}  // namespace flexspline::data
