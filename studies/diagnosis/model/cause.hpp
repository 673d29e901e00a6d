#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/frame/frame.hpp"
#include "diagnosis/model/counterpart.hpp"

namespace flexspline::studies {

/// A parameter of a cause that enters non-linearly, with its range on these recordings.
struct Shape {
  std::string_view name;
  std::string_view unit;  ///< SI
  double lower = 0.0;
  double upper = 1.0;
  int grid = 5;  ///< starts tried, even in the logarithm where that is how it is searched
  bool logarithmic = true;
  bool discrete = false;  ///< lower, lower + 1, ... upper; tried, not refined
  std::string_view meaning = {};
};

/// What the coefficient of a column is, for a person.
struct Term {
  std::string name;
  std::string unit;  ///< SI
  std::string meaning;
  /// Of one element among several: where on its fixed grid it stands, which was not fitted.
  std::string grid_name{};
  double grid_value = 0.0;
  std::string grid_unit{};
  std::string grid_meaning{};
};

/// What the last fit knows of the baseline's laws along the rows. Nm at the equation's shaft.
struct Reference {
  Eigen::ArrayXd elastic;      ///< f(phi)
  Eigen::ArrayXd dissipative;  ///< g^-1(phi'/h)
  Eigen::ArrayXd friction;     ///< the same and what causes of the model add to it
  Eigen::ArrayXd motor_sign;   ///< the motor's dry friction over its largest value
  Eigen::ArrayXd asked_rate;   ///< rate of the torque that the laws ask of the motor, Nm/s
  double torque_offset = 0.0;  ///< what causes of the model add to all readings of the torque
  std::vector<SignPart> torsion_sign;  ///< the same across the gear, of phi' (rad/s, m/s)
};

using Columns = std::vector<Eigen::ArrayXd>;

/// One way in which a cause may act. Its contribution is sum_k a_k column_k, the a_k common to all
/// equations it acts on, each an addition to what the equation predicts; or a change of the frame
/// (its angles, its torque) by the shapes alone.
struct CauseForm {
  std::string equation;  ///< in words
  std::vector<Rig> rigs;
  std::vector<Equation> at;
  std::function<std::vector<Shape>(const Frame&)> shapes{};
  std::function<std::vector<Term>(const Frame&)> terms{};  ///< one a column
  std::function<Columns(Equation, const Frame&, const Reference&, std::span<const double>)>
      columns{};
  void (*transform)(Frame&, std::span<const double>) = nullptr;
  /// Start of the shapes of a transform, from the recordings; without it the grid is searched.
  std::vector<double> (*start)(const Frame&) = nullptr;
  bool nonnegative = false;         ///< a_k >= 0
  bool friction = false;            ///< resists the motion across the transmission, beside g^-1
  bool rescales = false;            ///< a channel, by 1 + a or 1 - a, and does nothing else
  bool offsets_torque = false;      ///< adds its coefficient to all readings of the torque
  bool unbounded = false;           ///< may be most of a torque: nothing that is stated bounds it
  double Frame::*stated = nullptr;  ///< the rig's constant to which the coefficient adds
  bool trails =
      false;  ///< adds a share of what all others ask of the motor, and is no part of that
  bool extends = false;  ///< the form before it in the row, by its last shape
  /// What the recordings must be like; without it anything.
  std::function<bool(const Frame&)> where{};
  /// Whether it ripples this many times a turn of the motor in steady strokes.
  bool (*ripples)(double order) = nullptr;
  /// What it is in a model file, by the catalogue of effects.
  std::function<Counterpart(const FittedCause&)> counterpart{};
  std::string_view no_counterpart = {};  ///< why there is none
};

struct DriveModel;

/// What the baseline has where recordings ask for it, and what is never a name.
struct BaselinePart {
  double most = std::numeric_limits<double>::infinity();  ///< larger coefficients are no such part
  /// Of the cause at that place in the model of a frame.
  std::string (*says)(const Frame&, const DriveModel&, std::size_t cause) = nullptr;
};

/// A row of the catalogue of causes: an id of flexspline-diagnosis/1 and the ways it may act.
struct CauseRow {
  std::string_view id;
  std::string_view coordinate;
  std::vector<CauseForm> forms;
  std::optional<BaselinePart> part = {};  ///< without: a cause
  std::string_view outside = {};          ///< the catalogue: what it is in words, never a name

  bool of_baseline() const { return part.has_value(); }
  bool in_catalogue() const { return outside.empty(); }
};

/// Every cause, by id: those that have a file of their own, and every other effect of the
/// catalogue that is sought by its law.
std::span<const CauseRow> causes();

/// Causes that are no effect's own law, or more than it, one file each in studies/diagnosis/causes.
std::span<const CauseRow> written_causes();

/// What the baseline has where recordings ask for it, one file each in studies/diagnosis/parts.
std::span<const CauseRow> baseline_parts();

/// What is in no catalogue of effects and would be taken for what is: it stands in the model
/// without a name. One file each in studies/diagnosis/outside.
std::span<const CauseRow> outside_causes();

/// The first equation of the frame that a form acts on.
Equation first_equation(const Frame& frame, const CauseForm& form);

/// The forms of a row that the frame's rig and equations allow.
std::vector<const CauseForm*> forms_on(const CauseRow& row, const Frame& frame);

}  // namespace flexspline::studies
