#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/lag.hpp"

namespace flexspline::data {
namespace {

constexpr SanityVerdict kDelayed{"check_channel", Severity::warning,
                                 "sample both channels at one instant, or shift one of them by it"};
constexpr SanityVerdict kFiltered{
    "check_channel", Severity::warning,
    "record every channel behind the same filter, or with a higher cut-off"};

constexpr double kLeastPhase = 0.15;  // rad of the fastest motion: less is a cause to diagnose
constexpr double kLeft = 0.4;         // of what is unexplained without a lag

SanityFinding finding(const Relation& relation, const Lag& lag) {
  const bool filtered = lag.kind == LagKind::low_pass;
  const std::string seen = fmt::format(
      "{} {} {}: {:.3g} s, {:.2g} rad of the fastest motion, leave {:.0f} % of what is "
      "unexplained without",
      relation.late,
      filtered           ? "is behind a low pass against"
      : lag.amount > 0.0 ? "comes later than"
                         : "comes earlier than",
      relation.than, std::abs(lag.amount), lag.phase, 100.0 * lag.left);
  return (filtered ? kFiltered : kDelayed).on("", seen);
}

// A delay and a low pass look alike where the motion is slow against them: what explains more is
// said.
std::vector<SanityFinding> find(const ObservedSet& all) {
  for (const Relation& relation : relations_of(all)) {
    std::optional<Lag> best = best_lag(relation, LagKind::delay);
    const auto low_pass = best_lag(relation, LagKind::low_pass);
    if (low_pass && (!best || low_pass->left < best->left)) best = low_pass;
    if (best && best->phase > kLeastPhase && best->left < kLeft) {
      return {finding(relation, *best)};
    }
  }
  return {};
}

}  // namespace

SanityRow describe_late_channel() {
  return {"late_channel",
          "a channel that is delayed, or filtered, against the others",
          {kDelayed, kFiltered},
          find};
}

}  // namespace flexspline::data
