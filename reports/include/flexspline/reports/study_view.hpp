#pragma once

#include <set>
#include <string>
#include <vector>

#include "flexspline/reports/artefacts.hpp"

namespace flexspline::reports {

/// An estimator of the study, in the order in which it is shown.
struct EstimatorView {
  std::string id;
  std::string title;
  std::string method;
  std::size_t loops = 0;  ///< recordings it was trained on, on its first input
  std::size_t cases = 0;  ///< how often it ran
  int rank = 0;

  bool is_midpoint() const { return method.starts_with("midpoint"); }
  bool is_trajectory() const { return method.starts_with("trajectory"); }
  bool is_static_regression() const { return method == "static_regression"; }
};

/// Amplitude and frequency of the loop that everybody was trained on.
struct OperatingPoint {
  std::string recording;
  double amplitude = kAbsent;
  double frequency_hz = kAbsent;
};

/// The largest of some errors, and where it occurred.
struct Worst {
  double percent = kAbsent;
  std::string where;
};

/// Which held-out recordings, relative to the operating point: smaller or slower, with the other
/// quantity as it is there; larger or faster than anything there; or any.
enum class Elsewhere { lower_amplitude, lower_frequency, beyond, anywhere };

/// Questions that several sections ask of the artefacts.
class StudyView {
 public:
  explicit StudyView(Artefacts artefacts);

  const Artefacts& artefacts() const { return artefacts_; }
  const std::vector<EstimatorView>& estimators() const { return estimators_; }

  /// The paper's method on the fewest loops, the first of those; the trajectory method that ran on the most inputs and,
  /// among those, on the most loops. Null where absent.
  const EstimatorView* paper_fit() const;
  const EstimatorView* full_trajectory() const;
  /// Those of the two that exist: the ones that tables set side by side.
  std::vector<const EstimatorView*> principal() const;

  /// The case of the lowest replicate; null where the estimator did not run on the input.
  const Case* find(const Input& input, const EstimatorView& estimator) const;

  OperatingPoint operating_point(const Input& input) const;

  /// Recordings to judge a case by: those that no estimator was trained on; where there are none,
  /// those that this one was not.
  std::vector<const CaseRecording*> held_out(const Input& input, const Case& item) const;

  /// One recording for each amplitude and frequency in ascending order, the held-out one where a
  /// loop was recorded twice; off the grid every recording in its own order.
  std::vector<const InputRecording*> places(const Input& input) const;

  /// Of a case, the recording at that place: held out if there is one.
  const CaseRecording* at_place(const Case& item, const InputRecording& place) const;

  /// Largest error on held-out recordings, and where.
  Worst worst(const Input& input, const EstimatorView& estimator, Elsewhere elsewhere) const;

  /// True where every recording has an amplitude and a frequency and no two of one role share them.
  bool on_grid() const { return on_grid_; }

 private:
  std::set<std::string> trained_on(const Input& input) const;

  Artefacts artefacts_;
  std::vector<EstimatorView> estimators_;
  bool on_grid_ = false;
};

/// Whether a recording lies there, seen from the operating point.
bool lies(const CaseRecording& recording, const OperatingPoint& point, Elsewhere elsewhere);

/// "0.2 deg, 0.005 Hz", or the recording's id where it has no such numbers.
std::string place_of(const Input& input, const CaseRecording& recording);

/// The same number but for rounding.
bool same(double a, double b);

}  // namespace flexspline::reports
