#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/reports/figure.hpp"
#include "flexspline/reports/table.hpp"

namespace flexspline::reports {

/// What an artefact holds as null.
inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

/// Units of what is shown, as the artefact names them, and the quantities that they belong to.
struct ShownUnits {
  std::string motion = "deg";
  std::string rate = "deg/s";
  std::string effort = "Nm";
  std::string angle = "torsion";  ///< what an angular motion is: the torsion, or a joint's angle

  bool is_linear() const { return effort.ends_with('N'); }
  std::string motion_name() const { return is_linear() ? "displacement" : angle; }
  std::string rate_name() const { return is_linear() ? "velocity" : angle + " rate"; }
  std::string effort_name() const { return is_linear() ? "force" : "torque"; }

  /// Labels of axes: "torsion / deg".
  std::string motion_label() const { return motion_name() + " / " + motion; }
  std::string rate_label() const { return rate_name() + " / " + rate; }
  std::string effort_label() const { return effort_name() + " / " + effort; }
};

struct Curve {
  std::vector<double> argument;
  std::vector<double> value;
};

/// What looks mistaken in recordings, before any science.
struct ShownFinding {
  std::string severity;  ///< error or warning
  std::string says;      ///< with the number that shows it, and the remedy
};

/// A recording as flexspline-input/1 holds it.
struct InputRecording {
  std::string id;
  std::string role;
  double amplitude = kAbsent;  ///< in units.motion
  double frequency_hz = kAbsent;
  double peak_effort = kAbsent;
  double half_height = kAbsent;
  double loop_area = kAbsent;
  std::vector<double> time, motion, effort;
};

/// flexspline-input/1.
struct Input {
  std::string id, title, kind, says, source, license;
  std::string truth_id;  ///< of the virtual bench
  ShownUnits units;
  std::vector<InputRecording> recordings;
  std::map<std::string, Curve> truth;                 ///< by function: f, g_inverse, h
  std::optional<std::vector<ShownFinding>> findings;  ///< of a data set that was looked at
};

/// A recording as flexspline-case/1 holds it: measured against simulated.
struct CaseRecording {
  std::string id;
  bool trained = false;
  double amplitude = kAbsent;
  double frequency_hz = kAbsent;
  double rmse = kAbsent;
  double rmse_percent = kAbsent;       ///< of that recording's peak
  double rmse_true_percent = kAbsent;  ///< against the noise-free torque; bench only
  double area_error_percent = kAbsent;
  bool outside_domain = false;
  std::vector<double> motion, measured, simulated;

  /// Against the noise-free torque where that is known, else against what was measured.
  double error_percent() const;
};

struct Band {
  std::string function, unit_argument, unit_value;
  std::vector<double> argument, value, lower, upper;
  double valid_from = kAbsent;
  double valid_to = kAbsent;
};

struct Parameter {
  std::string name, unit;
  double value = kAbsent;
  double std = kAbsent;
  double lower = kAbsent;
  double upper = kAbsent;
  bool bound_active = false;
};

struct AbsorbedShare {
  std::string parameter, by;
  double cosine = kAbsent;
};

/// flexspline-case/1 with the part of its estimate that is shown.
struct Case {
  std::string key, input, estimator, title, method;
  std::vector<std::string> train;
  long replicate = 0;
  bool failed = false;
  std::string failure, remedy;
  std::string termination;
  double cost = kAbsent;
  double evaluations = kAbsent;
  double condition = kAbsent;
  std::string verdict, says;
  double seconds = kAbsent;
  std::vector<AbsorbedShare> absorbed;
  std::vector<Parameter> parameters;
  std::vector<std::string> notes;
  std::vector<Band> bands;
  std::vector<CaseRecording> recordings;
  std::map<std::string, double> function_errors_percent;

  const Band* band(const std::string& function) const;
  const CaseRecording* recording(const std::string& id) const;
  std::vector<const CaseRecording*> trained() const;
};

struct Fact {
  std::string id, says, unit, published;
  double value = kAbsent;
  int digits = 0;
};

struct TableOneRow {
  std::string name, unit;
  double published = kAbsent;
  double recovered = kAbsent;
  double std = kAbsent;
};

struct TableTwoRow {
  std::string name, value, ours, unit, says;
};

/// What is printed and cannot be meant.
struct Slip {
  std::string where, printed, meant;
};

struct PaperSeries {
  std::string name;
  std::string side;  ///< paper | ours
  bool points = false;
  std::vector<double> x, y;
};

struct PaperFigure {
  std::string id, title, x_label, y_label, says, wrong;
  std::vector<PaperSeries> series;
};

/// flexspline-paper/1.
struct Paper {
  std::vector<Fact> facts;
  std::vector<TableOneRow> table_1;
  std::vector<TableTwoRow> table_2;
  std::vector<Slip> slips;
  std::vector<PaperFigure> figures;
};

/// flexspline-kind/1: what a study of a kind says.
struct Kind {
  std::string kind, question, says;
  std::vector<std::string> notes;
  std::vector<Figure> figures;
  std::vector<Table> tables;
  double cases = kAbsent, done = kAbsent, failed = kAbsent;
};

/// Everything that lies in a study's folder.
struct Artefacts {
  std::string lock;  ///< study.lock.toml as it stands
  std::vector<Input> inputs;
  std::vector<Case> cases;
  std::optional<Paper> paper;
  std::optional<Kind> kind;
  std::vector<std::string> unreadable;  ///< "cases/a.json: reason" of every one that is left out
};

/// Reads what a folder holds, files in alphabetical order. A file that cannot be read is named in
/// `unreadable`. Errors: input_missing where the folder does not exist or holds no artefact.
Result<Artefacts> read_artefacts(const std::filesystem::path& folder);

}  // namespace flexspline::reports
