#pragma once

#include <string>
#include <vector>

#include "flexspline/reports/artefacts.hpp"

namespace flexspline::reports {

/// An estimator of the study, in the order in which it is shown.
struct EstimatorView {
  std::string id;
  std::string method;
  std::size_t loops = 0;  ///< recordings it was trained on, on its first input
  int rank = 0;

  bool is_midpoint() const { return method.starts_with("midpoint"); }
  bool is_trajectory() const { return method.starts_with("trajectory"); }
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

/// Which held-out recordings, relative to the operating point.
enum class Elsewhere { other_amplitude, other_frequency, beyond_domain, anywhere };

/// Questions that several sections ask of the artefacts.
class StudyView {
 public:
  explicit StudyView(Artefacts artefacts);

  const Artefacts& artefacts() const { return artefacts_; }
  const std::vector<EstimatorView>& estimators() const { return estimators_; }

  /// The paper's method on the fewest loops; the trajectory method on the most. Null where absent.
  const EstimatorView* paper_fit() const;
  const EstimatorView* full_trajectory() const;

  /// The case of the lowest replicate; null where the estimator did not run on the input.
  const Case* find(const Input& input, const EstimatorView& estimator) const;

  OperatingPoint operating_point(const Input& input) const;

  /// Recordings of the input that no estimator of the study was trained on.
  std::vector<std::string> unseen(const Input& input) const;

  /// Largest error on recordings held out from every estimator (from this one, where no such
  /// recording exists) and, but for beyond_domain, within every estimator's domain of validity.
  Worst worst(const Input& input, const EstimatorView& estimator, Elsewhere elsewhere) const;

  /// True where every input's recordings differ in (amplitude, frequency) and have both.
  bool on_grid() const { return on_grid_; }

 private:
  bool selected(const Input& input, const CaseRecording& recording, Elsewhere elsewhere) const;

  Artefacts artefacts_;
  std::vector<EstimatorView> estimators_;
  bool on_grid_ = false;
};

/// "0.2 deg, 0.005 Hz", or the recording's id where it has no such numbers.
std::string place_of(const Input& input, const CaseRecording& recording);

/// The same number but for rounding.
bool same(double a, double b);

}  // namespace flexspline::reports
