#include "torsion/free_terms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "torsion/torque_residuals.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/identifiability.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kLogModulationLimit = 0.1;  // sd of ln h: h to ten percent
constexpr double kTorqueLimit = 0.02;        // sd of a term's largest torque, of peak effort
constexpr double kProbe = 0.9;               // of the range, where ln h is judged
// Beyond it only the coarseness of the splines, not the recordings, would tell h from g^-1.
constexpr double kLargestCosine = 0.999;
constexpr double kDegrees = 180.0 / std::numbers::pi;

double half_range(const PreparedRecord& one) {
  const auto [low, high] = std::ranges::minmax(one.smooth.motion.position);
  return 0.5 * (high - low);
}

std::vector<Eigen::Index> columns_of(const Group& group) {
  std::vector<Eigen::Index> list;
  for (std::size_t k = group.first; k < group.first + group.count; ++k) {
    list.push_back(static_cast<Eigen::Index>(k));
  }
  return list;
}

std::vector<Eigen::Index> joined(std::vector<Eigen::Index> a, const std::vector<Eigen::Index>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Covariance of the chosen columns at unit noise (residuals are already divided by it).
Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& jacobian) {
  return sandwich(jacobian, jacobian.transpose() * jacobian,
                  std::vector<bool>(static_cast<std::size_t>(jacobian.cols()), false));
}

double log_h_std(const Eigen::MatrixXd& covariance) {
  double worst = 0.0;
  const Eigen::Index terms = static_cast<Eigen::Index>(kModulationTerms);
  const Eigen::MatrixXd part = covariance.bottomRightCorner(terms, terms);
  for (double u : {-kProbe, kProbe}) {
    Eigen::VectorXd powers(terms);
    for (Eigen::Index k = 0; k < terms; ++k) powers[k] = std::pow(u, static_cast<double>(k + 1));
    worst = std::max(worst, std::sqrt(std::max(0.0, powers.dot(part * powers))));
  }
  return worst;
}

struct Candidate {
  std::string name;
  Group group;
  double torque_per_unit;  // its largest torque per unit of the parameter
};

double largest_rate(const std::vector<PreparedRecord>& records) {
  double rate = 0.0;
  for (const auto& one : records) {
    for (double t : one.record.time) rate = std::max(rate, std::abs(one.effort.slope(t)));
  }
  return rate;
}

// Nominal words for what a recording of the same rig would look like.
std::string motion_of(const PreparedRecord& widest, double share) {
  const double motion = share * half_range(widest);
  return widest.record.linear ? fmt::format("{:.3g} mm", 1e3 * motion)
                              : fmt::format("{:.3g} deg", motion * kDegrees);
}

// A second amplitude or frequency tells h; a second frequency alone inertia and delay.
std::string missing_recording(const std::vector<PreparedRecord>& records, bool amplitude_too) {
  const auto& widest = *std::ranges::max_element(records, {}, half_range);
  if (!widest.smooth.steady) {
    return fmt::format("the same motion at half the speed{}",
                       amplitude_too
                           ? ", or a loop of half the amplitude (" + motion_of(widest, 0.5) + ")"
                           : std::string());
  }
  const double frequency = 1.0 / widest.smooth.steady->period;
  return fmt::format("{}a loop at half the frequency ({} at {:.3g} Hz)",
                     amplitude_too
                         ? fmt::format("a loop of half the amplitude ({} at {:.3g} Hz), or ",
                                       motion_of(widest, 0.5), frequency)
                         : std::string(),
                     motion_of(widest, 1.0), 0.5 * frequency);
}

std::string says_of(double sd, double cosine, const std::vector<PreparedRecord>& recordings,
                    bool free) {
  const std::size_t records = recordings.size();
  if (free) {
    return fmt::format(
        "h can be told from f and g^-1 on these {} recordings: ln h to +-{:.2g} at "
        "0.9 of the range (largest cosine {:.4f})",
        records, sd, cosine);
  }
  return fmt::format(
      "h cannot be identified from {}: a direction of ln h lies within cosine {:.6f} of what f and "
      "g^-1 can do, so its standard deviation at 0.9 of the range would be {:.2g}. h = 1 is "
      "assumed, not found. Missing: {}",
      records == 1 ? std::string("one recording") : fmt::format("these {} recordings", records),
      cosine, sd, missing_recording(recordings, true));
}

}  // namespace

Result<TermDecision> decide_terms(const LinearStart& start,
                                  const std::vector<PreparedRecord>& records, FreeTerms base,
                                  AllowedTerms allowed) {
  FreeTerms all = base;
  all.h = kModulationTerms;
  all.inertia = all.delay = true;
  all.initial = false;
  const LinearStart probe = with_terms(start, all);
  const TorsionLayout& layout = probe.layout;
  const auto at = linearise(TorqueResiduals(layout, records), probe.p);
  if (!at) return tl::unexpected(at.error());
  const Eigen::MatrixXd& j = at->jacobian;
  auto rest = joined(columns_of(layout.f_group), columns_of(layout.g_group));
  rest = joined(rest, columns_of(layout.offset_group));
  rest = joined(rest, columns_of(layout.zero_group));

  TermDecision decision;
  decision.free = base;
  const auto h_columns = columns_of(layout.h_group);
  const double cosine = largest_cosine(j(Eigen::all, h_columns), j(Eigen::all, rest));
  decision.log_h_std = log_h_std(covariance_of(j(Eigen::all, joined(rest, h_columns))));
  decision.condition = scaled_condition(j(Eigen::all, joined(rest, h_columns)));
  decision.absorbed.push_back({"h", "f, g_inverse", cosine});
  const bool tells = decision.log_h_std <= kLogModulationLimit && cosine <= kLargestCosine;
  decision.free.h = allowed.h && tells ? kModulationTerms : 0;
  decision.verdict = tells ? "identifiable" : "not_identifiable";
  decision.says = says_of(decision.log_h_std, cosine, records, tells);
  if (!allowed.h) {
    decision.verdict = "not_asked";
    decision.says = "h = 1 was set, so nothing is said of it";
  }

  const Ranges ranges = ranges_of(records, base.zeros);
  const std::vector<Candidate> candidates = {{"inertia", layout.inertia_group, ranges.acceleration},
                                             {"delay", layout.delay_group, largest_rate(records)}};
  const auto with_h = decision.free.h > 0 ? joined(rest, h_columns) : rest;
  for (const auto& candidate : candidates) {
    const auto own = columns_of(candidate.group);
    const Eigen::MatrixXd covariance = covariance_of(j(Eigen::all, joined(with_h, own)));
    const double sd = std::sqrt(covariance(covariance.rows() - 1, covariance.cols() - 1)) *
                      candidate.torque_per_unit / ranges.effort;
    decision.absorbed.push_back({candidate.name, "f, g_inverse",
                                 largest_cosine(j(Eigen::all, own), j(Eigen::all, with_h))});
    const bool can = sd <= kTorqueLimit;
    const bool may = candidate.name == "inertia" ? allowed.inertia : allowed.delay;
    (candidate.name == "inertia" ? decision.free.inertia : decision.free.delay) = may && can;
    if (may && !can) {
      decision.notes.push_back(
          fmt::format("{} is not fitted: f and g^-1 imitate it on these recordings. Missing: {}",
                      candidate.name, missing_recording(records, false)));
    }
  }
  return decision;
}

}  // namespace flexspline::estimators
