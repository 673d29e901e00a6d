#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/instant.hpp"
#include "flexspline/core/ode_system.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/core/rig_residuals.hpp"

namespace flexspline {

/// An input as a function of time, with its time derivative.
struct Signal {
  std::function<double(double)> value;
  std::function<double(double)> rate;  ///< may be empty: central difference over 2e-5 s
};

/// The cubic through samples that rises and falls where they do (MonotoneInput), held constant
/// beyond them; fewer than four samples: a cubic spline. One thread a signal: it remembers where it
/// looked last.
Signal sampled_signal(std::span<const double> time, std::span<const double> samples);

/// What drives a rig. Motor torque is what was recorded or commanded; effects at
/// motor_torque_signal make the true torque differ from it. On a force-driven specimen the effort
/// is what was recorded, and effects at torque_signal make the true effort differ from it.
struct RigInputs {
  std::map<Quantity, Signal> channels;
  std::optional<Signal> load_torque;  ///< tau_L beyond the pendulum's, Nm at the output
  /// Of a servo's own position loop: duty cycle a radian of commanded less true angle.
  std::optional<Signal> position_gain{};
};

struct RigVariable {
  std::string_view name;
  std::string_view unit;
  std::string_view says;
};

/// A rig's forward simulation. States: the rig's own, then the memory of the effects in their
/// order. Parameters: those of the drive, in the order of parameter_list. One thread a system, as
/// it keeps the laws made for the parameters last used.
class RigSystem : public OdeSystem {
 public:
  virtual const DriveSpec& drive() const = 0;
  /// The rig's own states.
  virtual std::span<const RigVariable> variables() const = 0;
  virtual std::vector<DriveParameter> parameter_list() const = 0;
  /// All that happens at an instant in these states: angles, speeds, accelerations, torques.
  virtual Instant<double> instant(double t, std::span<const double> y,
                                  std::span<const double> p) const = 0;
  virtual Instant<Dual> instant(double t, std::span<const Dual> y,
                                std::span<const Dual> p) const = 0;

  /// The parameters of the drive it was made with.
  std::vector<double> parameter_vector() const;
  /// Every state zero: at rest, unloaded, memory empty.
  std::vector<double> rest() const;
};

/// A way in which a rig is simulated.
struct RigForm {
  std::string_view id;
  std::string_view says;
  std::vector<RigVariable> states;
  std::vector<Quantity> inputs;
};

/// A row of the catalogue of rigs.
struct RigRow {
  std::string_view id;
  Rig rig = Rig::locked;
  std::string_view says;
  std::string_view equations;  ///< with the numbers of Dhaouadi and Ghorbel (2003)
  std::string_view not_modelled;
  std::vector<RigForm> forms;            ///< the first is the usual one
  std::vector<DriveConstant> constants;  ///< what it uses of a DriveSpec besides the gear ratio
  std::vector<Quantity> outputs;
  std::vector<std::string_view> residuals;  ///< of motor, load, torsion, drive
  /// Errors: a law or effect that cannot be made or has no place in a forward simulation, an input
  /// that is missing, a constant out of its range, a form that does not exist.
  Result<std::unique_ptr<RigSystem>> (*make)(const DriveSpec&, const RigInputs&,
                                             std::string_view form) = nullptr;
};

/// Every rig, one file each in core/rigs.
std::span<const RigRow> rigs();

const RigRow& rig_row(Rig rig);

/// The rig's system in a form; empty for the usual one.
Result<std::unique_ptr<RigSystem>> make_rig(Rig rig, const DriveSpec& drive,
                                            const RigInputs& inputs, std::string_view form = {});

/// The instants of a trajectory, with transmitted_torque_rate by central differences.
std::vector<Instant<double>> instants_along(const RigSystem& system, std::span<const double> p,
                                            std::span<const double> times,
                                            std::span<const double> states);

/// A trajectory as the bench records it: the rig's output channels, effects on instruments entered.
/// Errors: an effect whose parameters do not fit.
Result<Recording> record_of(const RigRow& row, const RigSystem& system, std::span<const double> p,
                            std::span<const double> times, std::span<const double> states);

}  // namespace flexspline
