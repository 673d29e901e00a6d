#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/units.hpp"

namespace flexspline {

/// What a channel of a recording is. Names are those of the data-set format, version 1.
enum class Quantity {
  time,
  motor_angle,
  load_angle,
  torsion,
  angle,
  displacement,
  velocity,
  transmitted_torque,
  torque,
  force,
  motor_torque,
  commanded_torque,
  commanded_angle,
  current,
  duty_cycle,
  supply_voltage,
  drive_enabled,
  temperature,
  valid,
};

/// A quantity by the name that files use, and the dimensions its unit may have. velocity is angular
/// or linear, as the motion of its recording is.
struct QuantityInfo {
  Quantity quantity;
  std::string_view name;
  std::vector<Dimension> dimensions;
};

std::span<const QuantityInfo> quantities();
std::string_view name_of(Quantity quantity);
std::optional<Quantity> find_quantity(std::string_view name);

/// The bench a recording comes from: which shaft is held, what is measured.
enum class Rig { locked, free, specimen, servo };

std::string_view name_of(Rig rig);
std::optional<Rig> find_rig(std::string_view name);

enum class Split { unassigned, train, holdout };

/// One measured time series. SI units; a linear specimen has metres and newtons where others have
/// radians and newton metres. All channels are as long as time.
struct Recording {
  std::string id;
  std::string excitation;
  std::optional<double> amplitude;     ///< nominal, rad (m) at the output; what the file states
  std::optional<double> frequency_hz;  ///< nominal
  double start_s = 0.0;                ///< on the clock shared by the set
  Split split = Split::unassigned;
  std::vector<double> time;
  std::map<Quantity, std::vector<double>> channels;

  const std::vector<double>* find(Quantity quantity) const;
};

/// Units in which results are shown to a person.
struct DisplayUnits {
  std::string motion = "deg";
  std::string effort = "Nm";
};

/// All recordings of one bench, with what is known of it.
struct RecordingSet {
  std::string name;
  Rig rig = Rig::locked;
  std::string license;
  std::string source;
  std::string note;
  std::string sha256;  ///< of the description and every table, independent of the folder's name
  std::map<std::string, double> constants;  ///< by the key of the file, SI by its suffix
  DisplayUnits display;
  std::vector<Recording> recordings;
  std::vector<std::string> notes;  ///< what had to be decided in reading, for the person to know
};

/// What the torsion law sees of a recording: effort over motion.
/// locked: motion = theta_m / N. free: theta_m / N - theta_l. specimen: torsion, angle or
/// displacement; effort = transmitted torque, torque or force.
struct TorsionRecord {
  std::string id;
  Split split = Split::unassigned;
  std::optional<double> amplitude;
  std::optional<double> frequency_hz;
  std::vector<double> time;
  std::vector<double> motion;
  std::vector<double> effort;
  std::vector<bool> valid;  ///< false: carries the state along, has no residual
  bool travels = false;     ///< an angle that travels: f need be neither odd nor monotone
  bool linear = false;      ///< a displacement in metres under a force in newtons
};

}  // namespace flexspline
