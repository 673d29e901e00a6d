#include <cmath>

#include "flexspline/reports/section.hpp"

namespace flexspline::reports {
namespace {

Table inputs_table(const StudyView& view) {
  Table table{"inputs",
              "The inputs: virtual benches, whose truth is known, and data sets.",
              {{"id", "", 3},
               {"title", "", 3},
               {"kind", "", 3},
               {"recordings", "", 0},
               {"what it is", "", 3},
               {"source", "", 3},
               {"license", "", 3}},
              {}};
  for (const Input& input : view.artefacts().inputs) {
    table.rows.push_back({input.id, input.title, input.kind,
                          static_cast<double>(input.recordings.size()), input.says, input.source,
                          input.license});
  }
  return table;
}

std::string notes_of(const Case& item) {
  std::string notes;
  for (const std::string& note : item.notes) notes += (notes.empty() ? "" : "; ") + note;
  return notes;
}

Table cases_table(const StudyView& view) {
  Table table{"cases",
              "Every case: how it ended, and what to know before believing it.",
              {{"case", "", 3},
               {"method", "", 3},
               {"loops trained on", "", 0},
               {"status", "", 3},
               {"ended", "", 3},
               {"notes, or why it failed", "", 3}},
              {}};
  for (const Case& item : view.artefacts().cases) {
    table.rows.push_back({item.key, item.method, static_cast<double>(item.train.size()),
                          item.failed ? "failed" : "done", item.termination,
                          item.failed ? item.failure : notes_of(item)});
  }
  return table;
}

constexpr const char* kCommands =
    "# in the study's folder: draw this page again from the artefacts alone\n"
    "flexspline report .\n"
    "# compute everything again, with the configuration and seeds of study.lock.toml\n"
    "flexspline run STUDY.toml --out AGAIN";

std::optional<Section> draw(const StudyView& view) {
  const Artefacts& artefacts = view.artefacts();
  Section section{"provenance-section", "Where this comes from, and how to get it again", {}};
  section.add(Listing{kCommands});
  if (!artefacts.inputs.empty()) section.fold("Inputs", inputs_table(view));
  if (!artefacts.cases.empty()) section.fold("Cases", cases_table(view));
  if (!artefacts.lock.empty()) section.fold("study.lock.toml", Listing{artefacts.lock});
  return section;
}

}  // namespace

SectionRow describe_provenance() { return {70, draw}; }

}  // namespace flexspline::reports
