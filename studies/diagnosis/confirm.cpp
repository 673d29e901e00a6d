#include "diagnosis/confirm.hpp"

#include <algorithm>
#include <optional>

#include "diagnosis/unnamed.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostAlternatives = 2;

// One that could not be judged is not proved.
bool is_proved(const CauseProof& cause, const Limits& limits) { return cause.gain >= limits.gain; }

// Of the causes that are not proved the one that does worst.
std::optional<std::size_t> unconfirmed(const Proof& proof, const Limits& limits) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < proof.causes.size(); ++i) {
    if (is_proved(proof.causes[i], limits)) continue;
    if (!worst || !(proof.causes[i].name.ratio <= proof.causes[*worst].name.ratio)) worst = i;
  }
  return worst;
}

// What explained much where it was fitted and nothing elsewhere leaves a question, not an answer.
bool leaves_a_question(const Frame& frame, const Limits& limits, const Selection& s,
                       std::size_t cause) {
  const double gain = s.accepted[cause].trial.gain;
  return gain > limits.half * (chi_square(frame, s.final, s.final.fit) + gain);
}

// What explains the same signal nearly as well as a cause that fails on recordings held out, if it
// holds there itself.
Result<std::optional<Selection>> with_proven_rival(const Frame& frame, const Limits& limits,
                                                   Selection s, std::size_t cause) {
  auto& rivals = s.accepted[cause].rivals;
  std::erase_if(rivals, [&](const Trial& t) {
    return std::ranges::any_of(s.final.fit.model.causes,
                               [&](const ActiveCause& c) { return c.row == t.cause.row; });
  });
  if (rivals.empty()) return std::nullopt;
  auto other =
      with_rival(frame, limits, s, cause,
                 "it does not lower the error on recordings held out, an alternative does");
  if (!other) return tl::unexpected(other.error());
  if (other->accepted.size() < s.accepted.size() || !other->accepted.back().material) {
    return std::nullopt;
  }
  const auto proof = prove(frame, *other, limits.threads);
  if (!proof) return tl::unexpected(proof.error());
  if (!is_proved(proof->causes.back(), limits)) return std::nullopt;
  return std::move(*other);
}


// What is read from the final model beside a cause's proof.
void complete(const Frame& frame, const Selection& s, Proof& proof) {
  if (s.accepted.empty()) return;
  const auto evidence = left_to_tables(frame, s.final);
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    double most = 0.0;
    for (Equation at : s.accepted[i].trial.cause.form->at) {
      most = std::max(most, evidence[index_of(at)]);
    }
    NameEvidence& name = proof.causes[i].name;
    name.left_over = most / (0.5 * s.accepted[i].trial.gain);
    name.alternatives = alternatives_of(s.accepted[i], s).size();
  }
}

// The least probable of the causes that are more likely wrong, their alternatives too.
std::optional<std::size_t> improbable(const Proof& proof, const Limits& limits) {
  std::optional<std::size_t> least;
  double lowest = limits.probability;
  for (std::size_t i = 0; i < proof.causes.size(); ++i) {
    NameEvidence name = proof.causes[i].name;
    name.alternatives = 0;
    const double probability = probability_right(name);
    if (probability >= lowest) continue;
    lowest = probability;
    least = i;
  }
  return least;
}

}  // namespace

std::vector<std::string> alternatives_of(const Accepted& accepted, const Selection& s) {
  std::vector<std::string> ids;
  for (const Trial& t : accepted.rivals) {
    const bool named = std::ranges::any_of(
        s.accepted, [&](const Accepted& a) { return a.trial.cause.row == t.cause.row; });
    if (!named && ids.size() < kMostAlternatives) ids.emplace_back(t.cause.row->id);
  }
  return ids;
}

Result<Proof> confirm(const Frame& frame, const Limits& limits, Selection& s) {
  while (true) {
    auto proof = prove(frame, s, limits.threads);
    if (!proof) return proof;
    const auto worst = unconfirmed(*proof, limits);
    if (!worst) {
      complete(frame, s, *proof);
      const auto least = improbable(*proof, limits);
      if (!least) return proof;
      const auto left_out =
          leave_out(frame, limits, s, *least, "it is more likely wrong than right");
      if (!left_out) return tl::unexpected(left_out.error());
      continue;
    }
    auto exchanged = with_proven_rival(frame, limits, s, *worst);
    if (!exchanged) return tl::unexpected(exchanged.error());
    if (*exchanged) {
      s = std::move(**exchanged);
      continue;
    }
    s.unproved = s.unproved || leaves_a_question(frame, limits, s, *worst);
    const auto left_out = leave_out(frame, limits, s, *worst,
                                    proof->causes[*worst].gain > 0.0
                                        ? "it hardly lowers the error on recordings held out"
                                        : "it does not lower the error on recordings held out");
    if (!left_out) return tl::unexpected(left_out.error());
  }
}

}  // namespace flexspline::studies
