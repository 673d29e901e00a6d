#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/search/explanation.hpp"
#include "diagnosis/words/spelled.hpp"

namespace flexspline::studies {
namespace {

// One; one and another; one, another and a third.
std::string listed(const std::vector<std::string>& names) {
  if (names.size() < 2) return names.empty() ? "" : names.front();
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::string names_in_words(const std::vector<Cause>& causes) {
  std::vector<std::string> names;
  for (const Cause& cause : causes) {
    std::string name = cause.effect;
    if (!cause.alternatives.empty()) {
      name += fmt::format(" (or {}, confounded with it on these recordings)",
                          fmt::join(cause.alternatives, " or "));
    }
    names.push_back(std::move(name));
  }
  return listed(names);
}

// "order 21, " of a ripple over the motor's angle: a whole number, which was tried, not fitted.
std::string order_of(const ActiveCause& cause) {
  const bool has_one = cause.form->ripples != nullptr && !cause.shape.empty();
  return has_one ? fmt::format("order {:.0f}, ", cause.shape.front()) : "";
}

// The part of the model that has a form, but no name.
std::string part_in_words(const std::vector<Accepted>& unnamed) {
  std::vector<std::string> forms;
  for (const Accepted& a : unnamed) {
    const CauseRow& row = *a.trial.cause.row;
    forms.push_back(!row.in_catalogue() ? fmt::format("{} (outside the catalogue)", row.outside)
                    : a.material ? fmt::format("{} ({}p = {:.2g})", row.id, order_of(a.trial.cause),
                                               a.probability)
                                 : fmt::format("{} (too small to be named)", row.id));
  }
  return fmt::format("a part whose name is uncertain, in the form of {},", listed(forms));
}

// What the model has beside the baseline, after "with".
std::string parts_in_words(std::size_t causes, const std::vector<Accepted>& unnamed) {
  if (causes == 0) return part_in_words(unnamed);
  const std::string named = causes == 1 ? "it" : "them";
  return unnamed.empty() ? named : named + " and " + part_in_words(unnamed);
}

// "falls to 46 % of before", and what that means.
std::string proof_in_words(const HoldoutProof& proof, const std::string& them) {
  if (!std::isfinite(proof.ratio)) {
    return fmt::format("No recording could be held out to prove {}", them);
  }
  const std::string error =
      proof.folds > 0 ? fmt::format(
                            "error of the whole search on recordings that it did not have "
                            "({} outer fold{})",
                            proof.folds, proof.folds == 1 ? "" : "s")
      : proof.nested ? "error on recordings taken away before the search"
                     : "cross-validated error (selection not nested)";
  const char* change = proof.ratio < 1.0 ? "falls" : "rises";
  return fmt::format("With {} the {} {} to {:.0f} % of before, {:.3g} times the noise", them, error,
                     change, 100.0 * proof.ratio, proof.over_noise());
}

// What is left beside names; what the part without a name takes is not.
std::string rest_in_words(const Selection& s, const Limits& limits, const HoldoutProof& proof,
                          const std::optional<Resonance>& resonance) {
  if (resonance) return fmt::format(", and {}", in_words(*resonance));
  const double over_noise = proof.over_noise();
  if (!s.unnamed.empty() && over_noise * over_noise <= limits.as_noise()) return "";
  return ", and an unexplained residual remains that no catalogued effect explains";
}

}  // namespace

std::string spelled_verdict(const Selection& s, const Limits& limits,
                            const std::optional<Resonance>& resonance, const Diagnosis& d) {
  if (d.verdict == Verdict::adequate) {
    return "Nothing is missing: the baseline explains the recordings to within their noise.";
  }
  const std::string proof = proof_in_words(d.holdout, parts_in_words(d.causes.size(), s.unnamed));
  if (!d.causes.empty()) {
    const std::string rest = d.verdict == Verdict::partly_explained
                                 ? rest_in_words(s, limits, d.holdout, resonance)
                                 : "";
    return fmt::format("Missing: {}. {}{}.", names_in_words(d.causes), proof, rest);
  }
  if (!s.unnamed.empty())
    return fmt::format("Physics is missing, its name is uncertain. {}.", proof);
  const bool incident = !d.mismatch.empty() && d.mismatch.front().coordinate == "window";
  if (!s.remainder && incident) return fmt::format("{}.", d.mismatch.front().says);
  if (!s.remainder && resonance) {
    return fmt::format("Physics is missing that no catalogued effect explains: {}.",
                       in_words(*resonance));
  }
  if (!s.remainder && left_unnamed(s, limits) == nullptr) {
    return fmt::format(
        "Physics is missing that no catalogued effect explains: the error on held-out "
        "recordings is {:.3g} times the noise.",
        d.holdout.over_noise());
  }
  if (!s.remainder) {
    return fmt::format("Physics is missing, too little to be named; {}.", d.mismatch.front().says);
  }
  return d.mismatch.empty()
             ? "Physics is missing that no catalogued effect explains."
             : fmt::format("Physics is missing that no catalogued effect explains; {}.",
                           d.mismatch.front().says);
}

}  // namespace flexspline::studies
