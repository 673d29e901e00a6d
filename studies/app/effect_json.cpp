#include "effect_json.hpp"

#include <nlohmann/json.hpp>

#include "effect_pages.hpp"

namespace flexspline::app {

using nlohmann::ordered_json;

ordered_json effect_json(const EffectRow& row) {
  ordered_json parameters = ordered_json::array();
  for (const EffectParameter& one : row.parameters) {
    parameters.push_back({{"name", one.name},
                          {"unit", one.unit},
                          {"lower", one.lower},
                          {"upper", one.upper},
                          {"nominal", one.nominal},
                          {"source", one.source}});
  }
  ordered_json rigs = ordered_json::array();
  for (const Rig rig : row.rigs) rigs.push_back(name_of(rig));
  return {{"id", row.id},
          {"says", row.equation},
          {"coordinate", row.coordinate},
          {"site", name_of(row.site)},
          {"enters", site_in_words(row.site)},
          {"rigs", rigs},
          {"range", row.range},
          {"not_modelled", row.not_modelled},
          {"source", row.source},
          {"states", row.states},
          {"repeats", row.repeats},
          {"passive", row.passive},
          {"active_because", row.active_because},
          {"rate_independent", row.rate_independent},
          {"parameters", parameters}};
}

}  // namespace flexspline::app
