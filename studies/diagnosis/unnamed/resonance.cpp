#include "diagnosis/unnamed/resonance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "diagnosis/frame/mode.hpp"
#include "diagnosis/proof/held_out_error.hpp"
#include "diagnosis/unnamed/unnamed_proof.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr std::array<double, 2> kDampings = {0.03, 0.2};  // initial guesses: rings, hardly rings
// Steps from one guess to the next: of frequency the half-power width of the narrowest.
constexpr double kOfFrequency = 1.0 + 2.0 * kDampings.front();
constexpr double kOfDamping = kDampings.back() / kDampings.front();
constexpr double kKept = 0.5;     // of a bandwidth: smoothing takes 1/65 of a motion, or less
constexpr int kHalvings = 5;      // to 0.2 % of a frequency, 6 % of a damping ratio
constexpr double kAlike = 1e-12;  // one less a squared correlation: rounding

/// A mode whose answer is fitted to the rows that have a weight: a (q - u) + b q'/w.
struct ModeFit {
  Mode mode;
  double a = 0.0, b = 0.0;
  double gain = 0.0;  ///< fall of the weighted sum of squares
};

// The measured torque of the transmission is an input of the motor equation, so that its noise is
// in both prediction and residual; what the torsion equation predicts of it has none.
ArrayXd torque_of(const Frame& frame, const ModelFit& model, Equation equation) {
  const ArrayXd& u = model.prediction[index_of(equation)];
  if (equation != Equation::motor || !frame.has(Equation::torsion)) return u;
  return u - model.residual[index_of(Equation::torsion)] / frame.ratio;
}

ModeFit fitted(const Frame& frame, const ArrayXd& u, const ArrayXd& residual, const ArrayXd& weight,
               const Mode& mode) {
  const ModeAnswer answer = answer_of(frame, u, mode);
  const ArrayXd x = answer.place * weight, y = answer.speed * weight;
  const double xx = x.square().sum(), yy = y.square().sum(), xy = (x * y).sum();
  const double xr = (x * residual * weight).sum(), yr = (y * residual * weight).sum();
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > kAlike * xx * yy)) return {mode};
  const double a = (yy * xr - xy * yr) / determinant, b = (xx * yr - xy * xr) / determinant;
  return {mode, a, b, a * xr + b * yr};
}

// Of the accelerations that an equation has, where it is judged.
double narrowest_bandwidth(const Frame& frame, Equation equation) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (equation == Equation::torsion || frame.motor_bandwidth.size() == 0) return kNone;
  return (frame.rows_of(equation) > 0.0).select(frame.motor_bandwidth, kNone).minCoeff();
}

/// The modes that recordings can tell: with a period in the longest, and five rows a period; that
/// decay in the longest, and have a peak; of accelerations what smoothing leaves as it is.
struct Range {
  Range(const Frame& frame, Equation equation)
      : lowest(std::max(slowest_mode(frame), kTurn / frame.duration)),
        highest(std::min(fastest_mode(frame), kKept * narrowest_bandwidth(frame, equation))),
        least_decay(1.0 / frame.duration) {}

  /// False where nothing moves or no time passes.
  bool is_known() const { return lowest > 0.0 && std::isfinite(highest); }
  bool has(const Mode& mode) const {
    return mode.frequency >= lowest && mode.frequency <= highest &&
           mode.damping * mode.frequency >= least_decay && mode.damping <= kMostDamping;
  }

  double lowest, highest;  // rad/s
  double least_decay;      // 1/s
};

std::vector<Mode> first_guesses(const Range& range) {
  std::vector<Mode> modes;
  if (!range.is_known()) return modes;
  for (double w = range.lowest; w < range.highest; w *= kOfFrequency) {
    for (double z : kDampings) modes.push_back({w, z});
  }
  return modes;
}

using FitOfMode = std::function<ModeFit(const Mode&)>;

// The best of a mode's neighbours, or none that is better.
bool moved(ModeFit& best, const Range& range, double of_frequency, double of_damping,
           const FitOfMode& fit) {
  const Mode from = best.mode;
  for (const auto& [w, z] : {Mode{of_frequency, 1.0}, Mode{1.0 / of_frequency, 1.0},
                             Mode{1.0, of_damping}, Mode{1.0, 1.0 / of_damping}}) {
    const Mode mode{from.frequency * w, from.damping * z};
    if (!range.has(mode)) continue;
    const ModeFit other = fit(mode);
    if (other.gain > best.gain) best = other;
  }
  return best.mode.frequency != from.frequency || best.mode.damping != from.damping;
}

