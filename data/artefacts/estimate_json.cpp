#include "flexspline/data/estimate_json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace flexspline::data {
namespace {

using Json = nlohmann::ordered_json;

/// null for what was not computed: the library writes NaN so, but keeps it as a number until then.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// A number of SI units a display unit has, and its symbol.
struct Axis {
  std::string symbol;
  double factor = 1.0;

  Json shown(double si) const { return number(si / factor); }
  Json shown(const std::vector<double>& si) const {
    Json list = Json::array();
    for (const double value : si) list.push_back(shown(value));
    return list;
  }
};

Axis axis_of(const std::string& symbol) {
  const auto unit = find_unit(symbol);
  expects(unit.has_value(), "results are shown in a unit of units()");
  return {symbol, unit->factor};
}

Axis argument_axis(const FunctionBand& band, const DisplayUnits& units) {
  Axis axis = axis_of(units.motion);
  if (band.function == "g_inverse") axis.symbol += "/s";
  return axis;
}

Axis value_axis(const FunctionBand& band, const DisplayUnits& units) {
  return band.function == "h" ? axis_of("1") : axis_of(units.effort);
}

Json to_json(const FunctionBand& band, const DisplayUnits& units) {
  const Axis x = argument_axis(band, units);
  const Axis y = value_axis(band, units);
  return {{"function", band.function},
          {"unit_argument", x.symbol},
          {"unit_value", y.symbol},
          {"argument", x.shown(band.argument)},
          {"value", y.shown(band.value)},
          {"lower", y.shown(band.lower)},
          {"upper", y.shown(band.upper)},
          {"valid_from", x.shown(band.valid_from)},
          {"valid_to", x.shown(band.valid_to)}};
}

Json domain(const FunctionBand& band, const DisplayUnits& units) {
  const Axis x = argument_axis(band, units);
  return {{"from", x.shown(band.valid_from)}, {"to", x.shown(band.valid_to)}, {"unit", x.symbol}};
}

Json to_json(const ParameterEstimate& parameter) {
  return {{"name", parameter.name},
          {"value", number(parameter.value)},
          {"std", number(parameter.std)},
          {"ci95", Json::array({number(parameter.ci95_lower), number(parameter.ci95_upper)})},
          {"unit", parameter.unit},
          {"bound_active", parameter.bound_active}};
}

Json to_json(const Identifiability& identifiability) {
  Json absorbed = Json::array();
  for (const Absorbed& one : identifiability.absorbed) {
    absorbed.push_back(
        {{"parameter", one.parameter}, {"by", one.by}, {"cosine", number(one.cosine)}});
  }
  return {{"condition", number(identifiability.condition)},
          {"absorbed", std::move(absorbed)},
          {"verdict", identifiability.verdict},
          {"says", identifiability.says}};
}

/// By recording; what no split was said of has been fitted.
Json rmse(const std::vector<RecordingFit>& fits) {
  Json json = {{"train", Json::object()}, {"holdout", Json::object()}};
  for (const RecordingFit& fit : fits) {
    json[fit.split == Split::holdout ? "holdout" : "train"][fit.id] = number(fit.rmse);
  }
  return json;
}

}  // namespace

Json to_json(const std::vector<ParameterEstimate>& parameters) {
  Json list = Json::array();
  for (const ParameterEstimate& one : parameters) list.push_back(to_json(one));
  return list;
}

Json to_json(const Estimate& estimate, const DisplayUnits& units) {
  Json domains = Json::object();
  Json bands = Json::array();
  for (const FunctionBand& band : estimate.bands) {
    domains[band.function] = domain(band, units);
    bands.push_back(to_json(band, units));
  }
  return {{"schema", "flexspline-estimate/1"},
          {"estimator", estimate.estimator},
          {"model", to_json(estimate.model)},
          {"parameters", to_json(estimate.parameters)},
          {"termination", name_of(estimate.termination)},
          {"cost", number(estimate.cost)},
          {"residual", estimate.residual},
          {"rmse", rmse(estimate.fits)},
          {"identifiability", to_json(estimate.identifiability)},
          {"domain_of_validity", std::move(domains)},
          {"bands", std::move(bands)},
          {"notes", estimate.notes},
          {"seconds", number(estimate.seconds)},
          {"evaluations", estimate.evaluations}};
}

}  // namespace flexspline::data
