#include "diagnosis/unnamed/unnamed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/unnamed/smooth_table.hpp"
#include "diagnosis/unnamed/table_form.hpp"
#include "diagnosis/unnamed/unnamed_proof.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kKnots = 12;        // of one coordinate
constexpr int kPairKnots = 6;     // of each of two
constexpr double kBetter = 1.01;  // rows of what is left are not independent of each other
constexpr double kSharp = 0.01;   // of the largest speed: where a direction turns

/// A coordinate that a table may stand over.
struct Coordinate {
  std::string_view name;
  std::string_view unit;
  ArrayXd x;
  bool sides = false;  ///< a direction: its two sides are all there is of it
};

/// A table over some coordinates of an equation.
struct Candidate {
  std::vector<const Coordinate*> over;
  SmoothTable table;
};

ArrayXd within_a_turn(const ArrayXd& angle) {
  const double turn = 2.0 * std::numbers::pi;
  return angle - turn * (angle / turn).floor();
}

bool makes_a_turn(const ArrayXd& angle) {
  return angle.maxCoeff() - angle.minCoeff() > 2.0 * std::numbers::pi;
}

// load: what the model predicts, as the measured torque has the noise of what is to be explained;
// after what is measured.
std::vector<Coordinate> coordinates_of(const Frame& f, Equation equation, const ArrayXd& load) {
  const ArrayXd& speed = speed_of(f, equation);
  const ArrayXd& position = position_of(f, equation);
  std::vector<Coordinate> list = {
      {"velocity", "rad/s", speed},
      {"acceleration", "rad/s2", acceleration_of(f, equation)},
      {"reversal_memory", "rad", since_reversal(f, position, speed)},
      {"time", "s", f.clock},
      {"direction", "1", rounded_sign(speed, kSharp * speed.abs().maxCoeff()), true}};
  if (f.rig == Rig::locked || f.rig == Rig::specimen) {
    list.push_back({"torsion", "rad", f.torsion});
  } else {
    list.push_back({"load_angle", "rad", f.load_angle});
  }
  if (f.rig != Rig::locked && makes_a_turn(f.motor_angle)) {
    list.push_back({"motor_angle", "rad", within_a_turn(f.motor_angle)});
  }
  list.push_back({"load", "Nm", load});
  return list;
}

TableKnots knots_of(const Coordinate& c, const ArrayXd& weight, int count) {
  if (c.sides) return {c.x, {-1.0, 1.0}};
  return {c.x, quantile_knots(c.x, weight, count)};
}

// Each coordinate alone, and any two of them.
std::vector<Candidate> candidates_over(const std::vector<Coordinate>& coordinates,
                                       const ArrayXd& weight) {
  std::vector<Candidate> list;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const Coordinate& a = coordinates[i];
    list.push_back({{&a}, SmoothTable({knots_of(a, weight, kKnots)})});
    for (std::size_t k = i + 1; k < coordinates.size(); ++k) {
      const Coordinate& b = coordinates[k];
      list.push_back({{&a, &b},
                      SmoothTable({knots_of(a, weight, b.sides ? kKnots : kPairKnots),
                                   knots_of(b, weight, a.sides ? kKnots : kPairKnots)})});
    }
  }
  return list;
}

/// The most evident of some tables.
struct Best {
  const Candidate* candidate = nullptr;
  SmoothTable::Fit fit;
};

// Of those that do as well the first.
Best best_of(const std::vector<Candidate>& candidates, const ArrayXd& residual,
             const ArrayXd& weight, double colour) {
  Best best;
  for (const Candidate& one : candidates) {
    auto fit = one.table.fit(residual, weight, colour);
    if (fit.gain > kBetter * best.fit.gain) best = {&one, std::move(fit)};
  }
  return best;
}

/// What is found of one equation in all recordings, over coordinates that outlive it.
struct Found {
  Equation equation = Equation::torsion;
  std::vector<Coordinate> coordinates;
  std::vector<Candidate> candidates;
  Best best;
};

Found found_in(const Frame& frame, const Findings& findings, Equation equation) {
  const std::size_t e = index_of(equation);
  Found found{equation, coordinates_of(frame, equation, findings.fit.prediction[e]), {}, {}};
  found.candidates = candidates_over(found.coordinates, findings.weight[e]);
  found.best = best_of(found.candidates, findings.fit.residual[e], findings.weight[e],
                       findings.noise[e].colour);
  return found;
}

