#include "diagnosis/names/confirm.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "diagnosis/model/cancelling.hpp"
#include "diagnosis/unnamed/unnamed.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostAlternatives = 2;
constexpr int kFinalSteps = 12;
constexpr double kNever = std::numeric_limits<double>::infinity();

// What is read from the final model beside a cause's proof.
void complete(const Frame& frame, Selection& s, Proof& proof) {
  take_left_over(frame, s.final, s, proof);
  for (std::size_t i = 0; i < s.accepted.size(); ++i) {
    const std::size_t place = s.final.fit.model.causes.size() - s.accepted.size() + i;
    s.accepted[i].trial.size = share_of_torque(frame, s.final.fit.model, s.final.reference, place);
    proof.causes[i].name.alternatives = alternatives_of(s.accepted[i], s).size();
    s.accepted[i].probability = probability_of(proof.causes[i]);
  }
}

bool acts_elsewhere(const Frame& frame, const CauseForm& form, Equation equation) {
  return std::ranges::any_of(form.at, [&](Equation at) { return at != equation && frame.has(at); });
}

/// A cause of the model that another takes back, and why it goes.
struct TakenBack {
  std::size_t cause = 0;
  std::string_view because;
};

// Of a pair that act nowhere else the one that is worth less. Where one of them does and is taken
// back all but a tenth, that one: what it has to do here it does not do.
std::optional<TakenBack> taken_back(const Frame& frame, const Limits& limits, const Selection& s,
                                    const Cancelling& pair) {
  constexpr std::string_view kSum = "another takes most of it back: only their sum is told";
  constexpr std::string_view kRefuted = "what it does in one equation another takes back";
  const DriveModel& model = s.final.fit.model;
  const std::size_t immaterial = model.causes.size() - s.accepted.size();
  const auto elsewhere = [&](std::size_t i) {
    return acts_elsewhere(frame, *model.causes[i].form, pair.equation);
  };
  const auto gain = [&](std::size_t i) {
    return i < immaterial ? kNever : s.accepted[i - immaterial].trial.gain;
  };
  if (elsewhere(pair.first) != elsewhere(pair.second)) {
    if (pair.left > limits.tenth) return std::nullopt;
    return TakenBack{elsewhere(pair.first) ? pair.first : pair.second, kRefuted};
  }
  if (elsewhere(pair.first)) return std::nullopt;
  return TakenBack{gain(pair.first) < gain(pair.second) ? pair.first : pair.second, kSum};
}

Result<void> leave_out_taken_back(const Frame& frame, const Limits& limits, Selection& s) {
  for (bool again = true; again;) {
    again = false;
    const std::size_t immaterial = s.final.fit.model.causes.size() - s.accepted.size();
    for (const Cancelling& pair :
         cancelling(frame, s.final.fit.model, s.final.reference, limits.half)) {
      const auto back = taken_back(frame, limits, s, pair);
      if (!back || back->cause < immaterial) continue;
      const auto left_out = leave_out(frame, s, back->cause - immaterial, back->because);
      if (!left_out) return left_out;
      again = true;
      break;
    }
  }
  return {};
}

std::string_view why_not(const CauseProof& cause) {
  return cause.gain > 0.0 ? "it hardly lowers the error on recordings held out"
                          : "it does not lower the error on recordings held out";
}

/// Causes that were not confirmed, in the order in which they went.
class Doubted {
 public:
  void add(Accepted cause) { gone_.push_back(std::move(cause)); }

  /// The one that gains most beside those that stayed, and what the model is with it. Each is asked
  /// for once, and the last to go not at all: nothing has changed since.
  std::optional<std::pair<Accepted, ModelFit>> best_again(const Frame& frame, const Limits& limits,
                                                          const Findings& final) {
    std::optional<std::pair<Accepted, ModelFit>> best;
    double least = chi_square(frame, final, final.fit) - limits.gain;
    for (std::size_t i = 0; i + 1 < gone_.size(); ++i) {
      const CauseRow* row = gone_[i].trial.cause.row;
      if (std::ranges::count(asked_, row) > 0) continue;
      auto fit = extended(frame, final, gone_[i].trial.cause, kFinalSteps);
      if (!fit) continue;
      const double chi = chi_square(frame, final, *fit);
      if (chi > least) continue;
      least = chi;
      best = {gone_[i], std::move(*fit)};
    }
    if (best) asked_.push_back(best->first.trial.cause.row);
    return best;
  }

 private:
  std::vector<Accepted> gone_;
  std::vector<const CauseRow*> asked_;
};

void take_again(Selection& s, Accepted cause, ModelFit fit) {
  std::erase_if(s.withdrawn,
                [&](const Accepted& a) { return a.trial.cause.row == cause.trial.cause.row; });
  cause.withdrawn_because = {};
  s.final.fit = std::move(fit);
  s.accepted.push_back(std::move(cause));
}

}  // namespace

std::vector<std::string> alternatives_of(const Accepted& accepted, const Selection& s) {
  std::vector<std::string> ids;
  for (const Trial& t : accepted.rivals) {
    const bool named = std::ranges::any_of(
        s.accepted, [&](const Accepted& a) { return a.trial.cause.row == t.cause.row; });
    if (!named && t.cause.row->in_catalogue() && ids.size() < kMostAlternatives)
      ids.emplace_back(t.cause.row->id);
  }
  return ids;
}

void take_left_over(const Frame& frame, const Findings& findings, const Selection& s,
                    Proof& proof) {
  if (proof.causes.empty()) return;
  const auto evidence = left_to_tables(frame, findings);
  for (std::size_t i = 0; i < proof.causes.size(); ++i) {
    const Trial& trial = s.accepted[i].trial;
    double most = 0.0;
    for (Equation at : trial.cause.form->at) most = std::max(most, evidence[index_of(at)]);
    NameEvidence& name = proof.causes[i].name;
    name.left_over = std::max(most / (0.5 * trial.gain), name.left_over);  // NaN stays
  }
}

Result<Proof> confirm(const Frame& frame, const Limits& limits, Selection& s) {
  Doubted doubted;
  while (true) {
    const auto told = leave_out_taken_back(frame, limits, s);
    if (!told) return tl::unexpected(told.error());
    auto proof = prove(frame, s, limits.threads);
    if (!proof) return proof;
    if (const auto doubtful = unconfirmed(*proof, limits)) {
      doubted.add(s.accepted[*doubtful]);
      const auto left_out = leave_out(frame, s, *doubtful, why_not(proof->causes[*doubtful]));
      if (!left_out) return tl::unexpected(left_out.error());
      continue;
    }
    if (auto again = doubted.best_again(frame, limits, s.final)) {
      take_again(s, std::move(again->first), std::move(again->second));
      continue;
    }
    complete(frame, s, *proof);
    const auto fitted = fit_all(frame, s.final, kFinalSteps, kJudgedFall);
    if (!fitted) return tl::unexpected(fitted.error());
    return proof;
  }
}

}  // namespace flexspline::studies
