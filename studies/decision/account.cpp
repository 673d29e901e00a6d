#include "decision/account.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flexspline::studies::decision {
namespace {

using Eigen::Index;

constexpr std::size_t kMismatches = 6;
constexpr Index kSeriesPoints = 400;

// Share of the outer folds that name the cause or one of its class.
double stability(const Proof& proof, const std::string& id,
                 const std::vector<std::string>& alternatives) {
  if (proof.named.empty()) return kNotComputed;
  const auto in_class = [&](const std::string& name) {
    return name == id || std::ranges::find(alternatives, name) != alternatives.end();
  };
  const auto count = std::ranges::count_if(
      proof.named, [&](const auto& names) { return std::ranges::any_of(names, in_class); });
  return static_cast<double>(count) / static_cast<double>(proof.named.size());
}

std::vector<CauseParameter> parameters(const Frame& frame, const Fit& fit, std::size_t i) {
  const Taken& cause = fit.state.causes[i];
  const auto deviation = [&](Index k) {
    const double variance =
        fit.variances.solution.covariance(fit.system.first[i] + k, fit.system.first[i] + k);
    return variance > 0.0 ? std::sqrt(variance) : kNotComputed;
  };
  std::vector<CauseParameter> list;
  const auto shapes =
      cause.form->shapes == nullptr ? std::vector<Shape>{} : cause.form->shapes(frame);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const bool known = steps(*cause.form);
    list.push_back({std::string(shapes[k].name), cause.shape[k],
                    known ? deviation(static_cast<Index>(k)) : kNotComputed,
                    std::string(shapes[k].unit)});
  }
  for (Index k = 0; k < cause.coefficients.size(); ++k) {
    list.push_back({fmt::format("a{}", k + 1), cause.coefficients[k], deviation(k), ""});
  }
  return list;
}

Mismatch in_words(const Frame& frame, const Located& at) {
  return {frame.segments[at.segment].id,
          at.from_s,
          at.to_s,
          at.coordinate,
          std::string(name_of(at.equation)),
          at.share,
          fmt::format("{} orders {:.2g} % of the largest torque", at.says, 100.0 * at.size)};
}

// What is named lies in its own coordinate; then what the components locate, once a coordinate.
std::vector<Mismatch> mismatches(const Frame& frame, const Decision& d, const Verdict verdict) {
  std::vector<Mismatch> list;
  if (verdict == Verdict::adequate) return list;
  const auto add = [&](Mismatch one) {
    const bool there = std::ranges::any_of(
        list, [&](const Mismatch& m) { return m.coordinate == one.coordinate; });
    if (!there && list.size() < kMismatches) list.push_back(std::move(one));
  };
  if (d.burst) {
    const Segment& s = frame.segments[d.burst->segment];
    list.push_back({s.id, frame.time[d.burst->first],
                    frame.time[d.burst->first + d.burst->count - 1], "window",
                    std::string(name_of(d.burst->equation)), kNotComputed,
                    fmt::format("inside this interval {:.2g} % of the largest torque is not the "
                                "recording's own noise",
                                100.0 * d.burst->size)});
  }
  for (const Named& one : d.named) {
    const Taken& cause = d.fit.state.causes[one.cause];
    const Equation equation = first_equation(frame, *cause.form);
    Located at{equation, std::string(cause.row->coordinate), std::string(cause.row->id), 0.0,
               one.size};
    const auto same = std::ranges::find_if(d.located, [&](const Located& l) {
      return l.equation == equation && l.coordinate == cause.row->coordinate;
    });
    if (same != d.located.end()) {
      at.share = same->share, at.segment = same->segment;
      at.from_s = same->from_s, at.to_s = same->to_s;
    }
    add(in_words(frame, at));
  }
  for (const Located& at : d.named.empty() ? d.located : d.remains) add(in_words(frame, at));
  return list;
}

std::vector<Cause> named_causes(const Frame& frame, const Decision& d, const Proof& proof) {
  std::vector<Cause> list;
  for (const Named& one : d.named) {
    const Taken& cause = d.fit.state.causes[one.cause];
    Cause c;
    c.effect = cause.row->id;
    c.probability = one.probability;
    c.size_fraction = one.size;
    c.equation = cause.form->equation;
    c.parameters = parameters(frame, d.fit, one.cause);
    c.alternatives = one.alternatives;
    c.evidence.delta_bic = -2.0 * one.gain;
    if (d.named.size() == 1) c.evidence.holdout_rmse_ratio = proof.holdout.ratio;
    list.push_back(std::move(c));
  }
  return list;
}

