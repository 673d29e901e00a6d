#include "diagnosis/prove.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kSteps = 8;
constexpr int kResamples = 400;
constexpr Index kBlocksOfRecording = 8;
constexpr double kReach = 1.05;  // of what was fitted: beyond it a law is extrapolated

bool marked(const Frame& frame) {
  return std::ranges::any_of(frame.segments,
                             [](const Segment& s) { return s.split == Split::holdout; });
}

// The cause that does worst on recordings held out, of those that would have shown there.
std::optional<std::size_t> unconfirmed(const Proof& proof, const Limits& limits) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < proof.cause_ratio.size(); ++i) {
    if (!(proof.cause_ratio[i] >= limits.held_out) || proof.cause_shown[i] < limits.named_gain)
      continue;
    if (!worst || proof.cause_ratio[i] > proof.cause_ratio[*worst]) worst = i;
  }
  return worst;
}

// What a law is fitted to has to reach as far as what it is judged on.
bool reaches_furthest(const Frame& frame, const Segment& s) {
  const auto furthest = [&](const ArrayXd& x) {
    const ArrayXd size = x.abs() * frame.usable;
    const double most = size.maxCoeff();
    return most > 0.0 && size.segment(s.first, s.count).maxCoeff() >= most;
  };
  return furthest(frame.torsion) || furthest(frame.torsion_rate) || furthest(frame.motor_speed) ||
         furthest(frame.torque) || s.first == 0;
}

// One in three of those that reach nowhere furthest, in the order of their fastest motion.
std::vector<std::size_t> unmarked_choice(const Frame& frame) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const Segment& s = frame.segments[i];
    if (reaches_furthest(frame, s)) continue;
    const ArrayXd& speed = frame.rig == Rig::free ? frame.load_speed : frame.torsion_rate;
    order.emplace_back(speed.segment(s.first, s.count).abs().maxCoeff(), i);
  }
  std::ranges::sort(order);
  const std::size_t wanted = std::max<std::size_t>(1, frame.segments.size() / 3);
  const std::size_t step = std::max<std::size_t>(1, order.size() / wanted);
  std::vector<std::size_t> chosen;
  for (std::size_t k = step / 2; k < order.size() && chosen.size() < wanted; k += step) {
    chosen.push_back(order[k].second);
  }
  return chosen;
}

// Where every recording reaches further than the others in something: the end of each.
ArrayXd ends(const Frame& frame) {
  ArrayXd rows = ArrayXd::Zero(frame.rows());
  for (const Segment& s : frame.segments) {
    const Index count = s.count / 3;
    rows.segment(s.first + s.count - count, count).setOnes();
  }
  return rows;
}

bool within_reach(const Frame& frame, const ArrayXd& held) {
  const auto reached = [&](const ArrayXd& x) {
    const ArrayXd size = x.abs() * frame.usable;
    return (size * held).maxCoeff() <= kReach * (size * (1.0 - held)).maxCoeff();
  };
  return reached(frame.torsion) && reached(frame.torsion_rate) && reached(frame.motor_speed) &&
         reached(frame.torque);
}

void mask(const Frame& frame, ArrayXd& rows, std::size_t segment) {
  rows.segment(frame.segments[segment].first, frame.segments[segment].count).setOnes();
}

/// Findings whose weights leave the held-out rows out of the fit.
Findings on_training(Findings findings, const ArrayXd& out) {
  for (ArrayXd& weight : findings.weight) {
    if (weight.size() == out.size()) weight *= 1.0 - out;
  }
  return findings;
}

// The model's causes taken over, all parameters fitted to the training rows.
Result<ModelFit> refitted(const Frame& frame, const Findings& training) {
  Findings copy = training;
  const auto done = fit_all(frame, copy, kSteps);
  if (!done) return tl::unexpected(done.error());
  return copy.fit;
}

double rms_on(const ArrayXd& residual, const ArrayXd& rows) {
  const double count = rows.sum();
  return count > 0.0 ? std::sqrt((residual.square() * rows).sum() / count) : kNotComputed;
}

/// Sums of squares of both models by block of the held-out recordings.
struct Blocks {
  std::vector<double> before;
  std::vector<double> after;
};

Blocks blocks_of(const Frame& frame, const ArrayXd& rows, const ArrayXd& before,
                 const ArrayXd& after) {
  Blocks blocks;
  for (const Segment& s : frame.segments) {
    const Index width = s.count / kBlocksOfRecording;
    for (Index b = 0; width > 0 && b < kBlocksOfRecording; ++b) {
      const auto part = Eigen::seqN(s.first + b * width, width);
      if (rows(part).sum() == 0.0) continue;
      blocks.before.push_back((before(part).square() * rows(part)).sum());
      blocks.after.push_back((after(part).square() * rows(part)).sum());
    }
  }
  return blocks;
}

void resample(const Blocks& blocks, HoldoutProof& proof) {
  if (blocks.before.empty()) return;
  std::mt19937_64 engine(2003);
  std::uniform_int_distribution<std::size_t> pick(0, blocks.before.size() - 1);
  std::vector<double> ratios;
  for (int r = 0; r < kResamples; ++r) {
    double before = 0.0;
    double after = 0.0;
    for (std::size_t k = 0; k < blocks.before.size(); ++k) {
      const std::size_t i = pick(engine);
      before += blocks.before[i];
      after += blocks.after[i];
    }
    ratios.push_back(std::sqrt(after / before));
  }
  std::ranges::sort(ratios);
  proof.ci95_lower = ratios[kResamples / 40];
  proof.ci95_upper = ratios[kResamples - 1 - kResamples / 40];
}

