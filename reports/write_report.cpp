#include <algorithm>
#include <functional>
#include <set>

#include "document_json.hpp"
#include "flexspline/core/in_parallel.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/reports/diagnosis_view.hpp"
#include "flexspline/reports/report.hpp"
#include "flexspline/reports/section.hpp"
#include "flexspline/reports/trial_view.hpp"
#include "flexspline/reports/verification_view.hpp"
#include "lock_file.hpp"
#include "page.hpp"
#include "static_figures.hpp"
#include "summary_sheet.hpp"

namespace flexspline::reports {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPage = "report/index.html";
constexpr const char* kGeneralTitle = "Harmonic drive hysteresis: how good the fits are";

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

/// What the rows of a catalogue of sections draw of a view, in their order.
template <class Row, class View>
Document compose(std::string title, std::span<const Row> catalogue, const View& view) {
  std::vector<Row> rows(catalogue.begin(), catalogue.end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.order < b.order; });
  Document document{std::move(title), {}};
  for (const Row& row : rows) {
    if (auto section = row.draw(view)) document.sections.push_back(std::move(*section));
  }
  make_table_ids_unique(document.sections);
  return document;
}

/// A report, and where its page lies in the folder.
struct Composed {
  Document document;
  fs::path page;
  std::vector<std::string> left_out{};
  /// One printed page of it, given the folder of static figures; may be none.
  std::function<std::string(const fs::path& figures)> summary{};
};

constexpr const char* kSummary = "summary.html";  // beside the page

Result<Composed> of_diagnosis(const fs::path& folder) {
  const auto view = read_diagnosis(folder);
  if (!view) return tl::unexpected(view.error());
  Document document = compose("Diagnosis of " + view->dataset, diagnosis_sections(), *view);
  document.summary = kSummary;
  return Composed{std::move(document), "index.html", {}, [view = *view](const fs::path& figures) {
                    return summary_sheet(view, figures);
                  }};
}

Result<Composed> of_trial(const fs::path& folder) {
  const auto view = read_trial(folder);
  if (!view) return tl::unexpected(view.error());
  const std::string title = view->title.empty() ? "Blind trial " + view->name : view->title;
  return Composed{compose(title, trial_sections(), *view), kPage};
}

Result<Composed> of_verification(const fs::path& folder) {
  const auto view = read_verification(folder);
  if (!view) return tl::unexpected(view.error());
  return Composed{
      compose("Does it come out again? " + view->folder, verification_sections(), *view),
      "index.html"};
}

Result<Composed> of_study(const fs::path& folder) {
  auto artefacts = read_artefacts(folder);
  if (!artefacts) return tl::unexpected(artefacts.error());
  const std::string title = parse_lock(artefacts->lock).title;
  const StudyView view(std::move(*artefacts));
  return Composed{compose(title.empty() ? kGeneralTitle : title, sections(), view), kPage,
                  view.artefacts().unreadable};
}

Result<Composed> of_folder(const fs::path& folder) {
  if (file_exists(folder / "diagnosis.json")) return of_diagnosis(folder);
  if (file_exists(folder / "trial.json")) return of_trial(folder);
  if (file_exists(folder / "verification.json")) return of_verification(folder);
  return of_study(folder);
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

Result<WrittenReport> write_report(const fs::path& folder) {
  const auto report = of_folder(folder);
  if (!report) return tl::unexpected(in_context(report.error(), "report"));
  const Document& document = report->document;
  const fs::path page = folder / report->page;
  const fs::path pictures = folder / "report" / "figures";
  const std::string figures = figures_json(document);
  std::string html;
  Result<void> others, drawn;
  // Node draws while the rest is put together; the page is written when all it links to is there.
  in_parallel(2, 2, [&](std::size_t part) {
    if (part == 0) {
      drawn = write_static_figures(pictures, figures);
      return;
    }
    html = page_of(document, figures);
    others = write_tables(folder / "tables", document).and_then([&] {
      return write_file(folder / "report" / "report.json", report_json(document));
    });
  });
  const auto written =
      others.and_then([&] { return drawn; })
          .and_then([&]() -> Result<void> {
            if (!report->summary) return {};
            return write_file(page.parent_path() / kSummary, report->summary(pictures));
          })
          .and_then([&] { return write_file(page, html); });
  if (!written) return tl::unexpected(in_context(written.error(), "report"));
  return WrittenReport{page, report->left_out};
}

}  // namespace flexspline::reports
