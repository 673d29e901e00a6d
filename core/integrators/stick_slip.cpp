#include "flexspline/core/stick_slip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <cvodes/cvodes.h>
#include <fmt/format.h>

#include "integrators/dry_friction.hpp"

namespace flexspline {
namespace {

double sign_of(Contact contact) { return static_cast<double>(contact); }

Contact slip_along(double effort) {
  return effort > 0.0 ? Contact::slip_forward : Contact::slip_backward;
}

// The motion within one contact, (x, v), and the roots at which it ends.
class OneContact final : public CvodesProblem {
 public:
  explicit OneContact(const DryFrictionDrive& drive) : drive_(drive) {}

  Contact contact = Contact::stick;

  std::size_t rows() const override { return 2; }
  std::size_t roots() const override { return 2; }
  void rate(double t, const double* z, double* zdot) override {
    const bool sticks = contact == Contact::stick;
    zdot[0] = sticks ? 0.0 : z[1];
    zdot[1] = sticks ? 0.0
                     : (drive_.effort(t, z[0]) - drive_.viscous * z[1] -
                        sign_of(contact) * slip_level(drive_, z[1])) /
                           drive_.inertia;
  }
  void jacobian(double t, const double* z, Eigen::Map<Eigen::MatrixXd> out) override {
    if (contact == Contact::stick) return void(out.setZero());
    fill_jacobian(drive_, t, z[0], sign_of(contact) * slip_level_slope(drive_, z[1]), out);
  }
  // Both fall through zero where the contact ends.
  void root(double t, const double* z, double* values) override {
    if (contact == Contact::stick) {
      const double effort = drive_.effort(t, z[0]);
      values[0] = drive_.static_level - effort;
      values[1] = drive_.static_level + effort;
    } else {
      values[0] = sign_of(contact) * z[1];
      values[1] = 1.0;
    }
  }

 private:
  const DryFrictionDrive& drive_;
};

class Machine {
 public:
  Machine(const DryFrictionDrive& drive, double t0, double position, double speed,
          const StickSlipSettings& settings)
      : drive_(drive),
        settings_(settings),
        motion_(drive),
        run_(motion_, Stepping::bdf, t0, std::array{position, speed}, accuracy_of(settings)) {
    std::array falling{-1, -1};
    CVodeSetRootDirection(run_.memory(), falling.data());
    motion_.contact = speed == 0.0 ? contact_at_rest() : slip_along(speed);
  }

  void set_longest_step(double step) { run_.set_longest_step(step); }

  // Through every event up to t.
  Result<void> advance(double t) {
    while (run_.reached() < t) {
      const double from = run_.reached();
      run_.stop_at(t);
      const int flag = run_.advance(t);
      if (flag < 0 || !all_finite(run_.values())) return tl::unexpected(run_.error(flag));
      if (motion_.contact == Contact::stick) stuck_ += run_.reached() - from;
      if (flag == CV_ROOT_RETURN || runs_backward()) change();
      if (events_.size() > settings_.max_events) return too_many();
    }
    return {};
  }

  void append_to(StickSlipTrajectory& out) const {
    out.position.push_back(run_.values()[0]);
    out.speed.push_back(run_.values()[1]);
    out.contact.push_back(motion_.contact);
  }
  void finish(StickSlipTrajectory& out, double duration) {
    out.stick_share = duration > 0.0 ? stuck_ / duration : 0.0;
    out.events = std::move(events_);
    out.steps = run_.steps();
  }

 private:
  Contact contact_at_rest() const {
    const double effort = drive_.effort(run_.reached(), run_.values()[0]);
    return std::abs(effort) <= drive_.static_level ? Contact::stick : slip_along(effort);
  }

  // A slip that starts exactly in balance can turn at once, without a root after its start.
  bool runs_backward() const {
    return sign_of(motion_.contact) * run_.values()[1] < -settings_.speed_tolerance;
  }

  void change() {
    const double t = run_.reached();
    const double x = run_.values()[0];
    const Contact before = motion_.contact;
    motion_.contact =
        before == Contact::stick ? slip_along(drive_.effort(t, x)) : contact_at_rest();
    events_.push_back({t, x, before, motion_.contact});
    run_.restart(t, std::array{x, 0.0});
  }

  Result<void> too_many() const {
    return failure(ErrorCode::numerics,
                   fmt::format("stick and slip changed {} times up to t = {:.6g} s", events_.size(),
                               run_.reached()),
                   "allow more events, or look for a drive that chatters");
  }

  const DryFrictionDrive& drive_;
  const StickSlipSettings& settings_;
  OneContact motion_;
  CvodesRun run_;
  std::vector<ContactEvent> events_;
  double stuck_ = 0.0;
};

}  // namespace

Result<void> check(const DryFrictionDrive& drive, std::span<const double> times) {
  expects(!times.empty() && drive.effort != nullptr, "instants and a torque");
  if (!std::ranges::is_sorted(times, std::less_equal<>{})) {
    return failure(ErrorCode::bad_data, "the instants of a stick-slip simulation do not increase",
                   "sort them and drop repeated ones");
  }
  const auto wrong = [](const char* name, double value, const char* rule) {
    return failure(ErrorCode::bad_data,
                   fmt::format("{} = {:.6g} of a dry friction drive", name, value),
                   fmt::format("it has to be {}", rule));
  };
  if (!(drive.inertia > 0.0)) return wrong("inertia", drive.inertia, "positive");
  if (!(drive.viscous >= 0.0)) return wrong("viscous", drive.viscous, "0 or more");
  if (!(drive.sliding_level >= 0.0))
    return wrong("sliding_level", drive.sliding_level, "0 or more");
  if (!(drive.static_level >= drive.sliding_level)) {
    return wrong("static_level", drive.static_level, "the sliding level or more");
  }
  if (!(drive.stribeck_speed >= 0.0)) {
    return wrong("stribeck_speed", drive.stribeck_speed, "0 or more");
  }
  return {};
}

Result<StickSlipTrajectory> simulate_stick_slip(const DryFrictionDrive& drive,
                                                std::span<const double> times, double position,
                                                double speed, const StickSlipSettings& settings) {
  if (auto checked = check(drive, times); !checked) return tl::unexpected(checked.error());
  const double duration = times.back() - times.front();
  Machine machine(drive, times.front(), position, speed, settings);
  machine.set_longest_step(settings.longest_step > 0.0 ? settings.longest_step : 0.01 * duration);
  StickSlipTrajectory out;
  for (const double t : times) {
    if (auto moved = machine.advance(t); !moved) return tl::unexpected(moved.error());
    machine.append_to(out);
  }
  machine.finish(out, duration);
  return out;
}

}  // namespace flexspline
