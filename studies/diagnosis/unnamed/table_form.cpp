#include "diagnosis/unnamed/table_form.hpp"

#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <Eigen/QR>

namespace flexspline::studies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMostTerms = 3;
constexpr int kMostHarmonics = 4;
constexpr double kFollowed = 0.9;  // of the table's mean square
constexpr double kWorthATerm = 0.03;

/// A function of one coordinate, and how it is written.
struct Function {
  std::string text;
  std::function<double(double)> value;
};

/// A product of one function of every coordinate, at all knots.
struct Term {
  std::string text;
  VectorXd value;
};

std::string symbol_of(const std::string& coordinate) {
  static const std::map<std::string, std::string, std::less<>> symbols = {
      {"torsion", "phi"},     {"velocity", "w"},        {"load", "tau"},
      {"acceleration", "w'"}, {"reversal_memory", "s"}, {"time", "t"},
      {"direction", "sgn w"}, {"load_angle", "theta"},  {"motor_angle", "theta_m"}};
  const auto known = symbols.find(coordinate);
  return known == symbols.end() ? coordinate : known->second;
}

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

std::vector<Function> functions_of(const TableAxis& axis) {
  const std::string x = symbol_of(axis.coordinate);
  std::vector<Function> list = {{"", [](double) { return 1.0; }}, {x, [](double v) { return v; }}};
  if (axis.coordinate == "direction") return list;
  if (axis.coordinate == "motor_angle") {
    list.pop_back();
    for (int k = 1; k <= kMostHarmonics; ++k) {
      const std::string of = k == 1 ? x : fmt::format("{} {}", k, x);
      list.push_back({fmt::format("sin({})", of), [k](double v) { return std::sin(k * v); }});
      list.push_back({fmt::format("cos({})", of), [k](double v) { return std::cos(k * v); }});
    }
    return list;
  }
  list.push_back({fmt::format("{}^2", x), [](double v) { return v * v; }});
  if (axis.values.front() >= 0.0) return list;
  list.push_back({fmt::format("|{}|", x), [](double v) { return std::abs(v); }});
  list.push_back({fmt::format("{0} |{0}|", x), [](double v) { return v * std::abs(v); }});
  list.push_back({fmt::format("{}^3", x), [](double v) { return v * v * v; }});
  list.push_back({fmt::format("sgn({})", x), sign});
  return list;
}

std::vector<Term> terms_over(const std::vector<TableAxis>& axes) {
  std::vector<Term> terms;
  const std::vector<double> one = {0.0};
  const bool pair = axes.size() > 1;
  const auto& outer = axes.front().values;
  const auto& inner = pair ? axes.back().values : one;
  const std::vector<Function> alone = {{"", [](double) { return 1.0; }}};
  for (const Function& f : functions_of(axes.front())) {
    for (const Function& g : pair ? functions_of(axes.back()) : alone) {
      Term term{f.text + (f.text.empty() || g.text.empty() ? "" : " ") + g.text,
                VectorXd(static_cast<Index>(outer.size() * inner.size()))};
      Index at = 0;
      for (const double x : outer) {
        for (const double y : inner) term.value[at++] = f.value(x) * g.value(y);
      }
      terms.push_back(std::move(term));
    }
  }
  return terms;
}

/// Least squares of a table by some terms.
struct Fitted {
  VectorXd coefficients;
  double followed = 0.0;  ///< share of the mean square
};

Fitted fitted(const std::vector<const Term*>& terms, const VectorXd& values,
              const VectorXd& weight) {
  MatrixXd columns(values.size(), static_cast<Index>(terms.size()));
  for (std::size_t k = 0; k < terms.size(); ++k) {
    columns.col(static_cast<Index>(k)) = terms[k]->value.cwiseProduct(weight);
  }
  const VectorXd y = values.cwiseProduct(weight);
  Fitted fit;
  fit.coefficients = columns.colPivHouseholderQr().solve(y);
  fit.followed = 1.0 - (y - columns * fit.coefficients).squaredNorm() / y.squaredNorm();
  return fit;
}

std::string written(const std::vector<const Term*>& terms, const VectorXd& coefficients) {
  std::string text = "tau +=";
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double c = coefficients[static_cast<Index>(k)];
    const bool first = k == 0;
    text += fmt::format(" {}{:.3g}", first ? (c < 0.0 ? "-" : "") : (c < 0.0 ? "- " : "+ "),
                        std::abs(c));
    if (!terms[k]->text.empty()) text += " " + terms[k]->text;
  }
  return text;
}

}  // namespace

std::string form_of(const std::vector<TableAxis>& axes, const VectorXd& values,
                    const VectorXd& occupation) {
  const VectorXd weight = occupation.cwiseSqrt();
  if (!(values.cwiseProduct(weight).squaredNorm() > 0.0)) return {};
  const std::vector<Term> terms = terms_over(axes);
  std::vector<const Term*> chosen;
  Fitted best;
  while (chosen.size() < kMostTerms && best.followed < kFollowed) {
    const Term* next = nullptr;
    const double before = best.followed;
    for (const Term& term : terms) {
      auto more = chosen;
      more.push_back(&term);
      Fitted fit = fitted(more, values, weight);
      if (fit.followed > best.followed + 1e-9) best = std::move(fit), next = &term;
    }
    if (next == nullptr || best.followed < before + kWorthATerm) return {};
    chosen.push_back(next);
  }
  return best.followed < kFollowed ? std::string() : written(chosen, best.coefficients);
}

}  // namespace flexspline::studies
