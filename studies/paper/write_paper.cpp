#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "flexspline/studies/paper_facts.hpp"
#include "paper/odd_polynomial.hpp"
#include "paper/paper_figures.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json facts_json() {
  ordered_json list = ordered_json::array();
  for (const PaperFact& fact : paper_facts()) {
    list.push_back({{"id", fact.id},
                    {"says", fact.says},
                    {"value", fact.value},
                    {"unit", fact.unit},
                    {"published", fact.published},
                    {"digits", fact.digits}});
  }
  return list;
}

void add_coefficients(ordered_json& table, char letter, const std::string& argument,
                      const OddPolynomial& published, const std::array<Recovered, 5>& recovered) {
  for (std::size_t k = 0; k < recovered.size(); ++k) {
    const std::string power = k == 0 ? "" : fmt::format("^{}", 2 * k + 1);
    table.push_back({{"name", fmt::format("{}{}", letter, k + 1)},
                     {"unit", fmt::format("Nm/{}{}", argument, power)},
                     {"published", published.coefficients[k]},
                     {"recovered", recovered[k].value},
                     {"std", recovered[k].std}});
  }
}

ordered_json table_two() {
  const auto row = [](const char* name, const char* value, const char* unit) {
    return ordered_json{{"name", name}, {"value", value}, {"unit", unit}};
  };
  ordered_json table = ordered_json::array();
  table.push_back(row("Gear rated output torque", "226", "Nm"));
  table.push_back(row("Gear maximum input speed", "2800", "rpm"));
  table.push_back(row("Gear reduction ratio", "50", "1"));
  table.push_back(row("Wave generator inertia", "0.436e-3", "kg m2 (unit missing in print)"));
  table.push_back(row("Motor rated output torque", "3.8", "Nm"));
  table.push_back(row("Motor rated speed", "4000", "rpm"));
  table.push_back(row("Motor inertia", "0.29e-3", "kg m2"));
  return table;
}

}  // namespace

Result<void> write_paper(const StudyConfig& study, const std::string& depends_on,
                         const std::filesystem::path& file) {
  const Result<PaperExperiment> experiment = repeat_experiment(study);
  if (!experiment) return tl::unexpected(in_context(experiment.error(), "the paper's experiment"));
  const Estimate& estimate = experiment->estimate;
  ordered_json table_one = ordered_json::array();
  add_coefficients(table_one, 'a', "deg", kStiffness, recovered_coefficients(estimate, 'a'));
  add_coefficients(table_one, 'b', "(deg/s)", kDamping, recovered_coefficients(estimate, 'b'));
  return data::write_artefact(file, {{"schema", "flexspline-paper/1"},
                                     {"depends_on", depends_on},
                                     {"facts", facts_json()},
                                     {"table_1", table_one},
                                     {"table_2", table_two()},
                                     {"figures", paper_figures(*experiment)}});
}

}  // namespace flexspline::studies
