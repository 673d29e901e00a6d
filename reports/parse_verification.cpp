#include <nlohmann/json.hpp>

#include "json_fields.hpp"
#include "parse_artefacts.hpp"

namespace flexspline::reports {
namespace {

using nlohmann::json;

ShownCheck parse_check(const json& from) {
  ShownCheck check{text_in(from, "artefact"),
                   text_in(from, "level"),
                   text_in(from, "reason"),
                   number_in(from, "numbers"),
                   number_in(from, "unequal"),
                   number_in(from, "over_tolerance"),
                   {}};
  for (const json& one : member(from, "worst")) {
    check.worst.push_back({text_in(one, "where"), text_in(one, "quantity"), text_in(one, "before"),
                           text_in(one, "after"), text_in(one, "level"),
                           number_in(one, "over_tolerance")});
  }
  return check;
}

}  // namespace

VerificationView parse_verification(const json& artefact) {
  VerificationView view;
  view.folder = text_in(artefact, "folder");
  view.level = text_in(artefact, "level");
  view.says = text_in(artefact, "says");
  view.holds = flag_in(artefact, "holds");
  for (const json& one : member(artefact, "changed")) {
    view.changed.push_back({text_in(one, "kind"), text_in(one, "name"), text_in(one, "before"),
                            text_in(one, "after")});
  }
  for (const json& one : member(artefact, "tolerances")) {
    view.tolerances.push_back({text_in(one, "quantity"), text_in(one, "says"),
                               number_in(one, "relative"), number_in(one, "of_std"),
                               number_in(one, "statistical")});
  }
  for (const json& one : member(artefact, "artefacts")) view.artefacts.push_back(parse_check(one));
  return view;
}

}  // namespace flexspline::reports
