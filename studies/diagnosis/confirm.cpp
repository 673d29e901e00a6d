#include "diagnosis/confirm.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/cancelling.hpp"
#include "diagnosis/unnamed.hpp"
#include "diagnosis/unnamed_causes.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostAlternatives = 2;
constexpr int kFinalSteps = 12;

// What explained much where it was fitted and nothing elsewhere leaves a question, not an answer.
bool leaves_a_question(const Frame& frame, const Limits& limits, const Selection& s,
                       std::size_t cause) {
  const double gain = s.accepted[cause].trial.gain;
  return gain > limits.half * (chi_square(frame, s.final, s.final.fit) + gain);
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

bool stands(const CauseProof& cause, const Limits& limits) {
  return is_confirmed(cause, limits) && probability_of(cause) >= limits.probability;
}

bool acts_elsewhere(const Frame& frame, const CauseForm& form, Equation equation) {
  return std::ranges::any_of(form.at, [&](Equation at) { return at != equation && frame.has(at); });
}

// Of two that take most of each other back, and act nowhere else, the one that is worth less.
std::optional<std::size_t> taken_back(const Frame& frame, const Limits& limits,
                                      const Selection& s) {
  const DriveModel& model = s.final.fit.model;
  const std::size_t immaterial = model.causes.size() - s.accepted.size();
  for (const Cancelling& pair : cancelling(frame, model, s.final.reference, limits.half)) {
    if (pair.second < immaterial) continue;
    if (acts_elsewhere(frame, *model.causes[pair.first].form, pair.equation) ||
        acts_elsewhere(frame, *model.causes[pair.second].form, pair.equation)) {
      continue;
    }
    const std::size_t second = pair.second - immaterial;
    if (pair.first < immaterial) return second;
    const std::size_t first = pair.first - immaterial;
    return s.accepted[first].trial.gain < s.accepted[second].trial.gain ? first : second;
  }
  return std::nullopt;
}

Result<void> leave_out_taken_back(const Frame& frame, const Limits& limits, Selection& s) {
  while (const auto cause = taken_back(frame, limits, s)) {
    const auto left_out =
        leave_out(frame, s, *cause, "another takes most of it back: only their sum is told");
    if (!left_out) return left_out;
  }
  return {};
}

// What explains the same signal nearly as well as a cause that does not stand, if it stands itself.
Result<std::optional<Selection>> with_rival_that_stands(const Frame& frame, const Limits& limits,
                                                        Selection s, std::size_t cause) {
  auto& rivals = s.accepted[cause].rivals;
  std::erase_if(rivals, [&](const Trial& t) {
    return std::ranges::any_of(s.final.fit.model.causes,
                               [&](const ActiveCause& c) { return c.row == t.cause.row; });
  });
  if (rivals.empty()) return std::nullopt;
  auto other = with_rival(frame, limits, s, cause,
                          "recordings held out do not confirm it, an alternative they do");
  if (!other) return tl::unexpected(other.error());
  if (other->accepted.size() < s.accepted.size() || !other->accepted.back().material) {
    return std::nullopt;
  }
  auto proof = prove(frame, *other, limits.threads);
  if (!proof) return tl::unexpected(proof.error());
  if (!is_confirmed(proof->causes.back(), limits)) return std::nullopt;
  complete(frame, *other, *proof);
  if (!stands(proof->causes.back(), limits)) return std::nullopt;
  return std::move(*other);
}

// In place of one that recordings held out do not confirm, or else of one whose name is improbable;
// none where no rival stands.
Result<std::optional<Selection>> exchanged(const Frame& frame, const Limits& limits,
                                           const Selection& s, const Proof& proof,
                                           std::optional<std::size_t> doubtful) {
  if (doubtful) return with_rival_that_stands(frame, limits, s, *doubtful);
  for (std::size_t i = 0; i < proof.causes.size(); ++i) {
    if (stands(proof.causes[i], limits)) continue;
    auto other = with_rival_that_stands(frame, limits, s, i);
    if (!other || *other) return other;
  }
  return std::nullopt;
}

std::string_view why_not(const CauseProof& cause) {
  return cause.gain > 0.0 ? "it hardly lowers the error on recordings held out"
                          : "it does not lower the error on recordings held out";
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
    const auto told = leave_out_taken_back(frame, limits, s);
    if (!told) return tl::unexpected(told.error());
    auto proof = prove(frame, s, limits.threads);
    if (!proof) return proof;
    const auto doubtful = unconfirmed(*proof, limits);
    if (!doubtful) complete(frame, s, *proof);
    auto other = exchanged(frame, limits, s, *proof, doubtful);
    if (!other) return tl::unexpected(other.error());
    if (*other) {
      s = std::move(**other);
    } else if (doubtful) {
      s.unproved = s.unproved || leaves_a_question(frame, limits, s, *doubtful);
      const auto left_out = leave_out(frame, s, *doubtful, why_not(proof->causes[*doubtful]));
      if (!left_out) return tl::unexpected(left_out.error());
    } else {
      const auto fitted = fit_all(frame, s.final, kFinalSteps, kJudgedFall);
      if (!fitted) return tl::unexpected(fitted.error());
      return take_improbable_names(frame, limits, s, std::move(*proof));
    }
  }
}

}  // namespace flexspline::studies
