#include "given_model/given_start.hpp"

#include <algorithm>
#include <cmath>

#include "flexspline/estimators/separable.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kProbe = 0.3;         // of an unknown's size
constexpr double kAffine = 1e-7;       // curvature over change that counts as none
constexpr double kDependent = 1e-6;    // share of a column that others leave
constexpr double kReach = 30.0;        // factor either way within which shapes are sought
constexpr double kSignedReach = 10.0;  // sizes either way, of shapes that have a sign

using Point = std::vector<double>;

void append(std::vector<double>& all, const std::vector<double>& part,
            const std::vector<double>& weight) {
  for (std::size_t i = 0; i < part.size(); ++i) all.push_back(weight[i] * part[i]);
}

/// Predictions of all recordings, one below the other, times their weights.
class Predictor {
 public:
  explicit Predictor(const GivenResiduals& problem) : problem_(problem) {}

  Result<Eigen::VectorXd> at(std::span<const double> q) const {
    std::vector<double> all;
    for (std::size_t b = 0; b < problem_.blocks(); ++b) {
      const auto part = problem_.predict(b, q);
      if (!part) return tl::unexpected(part.error());
      append(all, *part, problem_.weight(b));
    }
    return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

 private:
  const GivenResiduals& problem_;
};

double probe_of(const GivenParameter& one) {
  const double size = std::abs(one.start) > 0.0 ? std::abs(one.start) : 1.0;
  return one.start + 2.0 * kProbe * size <= one.upper ? kProbe * size : -kProbe * size;
}

bool negligible(const Eigen::VectorXd& curvature, const Eigen::VectorXd& change) {
  return curvature.allFinite() && curvature.norm() <= kAffine * change.norm();
}

/// Whether the prediction is affine in an unknown and in all that were taken before, together.
bool joins(const Predictor& predict, const Eigen::VectorXd& base, const Point& start,
           const Point& moved, const Eigen::VectorXd& at_moved, std::size_t k, double probe) {
  Point q = start;
  q[k] += probe;
  const auto once = predict.at(q);
  q[k] += probe;
  const auto twice = predict.at(q);
  Point both = moved;
  both[k] += probe;
  const auto together = predict.at(both);
  if (!once || !twice || !together) return false;
  const Eigen::VectorXd change = *once - base;
  return negligible(*twice - *once - change, change) &&
         negligible(*together - at_moved - change, change);
}

Result<std::vector<bool>> affine_unknowns(const GivenResiduals& problem, const Predictor& predict,
                                          const Point& start) {
  const auto base = predict.at(start);
  if (!base) return tl::unexpected(base.error());
  Point moved = start;
  Eigen::VectorXd at_moved = *base;
  std::vector<bool> affine(start.size(), false);
  for (std::size_t k = 0; k < start.size(); ++k) {
    const GivenParameter& one = problem.unknowns()[k];
    const double probe = probe_of(one);
    if (k >= problem.of_model() || !joins(predict, *base, start, moved, at_moved, k, probe)) {
      continue;
    }
    affine[k] = true;
    moved[k] += probe;
    at_moved = *predict.at(moved);
  }
  return affine;
}

/// Those of the affine unknowns whose columns are no combination of columns before them; the others
/// stay at their starts until what tells them apart joins the model.
Result<std::vector<bool>> told_apart(const Predictor& predict, const Point& start,
                                     const GivenResiduals& problem, std::vector<bool> affine) {
  const auto base = predict.at(start);
  if (!base) return tl::unexpected(base.error());
  std::vector<Eigen::VectorXd> directions;
  for (std::size_t k = 0; k < start.size(); ++k) {
    if (!affine[k]) continue;
    Point q = start;
    q[k] += probe_of(problem.unknowns()[k]);
    const auto moved = predict.at(q);
    if (!moved) return tl::unexpected(moved.error());
    Eigen::VectorXd column = *moved - *base;
    const double size = column.norm();
    for (const auto& one : directions) column -= one.dot(column) * one;
    affine[k] = column.norm() > kDependent * size;
    if (affine[k]) directions.push_back(column.normalized());
  }
  return affine;
}

/// A shape's place in the search: in the logarithm where it has one sign.
struct Place {
  std::size_t unknown;
  bool logarithmic;
  ShapeBound bound;

