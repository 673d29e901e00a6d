#include "diagnosis/step_incident.hpp"

#include "diagnosis/linearised.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kLeastMisfit = 36.0;  // chi square: the least that an incident has to gain
constexpr Index kGrid = 16;

/// Steps of one recording, added to the model one at a time.
class Steps {
 public:
  Steps(const Linearised& about, const Segment& segment, Equation at)
      : about_(about), segment_(segment), at_(at) {}

  Step best() const {
    const Index tenth = segment_.count / 10;
    Step best;
    const auto take = [&](Index first) {
      if (first < tenth || first >= segment_.count - tenth) return;
      const double gain = gain_of(first);
      if (gain > best.gain) best = {first, gain};
    };
    Index apart = std::max<Index>(1, segment_.count / kGrid);
    for (Index first = tenth; first < segment_.count; first += apart) take(first);
    while (apart > 1 && best.gain > 0.0) {
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

std::vector<Step> best_steps(const Frame& frame, const Findings& findings, Equation equation) {
  const std::size_t e = index_of(equation);
  const ArrayXd& weight = findings.weight[e];
  const ArrayXd beyond =
      (findings.fit.residual[e] * weight).square() - (weight > 0.0).cast<double>();
  CauseForm form;
  form.at = {equation};
  std::unique_ptr<const Linearised> about;
  std::vector<Step> steps(frame.segments.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Segment& s = frame.segments[i];
    if (beyond.segment(s.first, s.count).sum() < kLeastMisfit * findings.noise[e].colour) continue;
    if (about == nullptr) {
      about = std::make_unique<const Linearised>(
          frame, findings, linked_equations(frame, findings.fit.model.causes, form));
    }
    steps[i] = Steps(*about, s, equation).best();
  }
  return steps;
}

}  // namespace flexspline::studies
