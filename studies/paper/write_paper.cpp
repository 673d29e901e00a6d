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

/// As printed, beside what the virtual bench has; empty where it needs none.
ordered_json table_two() {
  const auto row = [](const char* name, const char* value, const char* ours, const char* unit,
                      const char* says) {
    return ordered_json{
        {"name", name}, {"value", value}, {"ours", ours}, {"unit", unit}, {"says", says}};
  };
  ordered_json table = ordered_json::array();
  table.push_back(row("Gear rated output torque", "226", "", "Nm", "the loop uses 7.3 % of it"));
  table.push_back(row("Gear maximum input speed", "2800", "", "rpm", ""));
  table.push_back(row("Gear reduction ratio", "50", "50", "1", ""));
  table.push_back(row("Wave generator inertia", "0.436e-3", "0.436e-3", "kg m2",
                      "printed without its unit: kg m2 is our reading"));
  table.push_back(row("Motor rated output torque", "3.8", "", "Nm", ""));
  table.push_back(row("Motor rated speed", "4000", "", "rpm", ""));
  table.push_back(row("Motor inertia", "0.29e-3", "0.29e-3", "kg m2", ""));
  return table;
}

/// What stands in the text and cannot be meant.
ordered_json slips() {
  const auto row = [](const char* where, const char* printed, const char* meant) {
    return ordered_json{{"where", where}, {"printed", printed}, {"meant", meant}};
  };
  ordered_json table = ordered_json::array();
  table.push_back(row("eq. (4)", "the torsion in g^-1 has no dot", "its rate, as in eq. (7)"));
  table.push_back(row("eqs. (15)-(19)", "same ordinate, horizontal distance",
                      "same torsion, vertical distance, with torque over torsion"));
  table.push_back(row("section 5", "the locus of Xd is g", "it is g^-1"));
  table.push_back(row("eqs. (20)-(25)", "nonlinear least squares",
                      "linear least squares: the coefficients enter linearly"));
  table.push_back(row("eq. (5)", "tau_f has no sign of speed", "friction opposes the motion"));
  table.push_back(row("friction at the wave generator", "static and sliding friction",
                      "the two are exchanged"));
  table.push_back(row("Table II", "wave generator inertia 0.436e-3", "in kg m2"));
  table.push_back(row("section 3", "f and g rise everywhere",
                      "to 118 % and 113.5 % of the range they were fitted on, no further"));
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
                                     {"slips", slips()},
                                     {"figures", paper_figures(*experiment)}});
}

}  // namespace flexspline::studies
