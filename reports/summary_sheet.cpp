#include "summary_sheet.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"
#include "numbers.hpp"
#include "page.hpp"

namespace flexspline::reports {
namespace {

constexpr std::size_t kMostCauses = 5;

constexpr const char* kStyle = R"(
@page { size: A4; margin: 12mm 14mm; }
* { box-sizing: border-box; }
body { font: 9.5pt/1.3 system-ui, "DejaVu Sans", sans-serif; color: #000; margin: 0 auto; width: 182mm; }
h1 { font-size: 13pt; margin: 0 0 1mm; }
p { margin: 0 0 1.5mm; }
.verdict { font-size: 10.5pt; font-weight: 600; border-left: 1mm solid #000; padding-left: 2.5mm; margin: 2mm 0; }
table { border-collapse: collapse; width: 100%; margin: 1mm 0 2mm; font-size: 8.5pt; }
th, td { text-align: left; padding: 0.6mm 1.5mm; border-bottom: 0.2mm solid #999; overflow-wrap: anywhere; }
.n { text-align: right; white-space: nowrap; max-width: 40mm; overflow: hidden; text-overflow: ellipsis; }
figure { margin: 0 0 1mm; break-inside: avoid; }
figcaption { font-size: 8pt; color: #333; }
figure > svg { display: block; margin: 0 auto; }
.tall > svg { width: 182mm; height: 56mm; }
.flat > svg { width: 182mm; height: 42mm; }
.origin { font-size: 7.5pt; color: #333; overflow-wrap: anywhere; }
@media screen { body { padding: 8mm 0; } }
@media screen and (max-width: 190mm) {
  body { width: auto; padding: 4mm; }
  table { display: block; overflow-x: auto; }
  .tall > svg, .flat > svg { width: 100%; height: auto; }
  th:not(.n), td:not(.n) { min-width: 9em; }
}
)";

std::string row(const ShownCause& cause) {
  std::string others;
  for (const std::string& one : cause.alternatives) {
    others += (others.empty() ? "" : ", ") + words(one);
  }
  return fmt::format(
      "<tr><td>{}</td><td class=\"n\">{} {}</td><td class=\"n\">{} %</td><td class=\"n\">{}</td>"
      "<td class=\"n\">{}</td><td>{}</td></tr>\n",
      escaped(words(cause.effect)), digits(cause.size, 3), escaped(cause.unit),
      digits(100.0 * cause.size_fraction, 2), digits(cause.probability, 2),
      digits(cause.holdout_ratio, 2), escaped(others.empty() ? "–" : others));
}

std::string causes_html(const DiagnosisView& view) {
  if (view.causes.empty()) return {};
  std::string html =
      "<table><thead><tr><th>missing physics</th><th class=\"n\">size</th><th class=\"n\">of the "
      "largest torque</th><th class=\"n\">weight</th><th class=\"n\">hold-out ratio</th>"
      "<th>could as well be</th></tr></thead><tbody>\n";
  const std::size_t shown = std::min(kMostCauses, view.causes.size());
  for (std::size_t i = 0; i < shown; ++i) html += row(view.causes[i]);
  html += "</tbody></table>\n";
  if (shown < view.causes.size()) {
    html += fmt::format("<p>{} more on the page.</p>\n", view.causes.size() - shown);
  }
  return html;
}

std::string in_unit(const DiagnosisView& view, double value) {
  return digits(value, 3) + " " + view.rmse_unit;
}

std::string errors_html(const DiagnosisView& view) {
  if (!std::isfinite(view.before)) return {};
  return fmt::format(
      "<p>Torque error (rms) {}: {} by the baseline ({}), {} with what was found, {} times as "
      "much "
      "(95 %: {} to {}). Noise: {}.</p>\n",
      view.how_held_out(), in_unit(view, view.before), escaped(view.baseline),
      in_unit(view, view.after), digits(view.ratio, 2), digits(view.ratio_lower, 2),
      digits(view.ratio_upper, 2), in_unit(view, view.noise_floor));
}

std::string figure_html(const std::filesystem::path& folder, const char* id,
                        std::string_view caption, const char* style) {
  const auto svg = read_file(folder / (std::string(id) + ".svg"));
  if (!svg) return {};
  return fmt::format("<figure class=\"{}\">{}<figcaption>{}</figcaption></figure>\n", style, *svg,
                     caption);
}

std::string figures_html(const std::filesystem::path& folder) {
  const std::string loop =
      figure_html(folder, "headline",
                  "Figure 1. Loop of one recording: measured (wide) and modelled, without and with "
                  "the missing physics, on equal axes.",
                  "tall");
  const std::string residual =
      figure_html(folder, "remainder", "Figure 2. Residual, measured minus modelled.", "tall");
  const std::string errors =
      figure_html(folder, "before-after", "Figure 3. Residual rms of every recording.", "flat");
  if (loop.empty() && residual.empty() && errors.empty()) {
    return "<p>Figures are drawn by node, which is not installed here.</p>\n";
  }
  return loop + residual + errors;
}

std::string next_html(const DiagnosisView& view) {
  if (!view.next || view.next->says.empty()) return {};
  return "<p>Record next: " + escaped(view.next->says) + "</p>\n";
}

std::string origin_html(const DiagnosisView& view) {
  const auto version = view.versions.find("flexspline");
  return fmt::format(
      "<p class=\"origin\">Data set {}, SHA-256 {}; flexspline {}. Method and limits: "
      "index.html beside this sheet.</p>\n",
      escaped(view.dataset), escaped(view.sha256),
      version == view.versions.end() ? "–" : escaped(version->second));
}

}  // namespace

std::string summary_sheet(const DiagnosisView& view, const std::filesystem::path& figures) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Summary: diagnosis of {0}</title>\n<style>{1}</style>\n</head>\n<body>\n"
      "<h1>Diagnosis of {0}</h1>\n<p class=\"verdict\">{2}</p>\n{3}{4}{5}{6}{7}</body>\n</html>\n",
      escaped(view.dataset), kStyle,
      escaped(view.says.empty() ? words(view.verdict) : sentence(view.says)), errors_html(view),
      causes_html(view), figures_html(figures), next_html(view), origin_html(view));
}

}  // namespace flexspline::reports