// The best of the causes that were tried and are not there.
Result<double> placebo(const Frame& frame, const Selection& s, const Findings& training,
                       const ArrayXd& rows, std::size_t e, double before) {
  if (s.accepted.front().field.empty()) return kNotComputed;
  Findings other = training;
  other.fit = s.accepted.front().field.front().fit;
  if (other.fit.residual[e].size() == 0) return kNotComputed;
  const auto fit = refitted(frame, other);
  if (!fit) return tl::unexpected(fit.error());
  return rms_on(fit->residual[e], rows) / before;
}

Result<void> prove_causes(const Frame& frame, const Selection& s, const Findings& final,
                          const Findings& base, const ArrayXd& out, Proof& proof) {
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    Equation equation = s.accepted[i].trial.cause.form->at.front();
    for (Equation at : s.accepted[i].trial.cause.form->at) {
      if (frame.has(at)) {
        equation = at;
        break;
      }
    }
    const std::size_t e = index_of(equation);
    const ArrayXd rows = out * frame.usable;
    const auto without = reduced(frame, final, s.immaterial.size() + i, kSteps);
    if (!without) return tl::unexpected(without.error());
    proof.cause_ratio.push_back(rms_on(final.fit.residual[e], rows) /
                                rms_on(without->residual[e], rows));
    const ArrayXd change = final.fit.prediction[e] - without->prediction[e];
    const ArrayXd weight = weights_of(frame, final.noise[e].level) * rows;
    proof.cause_shown.push_back((change * weight).square().sum() / final.noise[e].colour);
    const auto instead = placebo(frame, s, base, rows, e, rms_on(base.fit.residual[e], rows));
    proof.placebo_ratio.push_back(instead ? *instead : kNotComputed);
  }
  return {};
}

}  // namespace

ArrayXd held_out(const Frame& frame) {
  ArrayXd rows = ArrayXd::Zero(frame.rows());
  if (marked(frame)) {
    for (std::size_t i = 0; i < frame.segments.size(); ++i) {
      if (frame.segments[i].split == Split::holdout) mask(frame, rows, i);
    }
    return rows;
  }
  const auto chosen = unmarked_choice(frame);
  for (std::size_t i : chosen) mask(frame, rows, i);
  if (!chosen.empty()) return rows;
  const ArrayXd last = ends(frame);
  return within_reach(frame, last) ? last : rows;
}

Equation equation_to_prove(const Frame& frame, const Selection& selection) {
  Equation first = frame.equations.front();
  for (const Accepted& a : selection.accepted) {
    for (Equation at : a.trial.cause.form->at) {
      if (at == Equation::torsion && frame.has(at)) return at;
    }
  }
  if (selection.accepted.empty()) return first;
  for (Equation at : selection.accepted.front().trial.cause.form->at) {
    if (frame.has(at)) return at;
  }
  return first;
}

Result<Proof> prove(const Frame& frame, const Selection& s) {
  const ArrayXd out = held_out(frame);
  const std::size_t e = index_of(equation_to_prove(frame, s));
  Proof proof;
  Findings base = on_training(s.baseline, out);
  base.weight = on_training(s.final, out).weight;
  base.noise = s.final.noise;
  auto base_fit = refitted(frame, base);
  if (!base_fit) return tl::unexpected(base_fit.error());
  base.fit = std::move(*base_fit);
  Findings final = on_training(s.final, out);
  auto final_fit = refitted(frame, final);
  if (!final_fit) return tl::unexpected(final_fit.error());
  final.fit = std::move(*final_fit);
  const ArrayXd held = out * frame.usable;
  const ArrayXd train = (1.0 - out) * frame.usable;
  HoldoutProof& h = proof.holdout;
  h.rmse_before = rms_on(base.fit.residual[e], held);
  h.rmse_after = rms_on(final.fit.residual[e], held);
  h.ratio = h.rmse_after / h.rmse_before;
  proof.rmse_train_before = rms_on(base.fit.residual[e], train);
  proof.rmse_train_after = rms_on(final.fit.residual[e], train);
  resample(blocks_of(frame, held, base.fit.residual[e], final.fit.residual[e]), h);
  double variance = 0.0;
  double rows = 0.0;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const double count = held.segment(frame.segments[i].first, frame.segments[i].count).sum();
    variance += count * s.final.noise[e].level[i] * s.final.noise[e].level[i];
    rows += count;
  }
  h.noise_floor = rows > 0.0 ? std::sqrt(variance / rows) : kNotComputed;
  const auto causes = prove_causes(frame, s, final, base, out, proof);
  if (!causes) return tl::unexpected(causes.error());
  if (e == index_of(Equation::motor)) {
    for (double* value : {&h.rmse_before, &h.rmse_after, &h.noise_floor, &proof.rmse_train_before,
                          &proof.rmse_train_after}) {
      *value *= frame.ratio;
    }
  }
  return proof;
}

Result<Proof> confirm(const Frame& frame, const Limits& limits, Selection& s) {
  while (true) {
    auto proof = prove(frame, s);
    if (!proof) return proof;
    const auto worst = unconfirmed(*proof, limits);
    if (!worst) return proof;
    const auto left_out =
        leave_out(frame, limits, s, *worst, "it does not lower the error on recordings held out");
    if (!left_out) return tl::unexpected(left_out.error());
  }
}

}  // namespace flexspline::studies
