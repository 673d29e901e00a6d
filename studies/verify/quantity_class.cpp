#include "verify/quantity_class.hpp"

#include <algorithm>

namespace flexspline::studies {
namespace {

enum Class { kSeries, kCoefficients, kParameter, kError, kUncertainty, kCount, kOther };

struct KeyClass {
  std::string_view part;  ///< of the key
  Class of;
};

constexpr KeyClass kKeys[] = {{"rmse", kError},
                              {"error", kError},
                              {"cost", kError},
                              {"area", kError},
                              {"ratio", kError},
                              {"noise", kError},
                              {"std", kUncertainty},
                              {"ci95", kUncertainty},
                              {"condition", kUncertainty},
                              {"cosine", kUncertainty},
                              {"p_value", kUncertainty},
                              {"probability", kUncertainty},
                              {"similarity", kUncertainty},
                              {"sigma", kUncertainty},
                              {"bic", kUncertainty},
                              {"lower", kUncertainty},
                              {"upper", kUncertainty},
                              {"share", kUncertainty},
                              {"evaluations", kCount},
                              {"samples", kCount},
                              {"count", kCount},
                              {"value", kParameter},
                              {"before", kParameter},
                              {"after", kParameter}};

}  // namespace

const std::vector<QuantityClass>& quantity_classes() {
  static const std::vector<QuantityClass> classes = {
      {"series", 1e-6, 0.0, 0.05, "samples of a curve, of the largest of them"},
      {"coefficients", 1e-6, 0.0, 1.0, "of a model; parameters and curves are compared apart"},
      {"parameter", 1e-6, 1e-3, 1e-3,
       "estimates, with 4 standard deviations at the statistical level"},
      {"error", 1e-4, 0.0, 1.0, "misfits, costs, areas and their ratios"},
      {"uncertainty", 1e-2, 0.0, 2.0, "standard deviations, intervals, conditions, probabilities"},
      {"count", 0.1, 0.0, 2.0, "iterations and evaluations"},
      {"other", 1e-6, 0.0, 0.05, "everything else"}};
  return classes;
}

const QuantityClass& class_of(std::string_view key, bool listed) {
  if (key == "coefficients" || key == "numbers") return quantity_classes()[kCoefficients];
  if (listed && key != "ci95") return quantity_classes()[kSeries];
  const auto* found = std::ranges::find_if(
      kKeys, [&](const KeyClass& one) { return key.find(one.part) != std::string_view::npos; });
  return quantity_classes()[found == std::end(kKeys) ? kOther : found->of];
}

}  // namespace flexspline::studies