std::vector<TriedCandidate> tried(const Decision& d) {
  std::vector<TriedCandidate> list;
  for (const Named& one : d.named) {
    list.push_back({std::string(d.fit.state.causes[one.cause].row->id), 1, kNotComputed,
                    -2.0 * one.gain, kNotComputed, "accepted"});
  }
  for (const Candidate& c : d.tried) {
    list.push_back({std::string(c.cause.row->id), 2, kNotComputed, -2.0 * c.gain, kNotComputed,
                    "its odds are not those of a name"});
  }
  return list;
}

std::vector<DiagnosedSeries> series(const Frame& frame, const Proof& proof) {
  std::vector<DiagnosedSeries> list;
  const bool motor = proof.equation == Equation::motor;
  for (const Segment& s : frame.segments) {
    DiagnosedSeries one;
    one.recording = s.id;
    one.equation = name_of(proof.equation);
    for (Index r = s.first; r < s.first + s.count;
         r += std::max<Index>(1, s.count / kSeriesPoints)) {
      const auto k = static_cast<std::size_t>(r);
      if (!(frame.usable[r] > 0.0) || proof.before.empty()) continue;
      one.time.push_back(frame.time[r]);
      one.motion.push_back(frame.torsion[r]);
      one.rate.push_back(frame.torsion_rate[r]);
      one.measured.push_back(motor ? frame.motor_torque[r] : frame.torque[r]);
      one.before.push_back(proof.before[k]);
      one.after.push_back(proof.after[k]);
      if (frame.rig != Rig::locked) one.motor_angle.push_back(frame.motor_angle[r]);
    }
    list.push_back(std::move(one));
  }
  return list;
}

std::string noise_in_words(const Bench& bench) {
  std::vector<std::string> parts;
  for (const EquationRows& one : bench.equations) {
    parts.push_back(fmt::format(
        "{}: autoregression of order {}, a sample counting as {:.2g} of an independent one{}",
        name_of(one.equation), one.noise.order(), 1.0 / one.noise.inefficiency(),
        one.noise.freedom > 0.0
            ? fmt::format(", Student t with {:.0f} degrees of freedom", one.noise.freedom)
            : ""));
  }
  return fmt::format("noise of the {}", fmt::join(parts, "; "));
}

std::string in_words(const Diagnosis& d, const Decision& decision, const Frame& frame) {
  std::vector<std::string> names;
  for (const Cause& c : d.causes) {
    names.push_back(c.alternatives.empty()
                        ? c.effect
                        : fmt::format("{} (or {}, confounded with it on these recordings)",
                                      c.effect, fmt::join(c.alternatives, " or ")));
  }
  std::string left = "a residual remains that no catalogued effect explains";
  if (decision.burst) {
    left = fmt::format("an interval of recording {} stands out",
                       frame.segments[decision.burst->segment].id);
  } else if (decision.left.real) {
    left += fmt::format(", {:.2g} % of the largest torque", 100.0 * decision.left.size);
  }
  switch (d.verdict) {
    case Verdict::adequate:
      return "Nothing is missing: the baseline explains the recordings to within their noise.";
    case Verdict::explained:
      return fmt::format("Missing: {}.", fmt::join(names, " and "));
    case Verdict::partly_explained:
      return fmt::format("Missing: {}; {}.", fmt::join(names, " and "), left);
    default:
      return fmt::format("Physics is missing: {}.", left);
  }
}

}  // namespace

Verdict verdict_of(const Decision& d, const Proof& proof, const Calibration& calibration) {
  const bool something = d.burst.has_value() || d.left.real;
  if (d.named.empty()) return something ? Verdict::unexplained : Verdict::adequate;
  const double over = proof.holdout.rmse_after / proof.holdout.noise_floor;
  const bool proved = !std::isfinite(over) || over < calibration.to_noise;
  return something || !proved ? Verdict::partly_explained : Verdict::explained;
}

void account(const Frame& frame, const Decision& d, const Proof& proof,
             const Calibration& calibration, Diagnosis& to) {
  to.verdict = verdict_of(d, proof, calibration);
  to.holdout = proof.holdout;
  to.noise_std = proof.holdout.noise_floor;
  to.baseline_rmse_holdout = proof.holdout.rmse_before;
  to.causes = named_causes(frame, d, proof);
  to.mismatch = mismatches(frame, d, to.verdict);
  to.tried = tried(d);
  to.series = series(frame, proof);
  to.notes.push_back(noise_in_words(d.bench));
  for (Cause& c : to.causes) c.stability = stability(proof, c.effect, c.alternatives);
  to.says = in_words(to, d, frame);
}

}  // namespace flexspline::studies::decision