  double outer(double q) const { return logarithmic ? std::exp(q) : q; }
};

Place place_of(const GivenParameter& one, std::size_t unknown) {
  const bool logarithmic = one.lower >= 0.0 && one.start > 0.0;
  if (logarithmic) {
    const double low = std::max(one.lower, one.start / kReach);
    const double high = std::min(one.upper, one.start * kReach);
    return {unknown, true, {std::log(one.start), std::log(low), std::log(high)}};
  }
  const double reach = kSignedReach * std::max(std::abs(one.start), 1.0);
  return {
      unknown,
      false,
      {one.start, std::max(one.lower, one.start - reach), std::min(one.upper, one.start + reach)}};
}

SeparableBlock block_at(const Predictor& predict, const GivenResiduals& problem, Point q,
                        const std::vector<std::size_t>& linear, const Eigen::VectorXd& measured) {
  SeparableBlock block;
  const auto rows = measured.size();
  block.columns.resize(rows, static_cast<Eigen::Index>(linear.size()));
  block.target = measured;
  const auto base = predict.at(q);
  if (!base) {
    block.columns.setConstant(std::nan(""));
    return block;
  }
  block.target -= *base;
  for (std::size_t j = 0; j < linear.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    const std::size_t k = linear[j];
    const double value = q[k];
    const double probe = probe_of(problem.unknowns()[k]);
    q[k] = value + probe;
    const auto moved = predict.at(q);
    q[k] = value;
    block.columns.col(column) = moved ? Eigen::VectorXd((*moved - *base) / probe)
                                      : Eigen::VectorXd::Constant(rows, std::nan(""));
    block.target += value * block.columns.col(column);
    block.index.push_back(column);
  }
  return block;
}

Eigen::VectorXd measured_of(const GivenResiduals& problem) {
  std::vector<double> all;
  for (std::size_t b = 0; b < problem.blocks(); ++b) {
    append(all, problem.measured(b), problem.weight(b));
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace

Result<std::vector<double>> given_start(const GivenResiduals& problem, int most_steps) {
  const Predictor predict(problem);
  Point start;
  for (const GivenParameter& one : problem.unknowns()) start.push_back(one.start);
  const auto affine = affine_unknowns(problem, predict, start);
  if (!affine) return tl::unexpected(affine.error());
  const auto linear_in = told_apart(predict, start, problem, *affine);
  if (!linear_in) return tl::unexpected(linear_in.error());
  std::vector<std::size_t> linear;
  std::vector<Place> shapes;
  SeparableProblem separable;
  std::vector<double> lower;
  for (std::size_t k = 0; k < start.size(); ++k) {
    const GivenParameter& one = problem.unknowns()[k];
    if ((*linear_in)[k]) {
      linear.push_back(k);
      lower.push_back(one.lower);
    } else if (!(*affine)[k]) {
      shapes.push_back(place_of(one, k));
      separable.shapes.push_back(shapes.back().bound);
    }
  }
  separable.lower =
      Eigen::Map<Eigen::VectorXd>(lower.data(), static_cast<Eigen::Index>(lower.size()));
  const Eigen::VectorXd measured = measured_of(problem);
  const auto point = [&](std::span<const double> q) {
    Point at = start;
    for (std::size_t s = 0; s < shapes.size(); ++s) at[shapes[s].unknown] = shapes[s].outer(q[s]);
    return at;
  };
  separable.assemble = [&](std::span<const double> q) {
    return std::vector{block_at(predict, problem, point(q), linear, measured)};
  };
  const auto found = fit_separable(separable, most_steps);
  if (!found) return tl::unexpected(found.error());
  Point result = point(found->q);
  for (std::size_t j = 0; j < linear.size(); ++j) {
    result[linear[j]] =
        std::min(found->b[static_cast<Eigen::Index>(j)], problem.unknowns()[linear[j]].upper);
  }
  return result;
}

}  // namespace flexspline::estimators
