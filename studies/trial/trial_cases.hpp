#pragma once

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

/// The cases of a blind trial, as an engine sees them.
class TrialCases : public CaseSource {
 public:
  TrialCases(const TrialConfig& trial, const TrialSettings& settings, const Diagnose& diagnose)
      : trial_(&trial), settings_(&settings), diagnose_(&diagnose), cases_(plan_trial(trial)) {}

  std::size_t size() const override { return cases_.size(); }
  CaseName name(std::size_t number) const override;
  CaseResult compute(std::size_t number) override;
  /// Concealed once more: a diagnosis that was ended counts as failed in its kind.
  CaseResult give_up(std::size_t number, const Error& why) override;

  const TrialCase& at(std::size_t number) const { return cases_.at(number); }

 private:
  CaseResult result_of(std::size_t number, const Diagnose& diagnose) const;

  const TrialConfig* trial_;
  const TrialSettings* settings_;
  const Diagnose* diagnose_;
  std::vector<TrialCase> cases_;
};

}  // namespace flexspline::studies
