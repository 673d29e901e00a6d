#include <algorithm>
#include <set>

#include "document_json.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/reports/report.hpp"
#include "flexspline/reports/section.hpp"
#include "lock_file.hpp"
#include "page.hpp"

namespace flexspline::reports {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGeneralTitle = "Harmonic drive hysteresis: what the fits are worth";

/// Two inputs may differ in letters that a file name cannot hold.
void make_table_ids_unique(std::vector<Section>& sections) {
  std::set<std::string> taken;
  for (Section& section : sections) {
    for (Block& block : section.blocks) {
      auto* table = std::get_if<Table>(&block.content);
      if (table == nullptr) continue;
      const std::string id = table->id;
      for (int copy = 2; !taken.insert(table->id).second; ++copy) {
        table->id = id + "-" + std::to_string(copy);
      }
    }
  }
}

Document compose(Artefacts artefacts) {
  const std::string title = parse_lock(artefacts.lock).title;
  const StudyView view(std::move(artefacts));
  std::vector<SectionRow> rows(sections().begin(), sections().end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const SectionRow& a, const SectionRow& b) { return a.order < b.order; });
  Document document{title.empty() ? kGeneralTitle : title, {}};
  for (const SectionRow& row : rows) {
    if (auto section = row.draw(view)) document.sections.push_back(std::move(*section));
  }
  make_table_ids_unique(document.sections);
  return document;
}

Result<void> write_table(const fs::path& folder, const Table& table) {
  const fs::path base = folder / table.id;
  return write_file(base.string() + ".csv", csv_of(table))
      .and_then([&] { return write_file(base.string() + ".md", markdown_of(table)); })
      .and_then([&] { return write_file(base.string() + ".tex", latex_of(table)); });
}

Result<void> write_tables(const fs::path& folder, const Document& document) {
  for (const Section& section : document.sections) {
    for (const Block& block : section.blocks) {
      const auto* table = std::get_if<Table>(&block.content);
      if (table == nullptr) continue;
      if (auto written = write_table(folder, *table); !written) return written;
    }
  }
  return {};
}

}  // namespace

Result<fs::path> write_report(const fs::path& study_folder) {
  auto artefacts = read_artefacts(study_folder);
  if (!artefacts) return tl::unexpected(in_context(artefacts.error(), "report"));
  const Document document = compose(std::move(*artefacts));
  const fs::path page = study_folder / "report" / "index.html";
  const auto written =
      write_tables(study_folder / "tables", document)
          .and_then(
              [&] { return write_file(page.parent_path() / "report.json", report_json(document)); })
          .and_then([&] { return write_file(page, page_of(document)); });
  if (!written) return tl::unexpected(in_context(written.error(), "report"));
  return page;
}

}  // namespace flexspline::reports
