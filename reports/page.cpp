#include "page.hpp"

#include <algorithm>

#include "flexspline/reports/equation.hpp"
#include "packed.hpp"

namespace flexspline::reports {
namespace {

std::string cell_html(const char* tag, bool numeric, const std::string& text) {
  const std::string open =
      numeric ? std::string("<") + tag + " class=\"n\">" : std::string("<") + tag + ">";
  return open + escaped(text) + "</" + tag + ">";
}

std::string head_html(const Table& table) {
  std::string names = "<tr>", units = "<tr class=\"units\">";
  bool has_units = false;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    names += cell_html("th", is_numeric(table, i), table.columns[i].name);
    units += cell_html("td", is_numeric(table, i), table.columns[i].unit);
    has_units = has_units || !table.columns[i].unit.empty();
  }
  return "<thead>" + names + "</tr>" + (has_units ? units + "</tr>" : "") + "</thead>";
}

/// The first cell of a row that repeats the one above is left blank, so that groups are seen.
std::string rows_html(const Table& table) {
  std::string html = "<tbody>";
  std::string above;
  for (const auto& row : table.rows) {
    const std::string first = shown(row.front(), table.columns.front());
    const bool repeats = first == above;
    html += repeats ? "<tr>" : "<tr class=\"first\">";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool numeric = std::holds_alternative<double>(row[i]);
      if (i == 0 && repeats) {
        html += "<th scope=\"row\"><span class=\"again\">" + escaped(first) + "</span></th>";
      } else if (i == 0) {
        html += "<th scope=\"row\">" + escaped(first) + "</th>";
      } else {
        html += cell_html("td", numeric, shown(row[i], table.columns[i]));
      }
    }
    html += "</tr>";
    above = first;
  }
  return html + "</tbody>";
}

struct ContentHtml {
  std::string operator()(const Verdict& verdict) const {
    return "<p class=\"verdict\">" + escaped(verdict.text) + "</p>\n";
  }
  std::string operator()(const Paragraph& paragraph) const {
    return "<p>" + escaped(paragraph.text) + "</p>\n";
  }
  std::string operator()(const Heading& heading) const {
    return "<h3>" + escaped(heading.text) + "</h3>\n";
  }
  std::string operator()(const Listing& listing) const {
    return "<pre tabindex=\"0\"><code>" + escaped(listing.text) + "</code></pre>\n";
  }
  std::string operator()(const Equation& equation) const {
    return "<div class=\"equation\" tabindex=\"0\">" + mathml_of(equation.text) + "</div>\n";
  }
  std::string operator()(const Table& table) const {
    const std::string named = "aria-labelledby=\"caption-" + table.id + "\"";
    return "<p class=\"caption\" id=\"caption-" + table.id + "\">" + escaped(table.caption) +
           " <span class=\"files\">tables/" + table.id + ".csv, .md, .tex</span></p>\n" +
           "<div class=\"table\" tabindex=\"0\" role=\"region\" " + named + "><table " + named +
           ">" + head_html(table) + rows_html(table) + "</table></div>\n";
  }
  std::string operator()(const Figure& figure) const {
    return "<figure id=\"figure-" + escaped(figure.id) + "\" data-figure=\"" + escaped(figure.id) +
           "\"><h3>" + escaped(figure.title) + "</h3><div class=\"controls\"></div>" +
           "<div class=\"panels\" role=\"group\" aria-label=\"" + escaped(figure.alt) +
           "\"></div><figcaption>" + escaped(figure.caption) + "</figcaption></figure>\n";
  }
};

/// A figure that is one small picture may stand beside its neighbour.
bool is_small(const Block& block) {
  const auto* figure = std::get_if<Figure>(&block.content);
  return figure != nullptr && block.folded_under.empty() && figure->frames.size() == 1 &&
         figure->frames.front().panels.size() == 1;
}

/// Opens and closes what neighbouring blocks share: a row of small figures, or a fold.
class Wrapping {
 public:
  std::string before(const Block& block) {
    const std::string wanted =
        is_small(block) ? "<div class=\"row\">\n"
        : block.folded_under.empty()
            ? std::string{}
            : "<details><summary>" + escaped(block.folded_under) + "</summary>\n";
    if (wanted == open_) return {};
    const std::string html = close() + wanted;
    open_ = wanted;
    return html;
  }

  std::string close() {
    const std::string html = open_.empty()               ? ""
                             : open_.starts_with("<div") ? "</div>\n"
                                                         : "</details>\n";
    open_.clear();
    return html;
  }

 private:
  std::string open_;
};

std::string blocks_html(const std::vector<Block>& blocks) {
  std::string html;
  Wrapping wrapping;
  for (const Block& block : blocks) {
    html += wrapping.before(block) + std::visit(ContentHtml{}, block.content);
  }
  return html + wrapping.close();
}

std::string links_html(const std::vector<Section>& sections) {
  std::string html = "<nav aria-label=\"Sections\"><ol>";
  for (const Section& section : sections) {
    if (&section == &sections.front()) continue;
    html += "<li><a href=\"#" + section.id + "\">" + escaped(section.title) + "</a></li>";
  }
  return html + "</ol></nav>\n";
}

constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
    "blob:";

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += letter;
    }
  }
  return html;
}

std::string page_of(const Document& document, std::string_view figures) {
  std::string html = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  html += "<meta name=\"color-scheme\" content=\"light dark\">\n";
  html +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"" + std::string(kPolicy) + "\">\n";
  html += "<title>" + escaped(document.title) + "</title>\n<style>" + page_style() + "</style>\n";
  html += "</head>\n<body>\n<main>\n<h1>" + escaped(document.title) + "</h1>\n";
  if (!document.summary.empty()) {
    html += "<p class=\"summary\"><a href=\"" + document.summary +
            "\">Summary on one page, for print</a></p>\n";
  }
  html += "<noscript><p>The figures need JavaScript; text and tables do not.</p></noscript>\n";
  for (const Section& section : document.sections) {
    html += "<section id=\"" + section.id + "\">\n<h2>" + escaped(section.title) + "</h2>\n" +
            blocks_html(section.blocks) + "</section>\n";
    if (&section == &document.sections.front()) html += links_html(document.sections);
  }
  html += "</main>\n<script type=\"application/gzip\" id=\"figures\">" +
          packed(figures) + "</script>\n<script>" + page_script() +
          "</script>\n</body>\n</html>\n";
  return html;
}

}  // namespace flexspline::reports
