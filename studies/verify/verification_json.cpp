#include <cmath>

#include <nlohmann/json.hpp>

#include "flexspline/studies/verify.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json check_json(const ArtefactCheck& check) {
  ordered_json json = {{"artefact", check.artefact},
                       {"level", name_of(check.level)},
                       {"numbers", check.numbers},
                       {"unequal", check.unequal},
                       {"over_tolerance", number(check.largest)},
                       {"reason", check.reason},
                       {"worst", ordered_json::array()}};
  for (const Difference& one : check.worst) {
    json["worst"].push_back({{"where", one.where},
                             {"quantity", one.quantity},
                             {"before", one.before},
                             {"after", one.after},
                             {"over_tolerance", number(one.over_tolerance)},
                             {"level", name_of(one.level)}});
  }
  return json;
}

}  // namespace

ordered_json to_json(const Verification& verification) {
  ordered_json json = {{"schema", kVerificationSchema},
                       {"folder", verification.folder},
                       {"level", name_of(verification.level)},
                       {"holds", verification.holds()},
                       {"says", verification.says},
                       {"changed", ordered_json::array()},
                       {"tolerances", ordered_json::array()},
                       {"artefacts", ordered_json::array()}};
  for (const Circumstance& one : verification.changed) {
    json["changed"].push_back(
        {{"kind", one.kind}, {"name", one.name}, {"before", one.before}, {"after", one.after}});
  }
  for (const QuantityClass& one : quantity_classes()) {
    json["tolerances"].push_back({{"quantity", one.name},
                                  {"relative", one.relative},
                                  {"of_std", one.of_std},
                                  {"statistical", one.statistical},
                                  {"says", one.says}});
  }
  for (const ArtefactCheck& one : verification.artefacts) {
    json["artefacts"].push_back(check_json(one));
  }
  return json;
}

}  // namespace flexspline::studies
