#include "flexspline/studies/kind.hpp"

namespace flexspline::studies {

KindRow describe_trial() {
  return {.id = "trial",
          .summary = "blind trials of the diagnosis: concealed, diagnosed, unsealed, scored",
          .cases = "cases of a trial file, docs/trials.md",
          .question = "How often does a diagnosis find what was concealed from it?",
          .schema = "flexspline-trial/1"};
}

}  // namespace flexspline::studies
