#pragma once

#include <string>
#include <vector>

#include "torsion/start.hpp"

namespace flexspline::estimators {

/// What a user allows to be free; each is still left out where these recordings cannot tell it.
struct AllowedTerms {
  bool h = true;
  bool inertia = true;
  bool delay = true;
};

/// Which terms beyond f and g^-1 these recordings can tell from them, and why not the others.
struct TermDecision {
  FreeTerms free;
  double condition = kNotComputed;
  std::vector<Absorbed> absorbed;
  double log_h_std = kNotComputed;  ///< sd of ln h at 0.9 of the range, by their noise
  std::string verdict;
  std::string says;
  std::vector<std::string> notes;
};

/// Decides at a fit of f and g^-1 alone by the Jacobian of eq. (4) with all terms: a term is free
/// where its standard deviation, at the noise of the recordings, is small enough to matter: 0.1 in
/// ln h, 2 % of peak effort in inertia and delay; ln h also has to keep clear (cosine 0.999) of
/// what f and g^-1 can imitate.
Result<TermDecision> decide_terms(const LinearStart& start,
                                  const std::vector<PreparedRecord>& records, FreeTerms base,
                                  AllowedTerms allowed);

}  // namespace flexspline::estimators