// By tables that the other rows choose.
HoldoutProof proved(const Frame& frame, const Findings& findings, const Proof& proof,
                    const Found& found) {
  const std::size_t e = index_of(found.equation);
  return proof_of_part(frame, findings, proof, found.equation,
                       [&](const ModelFit& fold, const ArrayXd& weight) -> ArrayXd {
                         const Best best = best_of(found.candidates, fold.residual[e], weight,
                                                   findings.noise[e].colour);
                         if (best.candidate == nullptr) return ArrayXd::Zero(frame.rows());
                         return best.candidate->table.at_rows(best.fit.u);
                       });
}

// Of the mean square beyond noise that is left on recordings held out.
double share_of_rest(const HoldoutProof& h) {
  const double noise = h.noise_floor * h.noise_floor;
  const double rest = h.rmse_before * h.rmse_before - noise;
  const double taken = h.rmse_before * h.rmse_before - h.rmse_after * h.rmse_after;
  return rest > 0.0 ? std::clamp(taken / rest, 0.0, 1.0) : kNotComputed;
}

std::string in_words(const UnnamedPart& part) {
  std::vector<std::string> names;
  for (const TableAxis& axis : part.axes) names.push_back(axis.coordinate);
  return fmt::format(
      "Without a name: a function of {} in the {} equation, as a table, lowers the error on "
      "recordings held out to {:.0f} % of what the model leaves (95 %: {:.0f} to {:.0f}). {}",
      fmt::join(names, " and "), part.equation, 100.0 * part.holdout_ratio, 100.0 * part.ci95_lower,
      100.0 * part.ci95_upper,
      part.proposed_equation.empty()
          ? "No short formula follows it."
          : fmt::format("A formula that follows it (SI): {}.", part.proposed_equation));
}

UnnamedPart spelled(const Frame& frame, const Findings& findings, const Found& found,
                    const HoldoutProof& h) {
  UnnamedPart part;
  part.equation = name_of(found.equation);
  part.share = share_of_rest(h);
  part.holdout_ratio = h.ratio;
  part.ci95_lower = h.ci95_lower;
  part.ci95_upper = h.ci95_upper;
  const auto& [candidate, fit] = found.best;
  const SmoothTable& table = candidate->table;
  part.evidence = fit.gain;
  part.size_fraction =
      (table.at_rows(fit.u).abs() * frame.usable).maxCoeff() / frame.largest_torque(found.equation);
  for (std::size_t a = 0; a < candidate->over.size(); ++a) {
    part.axes.push_back({std::string(candidate->over[a]->name),
                         std::string(candidate->over[a]->unit), table.axes()[a].knots});
  }
  part.torque.assign(fit.u.begin(), fit.u.end());
  part.proposed_equation =
      form_of(part.axes, fit.u, table.occupation(findings.weight[index_of(found.equation)]));
  part.says = in_words(part);
  return part;
}

std::optional<UnnamedPart> part_of(const Frame& frame, const Selection& s, const Proof& proof,
                                   const Limits& limits, const Found& found) {
  const HoldoutProof h = proved(frame, s.final, proof, found);
  if (!is_proved_part(frame, h, found.equation, limits)) return std::nullopt;
  return spelled(frame, s.final, found, h);
}

}  // namespace

std::array<double, 3> left_to_tables(const Frame& frame, const Findings& model) {
  std::array<double, 3> evidence{};
  for (Equation equation : frame.equations) {
    evidence[index_of(equation)] = found_in(frame, model, equation).best.fit.gain;
  }
  return evidence;
}

std::optional<UnnamedPart> unnamed_part(const Frame& frame, const Selection& s, const Proof& proof,
                                        const Limits& limits) {
  std::optional<Found> most;
  for (Equation equation : frame.equations) {
    Found found = found_in(frame, s.final, equation);
    if (found.best.candidate == nullptr) continue;
    if (!most || found.best.fit.gain > most->best.fit.gain) most = std::move(found);
  }
  return most ? part_of(frame, s, proof, limits, *most) : std::nullopt;
}

}  // namespace flexspline::studies
