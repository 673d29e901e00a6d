#pragma once

#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/instant.hpp"
#include "flexspline/core/model_spec.hpp"
#include "flexspline/core/parameter_search.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/core/scalar.hpp"

namespace flexspline {

/// A motion along which a torque is simulated: phi, phi', phi'' sampled at the same instants. SI.
struct Motion {
  std::vector<double> time;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> acceleration;
};

/// Where an effect enters the drive of Dhaouadi and Ghorbel (2003), eqs. (5)-(8), and its sign.
enum class Site {
  motor,                ///< + in (5), Nm at the motor shaft: opposes the motor torque
  load,                 ///< + in (6), Nm at the output: opposes the transmitted torque
  transmission,         ///< + in (7), Nm: part of the transmitted torque
  kinematics,           ///< + in (8), rad at the output: part of the torsion
  torque_signal,        ///< measured minus true transmitted torque, Nm
  motor_torque_signal,  ///< recorded minus true motor torque, Nm
  motor_angle_signal,   ///< measured minus true motor angle, rad
  load_angle_signal,    ///< measured minus true load angle, rad
};

std::string_view name_of(Site site);
inline bool on_instrument(Site site) { return site >= Site::torque_signal; }

struct EffectParameter {
  std::string_view name;
  std::string_view unit;
  double lower;
  double upper;
  double nominal;  ///< for a unit of 226 Nm and ratio 50
  std::string_view source;
  ParameterSearch search{};
};

/// The functions of an effect for one scalar. states: the effect's own memory, empty for a static
/// one.
template <class S>
struct EffectFunctions {
  /// What it adds at its site at an instant.
  S (*term)(const Instant<S>&, std::span<const S> parameters, std::span<const S> states) = nullptr;
  /// Moves the states from one sample to the next along the path between them.
  void (*advance)(const Instant<S>& from, const Instant<S>& to, std::span<const S> parameters,
                  std::span<S> states) = nullptr;
  /// Time derivative of the states, for integration together with the rig.
  void (*rate)(const Instant<S>&, std::span<const S> parameters, std::span<const S> states,
               std::span<S> rates) = nullptr;
};

/// A row of the catalogue of effects: one physical or instrumental term beyond eq. (4).
struct EffectRow {
  std::string_view id;
  std::string_view coordinate;  ///< the variable in which it is organised
  Site site = Site::transmission;
  std::string_view equation;
  std::string_view range;  ///< where the equation holds
  std::string_view not_modelled;
  std::string_view source;
  std::vector<EffectParameter> parameters;
  std::vector<Rig> rigs;  ///< where it exists
  /// Where a diagnosis seeks it by its law, if its parameters say how. Empty: wherever it exists.
  std::vector<Rig> sought_on = {};
  bool repeats = false;    ///< the parameters and states come in groups (elements)
  std::size_t states = 0;  ///< of one element
  bool passive = true;     ///< makes no energy over a closed cycle
  /// Where not passive: why it may make energy, or with what beside it it does not.
  std::string_view active_because = {};
  bool rate_independent = false;
  EffectFunctions<double> real{};
  EffectFunctions<Dual> dual{};
  EffectFunctions<Complex> complex{};
  EffectFunctions<Traced> traced{};  ///< term and rate, from which code is written
  /// For effects of a whole signal (delay, lag, quantisation) instead of a term: maps what the
  /// site's channel shows, in place.
  void (*map)(std::span<const double> time, std::span<double> signal,
              std::span<const double> parameters) = nullptr;
};

/// Fills a row's functions from a law: a struct with static templates term<S> and, with memory,
/// advance<S> and rate<S>.
template <class Law, class S>
EffectFunctions<S> functions_of() {
  EffectFunctions<S> functions;
  functions.term = &Law::template term<S>;
  if constexpr (!std::is_same_v<S, Traced> && requires { &Law::template advance<S>; })
    functions.advance = &Law::template advance<S>;
  if constexpr (requires { &Law::template rate<S>; }) functions.rate = &Law::template rate<S>;
  return functions;
}

template <class Law>
void instantiate(EffectRow& row) {
  row.real = functions_of<Law, double>();
  row.dual = functions_of<Law, Dual>();
  row.complex = functions_of<Law, Complex>();
  row.traced = functions_of<Law, Traced>();
}

/// Whether every parameter says how it is found, and one of them is linear.
bool sought_by_law(const EffectRow& row);

/// Every effect, one file each in core/effects.
std::span<const EffectRow> effects();

/// Errors: an effect that does not exist.
Result<const EffectRow*> find_effect(std::string_view id);

/// The values of a specification in the order of the row, elements one after another.
/// Errors: a number of parameters that does not fit the row.
Result<std::vector<double>> parameter_values(const EffectRow& row, const EffectSpec& spec);

/// Number of states for that many parameters.
std::size_t state_count(const EffectRow& row, std::size_t parameters);

}  // namespace flexspline
