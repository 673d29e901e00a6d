#include "certified/ode_rows.hpp"

namespace flexspline::estimators {

std::vector<OdeParameter> rates(const std::string& kind, std::vector<double> starts,
                                const std::string& unit, double scale) {
  std::vector<OdeParameter> result;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    OdeParameter rate{.name = kind + std::to_string(k + 1)};
    rate.start = starts[k];
    rate.lower = 0.0;
    rate.scale = scale;
    rate.unit = unit;
    result.push_back(std::move(rate));
  }
  return result;
}

OdeExperiment fully_observed(std::string id, std::vector<double> initial, std::vector<double> times,
                             std::vector<double> measured) {
  OdeExperiment experiment{.id = std::move(id)};
  experiment.initial.assign(initial.begin(), initial.end());
  experiment.times = std::move(times);
  experiment.measured = std::move(measured);
  experiment.sigma.assign(initial.size(), 1.0);
  return experiment;
}

}  // namespace flexspline::estimators
