#include "yielding_torque.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/effect_dependence.hpp"
#include "flexspline/core/law_scalar.hpp"
#include "rigs/implicit_root.hpp"

namespace flexspline {
namespace {

struct Use {
  const EffectRow* row;
  std::vector<Complex> parameters;
  std::vector<Complex> states;
};

Instant<Complex> to_complex(const Instant<double>& x) {
  Instant<Complex> z;
  z.time = x.time;
  z.motor_angle = z.load_angle = z.torsion = x.torsion;
  z.motor_speed = z.load_speed = z.torsion_rate = x.torsion_rate;
  z.motor_acceleration = z.load_acceleration = z.torsion_acceleration = x.torsion_acceleration;
  return z;
}

// Weights of the derivative at the last of these times of the polynomial through all of them.
std::vector<double> slope_weights(std::span<const double> times) {
  const std::size_t n = times.size();
  const double end = times[n - 1];
  std::vector<double> weights(n, 0.0);
  for (std::size_t j = 0; j + 1 < n; ++j) {
    double product = 1.0 / (times[j] - end);
    for (std::size_t m = 0; m + 1 < n; ++m) {
      if (m != j) product *= (end - times[m]) / (times[j] - times[m]);
    }
    weights[j] = product;
    weights[n - 1] += 1.0 / (end - times[j]);
  }
  return weights;
}

class YieldingRun {
 public:
  YieldingRun(const TorsionLaws& laws, std::vector<Use> kinematics, std::vector<Use> forces)
      : laws_(laws), kinematics_(std::move(kinematics)), forces_(std::move(forces)) {}

  Result<double> next(const Instant<double>& x) {
    begin(to_complex(x));
    const double scale = 1e-3 * std::abs(laws_.f.value(laws_.f.spec().scale)) + 1e-12;
    double slope = 0.0;
    const double step = real_root(
        [&](const Complex& d) { return d - (at(last_ + d).torque - last_); }, scale, slope);
    if (!std::isfinite(step) || !(slope > 0.0)) return no_root(x.time, slope);
    settle(at(last_ + step));
    return last_;
  }

 private:
  struct Trial {
    std::vector<Use> kinematics;
    std::vector<Use> forces;
    Instant<Complex> rigid;
    Instant<Complex> x;  ///< with what the kinematics add, and the torque of the law
    Complex added;
    Complex torque;
  };

  void begin(const Instant<Complex>& x) {
    rigid_ = x;
    times_.push_back(x.time.real());
    if (times_.size() > kHistory) times_.erase(times_.begin());
    weights_ = slope_weights(times_);
    if (added_.size() >= kHistory) added_.erase(added_.begin());
  }

  Complex rate(Complex before, Complex after) const {
    if (times_.size() < 2) return {};
    return (after - before) / (times_.back() - times_[times_.size() - 2]);
  }

  Complex sum(std::vector<Use>& uses, const Instant<Complex>& from,
              const Instant<Complex>& to) const {
    Complex total;
    for (Use& use : uses) {
      const auto& functions = use.row->complex;
      if (times_.size() > 1 && functions.advance != nullptr) {
        functions.advance(from, to, use.parameters, use.states);
      }
      total += functions.term(to, use.parameters, use.states);
    }
    return total;
  }

  Trial at(const Complex& torque) const {
    Trial trial{kinematics_, forces_, rigid_, {}, {}, {}};
    trial.rigid.transmitted_torque = torque;
    trial.rigid.transmitted_torque_rate = rate(last_, torque);
    trial.added = sum(trial.kinematics, last_rigid_, trial.rigid);
    Instant<Complex>& x = trial.x = rigid_;
    x.torsion += trial.added;
    x.torsion_rate += weights_.back() * trial.added;
    for (std::size_t k = 0; k < added_.size(); ++k) x.torsion_rate += weights_[k] * added_[k];
    const Complex law = law_torque(x);
    x.transmitted_torque = law;
    x.transmitted_torque_rate = rate(last_x_.transmitted_torque, law);
    trial.torque = law + sum(trial.forces, last_x_, x);
    return trial;
  }

  Complex law_torque(const Instant<Complex>& x) const {
    const Complex h = evaluate(laws_.h, x.torsion, {});
    return evaluate(laws_.f, x.torsion, {}) + evaluate(laws_.g_inverse, x.torsion_rate / h, {});
  }

  void settle(Trial trial) {
    kinematics_ = std::move(trial.kinematics);
    forces_ = std::move(trial.forces);
    last_ = trial.torque.real();
    last_rigid_ = trial.rigid;
    last_x_ = trial.x;
    added_.push_back(trial.added.real());
  }

  static tl::unexpected<Error> no_root(double time, double slope) {
    const std::string why =
        std::isfinite(slope) && slope <= 0.0
            ? fmt::format("there the torque would grow by {:.3g} of itself under its own yielding",
                          1.0 - slope)
            : std::string("no bracket around the last torque holds one");
    return failure(ErrorCode::numerics,
                   fmt::format("at t = {:.6g} s no torque goes with the motion and with "
                               "kinematics that follow the torque: {}",
                               time, why),
                   "give the kinematics less negative compliance, or sample the motion coarser");
  }

  static constexpr std::size_t kHistory = 5;
  const TorsionLaws& laws_;
  std::vector<Use> kinematics_;
  std::vector<Use> forces_;
  Instant<Complex> rigid_;
  Instant<Complex> last_rigid_;
  Instant<Complex> last_x_;
  std::vector<double> times_;    ///< up to this instant
  std::vector<double> weights_;  ///< of what the kinematics add at them
  std::vector<double> added_;    ///< up to the instant before
  double last_ = 0.0;
};

Result<std::vector<Use>> uses_of(const ModelSpec& model, bool at_kinematics) {
  std::vector<Use> uses;
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if (on_instrument((*row)->site) || ((*row)->site == Site::kinematics) != at_kinematics) {
      continue;
    }
    const auto values = parameter_values(**row, spec);
    if (!values) return tl::unexpected(values.error());
    uses.push_back({*row,
                    {values->begin(), values->end()},
                    std::vector<Complex>(state_count(**row, values->size()))});
  }
  return uses;
}

}  // namespace

Result<bool> kinematics_follow_torque(const ModelSpec& model) {
  const auto uses = uses_of(model, true);
  if (!uses) return tl::unexpected(uses.error());
  return std::ranges::any_of(*uses, [](const Use& use) {
    std::vector<double> values;
    for (const Complex& p : use.parameters) values.push_back(p.real());
    // A memory may need a threshold of torque to move, which no step finds.
    return !use.states.empty() ||
           depends_on(*use.row, values, &Instant<Complex>::transmitted_torque);
  });
}

Result<std::vector<double>> torque_of_yielding(const TorsionLaws& laws, const ModelSpec& model,
                                               std::span<const Instant<double>> path) {
  auto kinematics = uses_of(model, true);
  auto forces = uses_of(model, false);
  if (!kinematics) return tl::unexpected(kinematics.error());
  if (!forces) return tl::unexpected(forces.error());
  YieldingRun run(laws, std::move(*kinematics), std::move(*forces));
  std::vector<double> torque;
  for (const Instant<double>& x : path) {
    const auto next = run.next(x);
    if (!next) return tl::unexpected(next.error());
    torque.push_back(*next);
  }
  return torque;
}

}  // namespace flexspline
