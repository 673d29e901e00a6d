#include "config/toml_root.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/nesting.hpp"
#include "flexspline/core/write_file.hpp"

namespace flexspline::studies {
namespace {

bool earlier(const data::Finding& a, const data::Finding& b) {
  return std::pair(a.line, a.column) < std::pair(b.line, b.column);
}

}  // namespace

Result<std::vector<data::Finding>> read_toml_root(const std::filesystem::path& file,
                                                  const std::function<void(TomlSection&)>& read) {
  const Result<std::string> content = read_file(file);
  if (!content) return tl::unexpected(content.error());
  return read_toml_text(*content, file, read);
}

std::vector<data::Finding> read_toml_text(const std::string& text,
                                          const std::filesystem::path& file,
                                          const std::function<void(TomlSection&)>& read) {
  std::vector<data::Finding> findings;
  if (const auto flat = check_nesting(text); !flat) {
    findings.push_back({file.string(), 0, 0, flat.error().problem, flat.error().remedy});
    return findings;
  }
  try {
    const toml::table parsed = toml::parse(text, file.string());
    TomlSection root(parsed, "", file.string(), findings);
    read(root);
    std::ranges::stable_sort(findings, earlier);
  } catch (const toml::parse_error& error) {
    findings.push_back({.file = file.string(),
                        .line = static_cast<int>(error.source().begin.line),
                        .column = static_cast<int>(error.source().begin.column),
                        .problem = std::string(error.description()),
                        .remedy = "the file is not TOML 1.0 from here on"});
  }
  return findings;
}

void check_schema(TomlSection& root, std::string_view schema) {
  const std::string given = root.required_text("schema");
  if (given.empty() || given == schema) return;
  root.refuse("schema", fmt::format("schema \"{}\" is not known", given),
              fmt::format("write schema = \"{}\"", schema));
}

Error as_error(const std::vector<data::Finding>& findings) {
  std::string text;
  for (const data::Finding& finding : findings) {
    if (!text.empty()) text += '\n';
    text += finding.message();
  }
  return {ErrorCode::bad_data, std::move(text), {}, {}};
}

}  // namespace flexspline::studies
