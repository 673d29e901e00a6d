#include "diagnosis/search/step_incident.hpp"

#include <memory>
#include <utility>

#include "diagnosis/search/linearised.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kGrid = 16;  // to begin with: the gain falls off linearly beside the true row

/// Steps of one recording, added to the model one at a time.
class Steps {
 public:
  Steps(const Linearised& about, const Segment& segment, Equation at)
      : about_(about), segment_(segment), at_(at) {}

  /// Row and gain.
  std::pair<Index, double> best() const {
    const Index tenth = segment_.count / 10;
    std::pair<Index, double> best{};
    const auto take = [&](Index first) {
      if (first < tenth || first >= segment_.count - tenth) return;
      const double gain = gain_of(first);
      if (gain > best.second) best = {first, gain};
    };
    Index apart = std::max<Index>(1, segment_.count / kGrid);
    for (Index first = tenth; first < segment_.count; first += apart) take(first);
    while (apart > 1 && best.second > 0.0) {
      apart = (apart + 1) / 2;
      const Index about = best.first;
      take(about - apart);
      take(about + apart);
    }
    return best;
  }

 private:
  double gain_of(Index first) const {
    CauseForm form;
    form.at = {at_};
    const Index from = segment_.first + first;
    const Index rows = segment_.count - first;
    form.columns = [=](Equation, const Frame& f, const Reference&, std::span<const double>) {
      ArrayXd column = ArrayXd::Zero(f.rows());
      column.segment(from, rows).setOnes();
      return Columns{std::move(column)};
    };
    const CauseRow row{.id = "step", .coordinate = "window", .forms = {}};
    const auto fit = about_.with({&row, &form, {}}, 0);
    return fit ? fit->gain : 0.0;
  }

  const Linearised& about_;
  const Segment& segment_;
  Equation at_;
};

}  // namespace

std::optional<Step> step_taken(const Frame& frame, const Findings& findings, Equation equation,
                               const Limits& limits) {
  const std::size_t e = index_of(equation);
  const ArrayXd& weight = findings.weight[e];
  const ArrayXd beyond =
      ((findings.fit.residual[e] * weight).square() - (weight > 0.0).cast<double>()) /
      findings.noise[e].colour;
  CauseForm form;
  form.at = {equation};
  std::unique_ptr<const Linearised> about;
  Step best;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const Segment& s = frame.segments[i];
    if (beyond.segment(s.first, s.count).sum() < 2.0 * limits.gain) continue;
    if (about == nullptr) {
      about = std::make_unique<const Linearised>(
          frame, findings, linked_equations(frame, findings.fit.model.causes, form));
    }
    const auto [first, gain] = Steps(*about, s, equation).best();
    if (0.5 * gain > best.nats) best = {i, first, 0.5 * gain};
  }
  const bool is_all = best.nats > 0.0 && 2.0 * best.nats >= limits.alike() * beyond.sum();
  return is_all ? std::optional(best) : std::nullopt;
}

}  // namespace flexspline::studies
