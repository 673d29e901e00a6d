#include "decision/proof.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "decision/predict.hpp"
#include "diagnosis/folds.hpp"
#include "diagnosis/middle.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Eigen::Index kMostRows = 8000;
constexpr int kPlainPasses = 4;
constexpr Index kBlock = 25;  // rows that are drawn together
constexpr int kDraws = 400;

// Baseline and causes alone, fitted without a remainder.
DriveState plain(const Bench& bench, const Fit& fit) {
  return fit_state(bench, fit.state, fit.ratio, kPlainPasses, Remainder::none).state;
}

Equation equation_to_prove(const Frame& frame, const Fit& fit) {
  const auto acts = [&](Equation e) {
    return std::ranges::any_of(
        fit.state.causes, [&](const Taken& t) { return std::ranges::count(t.form->at, e) > 0; });
  };
  const Equation first = frame.equations.front();
  if (fit.state.causes.empty() || acts(first)) return first;
  return first_equation(frame, *fit.state.causes.front().form);
}

struct FoldResult {
  std::optional<Error> error;
  ArrayXd before, after;
  std::vector<std::string> named;
};

FoldResult judge(const RecordingSet& set, const Frame& frame, const ArrayXd& fold,
                 Equation equation, const Calibration& calibration, unsigned threads) {
  FoldResult result;
  const auto inner = make_frame(without_rows(set, frame, fold), kMostRows);
  if (!inner) {
    result.error = inner.error();
    return result;
  }
  const Decision d = decide(*inner, calibration, threads, {});
  result.before = predicted(frame, *inner, plain(d.bench, d.baseline), equation);
  result.after = d.fit.state.causes.empty()
                     ? result.before
                     : predicted(frame, *inner, plain(d.bench, d.fit), equation);
  for (const Named& one : d.named) {
    result.named.emplace_back(d.fit.state.causes[one.cause].row->id);
    for (const std::string& other : one.alternatives) result.named.push_back(other);
  }
  return result;
}

struct Squares {
  double before = 0.0, after = 0.0;
};

void interval(std::vector<Squares> blocks, HoldoutProof& proof) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::size_t> one(0, blocks.size() - 1);
  std::vector<double> ratios;
  for (int draw = 0; draw < kDraws; ++draw) {
    Squares sum;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const Squares& b = blocks[one(random)];
      sum.before += b.before, sum.after += b.after;
    }
    ratios.push_back(std::sqrt(sum.after / sum.before));
  }
  proof.ci95_lower = percentile(ratios, 0.025);
  proof.ci95_upper = percentile(ratios, 0.975);
}

double noise_floor(const Bench& bench, Equation equation) {
  for (const EquationRows& one : bench.equations) {
    if (one.equation != equation) continue;
    double sum = 0.0;
    for (const std::size_t s : one.rows.segment) sum += one.noise.scale[s] * one.noise.scale[s];
    return one.noise.innovation.front() * std::sqrt(sum / static_cast<double>(one.rows.size()));
  }
  return kNotComputed;
}

}  // namespace

Result<Proof> prove(const RecordingSet& set, const Frame& frame, const Decision& decision,
                    const Calibration& calibration, unsigned threads) {
  Proof proof;
  proof.equation = equation_to_prove(frame, decision.fit);
  const auto folds = outer_folds(frame);
  std::vector<FoldResult> results(folds.size());
  in_parallel(folds.size(), threads, [&](std::size_t i) {
    results[i] = judge(set, frame, folds[i], proof.equation, calibration, 1);
  });
  const bool motor = proof.equation == Equation::motor;
  const ArrayXd& measured = motor ? frame.motor_torque : frame.torque;
  const double at_output = motor ? frame.ratio : 1.0;
  proof.before.assign(static_cast<std::size_t>(frame.rows()), kNotComputed);
  proof.after = proof.before;
  std::vector<Squares> blocks;
  Squares sum;
  double rows = 0.0;
  for (std::size_t i = 0; i < folds.size(); ++i) {
    if (results[i].error) return tl::unexpected(*results[i].error);
    proof.named.push_back(results[i].named);
    Index in_block = kBlock;
    for (Index r = 0; r < frame.rows(); ++r) {
      if (!(folds[i][r] > 0.0)) continue;
      proof.before[static_cast<std::size_t>(r)] = results[i].before[r];
      proof.after[static_cast<std::size_t>(r)] = results[i].after[r];
      if (!(frame.usable[r] > 0.0)) continue;
      if (in_block++ == kBlock) blocks.emplace_back(), in_block = 1;
      const double before = std::pow(measured[r] - results[i].before[r], 2);
      const double after = std::pow(measured[r] - results[i].after[r], 2);
      blocks.back().before += before, blocks.back().after += after;
      sum.before += before, sum.after += after;
      rows += 1.0;
    }
  }
  proof.holdout.noise_floor = at_output * noise_floor(decision.bench, proof.equation);
  proof.holdout.nested = true;
  proof.holdout.folds = static_cast<int>(folds.size());
  if (rows == 0.0) return proof;
  proof.holdout.rmse_before = at_output * std::sqrt(sum.before / rows);
  proof.holdout.rmse_after = at_output * std::sqrt(sum.after / rows);
  proof.holdout.ratio = std::sqrt(sum.after / sum.before);
  interval(std::move(blocks), proof.holdout);
  return proof;
}

}  // namespace flexspline::studies::decision
