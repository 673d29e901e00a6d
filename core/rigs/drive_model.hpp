#pragma once

#include <memory>
#include <span>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/law_scalar.hpp"

namespace flexspline {

/// An effect of a drive: where its parameters and its memory lie.
struct EffectUse {
  const EffectRow* row = nullptr;
  Site site = Site::transmission;
  bool across = false;  ///< the torsion is its motor
  std::size_t parameter = 0;
  std::size_t parameters = 0;
  std::size_t state = 0;
  std::size_t states = 0;
  bool follows_torsion = false;
  bool follows_torque = false;
  bool follows_motor = false;  ///< its term, the angle of the motor
  bool follows_load = false;
};

/// given: an input, or nothing. loop: a controller, after the equations are solved. recorded: the
/// specimen's own, as its sensor shows it, known with its rate.
enum class TorqueFrom { given, loop, recorded };

/// The laws and effects of a drive, made once, for use at any scalar by DriveAt.
class DriveModel {
 public:
  /// Errors: a law or effect that cannot be made, or that a forward simulation cannot carry.
  /// signals: the instruments' effects that the rig takes into its equations. torque: who makes the
  /// motor's torque or the specimen's.
  static Result<DriveModel> make(const DriveSpec& drive, std::vector<DriveConstant> constants,
                                 std::vector<Site> signals, TorqueFrom torque = TorqueFrom::given);

  const DriveSpec& drive() const { return drive_; }
  std::span<const DriveConstant> constants() const { return constants_; }
  std::span<const EffectUse> effects() const { return effects_; }
  std::size_t parameters() const { return parameters_; }
  std::size_t memory() const { return memory_; }
  std::size_t first_constant() const { return first_constant_; }
  bool has(Site site) const;
  /// Kinematics follow the torque that they help to make.
  bool kinematics_follow_torque() const { return follows_torque_; }
  /// An effect on the torque's sensor has a memory.
  bool sensor_remembers() const { return sensor_remembers_; }
  /// They do so at once, so that the torsion of the law is a state of the rig.
  bool torsion_is_state() const { return torsion_is_state_; }
  /// Errors: kinematics that grow with the torque at some motor angle.
  Result<void> check_yielding() const;

  /// The law f (0), g^-1 (1) or h (2) with the coefficients that p has for it.
  template <class S>
  const Law& law(std::size_t which, std::span<const S> coefficients) const {
    bool same = true;
    const auto& made = laws_[which]->spec().coefficients;
    for (std::size_t k = 0; k < made.size(); ++k) same &= made[k] == real_part(coefficients[k]);
    if (!same) {
      std::vector<double> values;
      for (const S& c : coefficients) values.push_back(real_part(c));
      remake(which, std::move(values));
    }
    return *laws_[which];
  }

  /// Where the coefficients of that law start and how many there are.
  std::span<const std::size_t, 4> law_starts() const { return law_starts_; }

 private:
  void remake(std::size_t which, std::vector<double> coefficients) const;

  DriveSpec drive_;
  std::vector<DriveConstant> constants_;
  std::vector<EffectUse> effects_;
  std::array<std::size_t, 4> law_starts_{};
  std::size_t first_constant_ = 0;
  std::size_t parameters_ = 0;
  std::size_t memory_ = 0;
  bool follows_torque_ = false;
  bool torsion_is_state_ = false;
  bool sensor_remembers_ = false;
  mutable std::array<std::unique_ptr<Law>, 3> laws_;
};

}  // namespace flexspline
