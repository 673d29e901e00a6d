#include "diagnosis_artefact.hpp"

#include <nlohmann/json.hpp>

#include "flexspline/studies/diagnosis_json.hpp"
#include "version.hpp"

namespace flexspline::app {

nlohmann::ordered_json diagnosis_artefact(const studies::Diagnosis& diagnosis) {
  nlohmann::ordered_json artefact = studies::to_json(diagnosis);
  artefact["build_id"] = build_id();
  artefact["versions"] = versions();
  return artefact;
}

}  // namespace flexspline::app
