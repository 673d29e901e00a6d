#include "flexspline/reports/diagnosis_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

constexpr const char* kCommands =
    "# compute it again and compare\n"
    "flexspline verify DIR --dataset DATASET\n"
    "# draw this page again from diagnosis.json alone\n"
    "flexspline report DIR";

constexpr const char* kSimulate =
    "\n# simulate with what was found\n"
    "flexspline simulate DIR/model.toml --like DATASET --out SIMULATED";

std::optional<Section> draw(const DiagnosisView& view) {
  Section section{"provenance-section", "Where this comes from, and how to get it again", {}};
  for (const std::string& note : view.notes) section.add(Paragraph{note});
  section.add(Listing{view.has_model ? std::string(kCommands) + kSimulate : kCommands});
  Table table{"provenance",
              "The checksum is that of what the recordings say, not of their names.",
              {{"what", "", 3}, {"value", "", 3}},
              {}};
  table.rows.push_back({"data set", view.dataset});
  table.rows.push_back({"SHA-256 of its content", view.sha256});
  table.rows.push_back({"baseline", view.baseline});
  for (const auto& [name, version] : view.versions) table.rows.push_back({name, version});
  section.add(std::move(table));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_diagnosis_provenance() { return {70, draw}; }

}  // namespace flexspline::reports
