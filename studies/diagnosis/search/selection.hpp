#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/search/locate.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// Limits of the decision, in chi square over the noise's colour and in shares. Where they come
/// from: docs/diagnosis.md, docs/decisions/0029 and 0031.
struct Limits {
  double gain = 18.0;        ///< least net gain of a cause, least gain of one on recordings held
                             ///< out, and statistic of a coordinate that says something is left
  double named_gain = 80.0;  ///< least net gain of a cause that is named, or stands in a shadow
  double interest = 0.008;   ///< least size of a cause, share of the largest torque
  double half = 0.5;         ///< the larger part: of a gain, a misfit, a torque or its variance
  double quarter = 0.25;  ///< least share of the fast changes in steady strokes that is named; of
                          ///< a peak, a trifle
  double shadow = 0.03;   ///< gain over that of a larger cause of the same equation
  double tenth = 0.1;     ///< of a residual, a gain, or of what could stand for the same: no trifle
  double probability = 0.6;   ///< least probability of a name or one of its alternatives
  std::size_t incidents = 3;  ///< stretches of single recordings that are left out at most
  int rounds = 7;
  unsigned threads = 0;  ///< 0: as many as the machine has

  /// Rms share of the largest torque below which an error is no matter: a quarter of a peak.
  double trifle() const { return quarter * interest; }
  /// Share of another's gain: as good as that.
  double alike() const { return 1.0 - tenth; }
  /// Mean square over the noise's from which noise is the smaller part.
  double as_noise() const { return 1.0 / half; }
};

/// A cause that was accepted, with the others that did nearly as well.
struct Accepted {
  Trial trial;
  double first_gain = 0.0;    ///< when it was accepted; trial.gain is what it is worth at the end
  std::vector<Trial> rivals;  ///< alternatives, best first
  std::vector<Trial> field;   ///< every other cause refined in that round
  bool material = true;       ///< else it is in the model, but too small to be named
  std::string_view withdrawn_because = {};
  double probability = kNotComputed;  ///< of the name or an alternative, once it is confirmed
};

/// The end of the search.
struct Selection {
  Findings baseline;  ///< with the immaterial causes, which come first in its model
  Findings final;     ///< with the accepted causes behind them, and the unnamed behind those
  std::vector<Accepted> immaterial;  ///< significant, but too small to be named, or of the baseline
  std::vector<Accepted> accepted;
  std::vector<Accepted> unnamed;  ///< last in the final model: confirmed, their names improbable
  std::vector<Trial> last_field;  ///< of the round in which none was accepted
  std::vector<CoordinateScore> before;  ///< coordinates of the baseline's residual: locate_misfit()
  std::vector<CoordinateScore> after;   ///< of the final residual
  bool remainder = false;               ///< something is left beyond noise
  std::vector<Accepted> withdrawn;      ///< causes that explain too little to be named
  std::vector<const CauseRow*> redundant;  ///< what the others explain as well, named or not
};

/// The best of what was tried on one model, with the others that did nearly as well.
Accepted accept(std::vector<Trial> trials, std::size_t best, const Limits& limits);

/// True for a part of the baseline that adds more to its law than such parts do: something else.
bool is_no_part(const CauseRow& row, const Eigen::VectorXd& coefficients);

/// True for columns that the baseline counteracts: large, and not nearly all of them is seen.
bool is_taken_up(const Trial& trial, const Limits& limits);

/// True for a part of the baseline beside which a cause gains less than a name has to.
bool goes_before(const Trial& part, const Trial& cause, const Limits& limits);

/// Makes a cause material that was too small to be named when it was accepted, and now adds
/// limits.interest of the largest torque and is worth limits.named_gain beside what came after it.
void judge_small_again(const Frame& frame, const Limits& limits, Selection& selection);

/// The fit with causes added while the best takes limits.tenth of the misfit beyond noise that is
/// left; none is taken out again. Errors: as those of a fit.
Result<Findings> nearest_model(const Frame& frame, const Limits& limits,
                               const std::function<void(double, std::string_view)>& progress);

/// Forward selection: the best cause, then all shapes again, then the next; then each cause taken
/// out again. Where another selection of nearly the same frame is given, it goes on from its
/// causes, and what was redundant there is not tried again. Neither settled nor located:
/// settle_baseline(), locate_misfit().
Result<Selection> select_causes(const Frame& frame, const Limits& limits,
                                const std::function<void(double, std::string_view)>& progress,
                                const Selection* from = nullptr);

/// What is too small to matter becomes part of the baseline that the causes are measured against.
Result<void> settle_baseline(const Frame& frame, Selection& selection);

/// Withdraws one of the accepted causes and fits the others again.
Result<void> leave_out(const Frame& frame, Selection& selection, std::size_t cause,
                       std::string_view because);

/// Where the baseline and the final model miss the recordings, and whether more than noise is left.
void locate_misfit(const Frame& frame, const Limits& limits, Selection& selection);

}  // namespace flexspline::studies