// Pattern search (Hooke and Jeeves 1961): steps that are halved where none helps.
ModeFit refined(ModeFit best, const Range& range, const FitOfMode& fit) {
  double of_frequency = kOfFrequency, of_damping = kOfDamping;
  for (int i = 0; i < kHalvings; ++i) {
    of_frequency = std::sqrt(of_frequency), of_damping = std::sqrt(of_damping);
    while (moved(best, range, of_frequency, of_damping, fit)) {
    }
  }
  return best;
}

// None that gains: its parts are zero.
ModeFit best_mode(const Frame& frame, const ModelFit& model, Equation equation,
                  const ArrayXd& weight, unsigned threads) {
  const ArrayXd u = torque_of(frame, model, equation);
  const ArrayXd& residual = model.residual[index_of(equation)];
  const auto fit = [&](const Mode& mode) { return fitted(frame, u, residual, weight, mode); };
  const Range range(frame, equation);
  const auto modes = first_guesses(range);
  std::vector<ModeFit> fits(modes.size());
  in_parallel(modes.size(), threads_for(threads), [&](std::size_t i) { fits[i] = fit(modes[i]); });
  const auto best = std::ranges::max_element(fits, {}, &ModeFit::gain);
  return best == fits.end() ? ModeFit{} : refined(*best, range, fit);
}

ArrayXd part_of(const Frame& frame, const ModelFit& model, Equation equation, const ModeFit& fit) {
  if (!(fit.gain > 0.0)) return ArrayXd::Zero(frame.rows());
  const ModeAnswer answer = answer_of(frame, torque_of(frame, model, equation), fit.mode);
  return fit.a * answer.place + fit.b * answer.speed;
}

std::optional<Resonance> resonance_in(const Frame& frame, const Findings& final, const Proof& proof,
                                      const Limits& limits, Equation equation) {
  const std::size_t e = index_of(equation);
  const double torque = frame.largest_torque(equation);
  const ModeFit whole = best_mode(frame, final.fit, equation, final.weight[e], limits.threads);
  const ArrayXd rows = frame.rows_of(equation);
  const ArrayXd part = part_of(frame, final.fit, equation, whole) * rows;
  // What takes no more than a trifle where it is fitted need not be tried elsewhere.
  if (!(rms_on(part, rows) > limits.trifle() * torque)) return std::nullopt;
  const auto by_fold = [&](const ModelFit& fold, const ArrayXd& weight) {
    return part_of(frame, fold, equation, best_mode(frame, fold, equation, weight, limits.threads));
  };
  const HoldoutProof h = proof_of_part(frame, final, proof, equation, by_fold);
  if (!is_proved_part(frame, h, equation, limits)) return std::nullopt;
  return Resonance{equation, whole.mode.frequency, whole.mode.damping,
                   part.abs().maxCoeff() / torque, h};
}

}  // namespace

std::optional<Resonance> find_resonance(const Frame& frame, const Findings& final,
                                        const Proof& proof, const Limits& limits) {
  const auto share = [&](const Resonance& one) {
    return taken_by_part(one.proof) / frame.largest_torque(one.equation);
  };
  std::optional<Resonance> most;
  for (Equation equation : frame.equations) {
    auto one = resonance_in(frame, final, proof, limits, equation);
    if (one && (!most || share(*one) > share(*most))) most = std::move(one);
  }
  return most;
}

std::string in_words(const Resonance& r) {
  return fmt::format(
      "the {} equation misses a resonance at {:.3g} Hz (damping ratio {:.2g}, {:.2g} % of torque "
      "at "
      "most): with a mode that answers its torque the error on recordings held out falls to {:.0f} "
      "% "
      "(95 %: {:.0f} to {:.0f})",
      name_of(r.equation), r.frequency / kTurn, r.damping, 100.0 * r.size, 100.0 * r.proof.ratio,
      100.0 * r.proof.ci95_lower, 100.0 * r.proof.ci95_upper);
}

}  // namespace flexspline::studies
