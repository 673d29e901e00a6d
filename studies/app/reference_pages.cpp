#include "reference_pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catalogue_text.hpp"
#include "embedded_text.hpp"
#include "flexspline/core/write_file.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kOrigin =
    "<!-- Written by `flexspline list reference --pages docs/reference`; change the row, not this. "
    "-->";
constexpr int kDeepest = 6;  // of nested tables

/// In a cell of a table: one line, no bar.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '\\');
  }
  return text;
}

std::string code(const std::string& text) { return "`" + text + "`"; }

std::string option_row(const ordered_json& one) {
  const std::string takes = one.contains("choices")
                                ? words(one.at("choices"))
                                : fmt::format("{} to {}; {}", words(one.at("from")),
                                              words(one.at("to")), words(one.at("default")));
  return fmt::format("| {} | {} | {} |\n", code(words(one.at("name"))), cell(words(one.at("says"))),
                     cell(takes));
}

std::string argument_row(const ordered_json& one) {
  std::string takes = words(one.at("takes"));
  if (one.at("required").get<bool>()) takes += ", required";
  if (one.at("repeats").get<bool>()) takes += ", repeats";
  return fmt::format("| {} | {} | {} |\n", code(words(one.at("name"))), cell(words(one.at("says"))),
                     cell(takes));
}

std::string constant_row(const ordered_json& one) {
  return fmt::format("| {} | {} | {} |\n", code(words(one.at("name"))), cell(words(one.at("says"))),
                     words(one.at("unit")));
}

std::string verdict_row(const ordered_json& one) {
  return fmt::format("| {} | {} | {} |\n", code(words(one.at("code"))), words(one.at("severity")),
                     cell(words(one.at("remedy"))));
}

struct List {
  const char* key;
  const char* head;
  std::string (*row)(const ordered_json&);
};

constexpr List kLists[] = {{"options", "| option | meaning | range; default |", option_row},
                           {"arguments", "| argument | meaning | takes |", argument_row},
                           {"constants", "| constant | meaning | unit |", constant_row},
                           {"verdicts", "| code | severity | remedy |", verdict_row}};

std::string lists_of(const ordered_json& row) {
  std::string text;
  for (const List& list : kLists) {
    if (!row.contains(list.key) || row.at(list.key).empty()) continue;
    text += fmt::format("\n{}\n|---|---|---|\n", list.head);
    for (const ordered_json& one : row.at(list.key)) text += list.row(one);
  }
  return text;
}

/// What a row says beside its lists.
std::string facts_of(const ordered_json& row) {
  std::string text;
  for (const auto& [key, value] : row.items()) {
    if (key == "id" || key == "says" || key == "example" || value.is_object()) continue;
    if (value.is_array() && !value.empty() && value.front().is_object()) continue;
    if (value.empty() || words(value).empty()) continue;
    std::string name = key;
    for (char& c : name) c = c == '_' ? ' ' : c;
    text += fmt::format("\n{}: {}\n", name, words(value));
  }
  if (row.contains("example")) {
    text += fmt::format("\n```sh\n{}\n```\n", words(row.at("example")));
  }
  return text;
}

bool is_table(const ordered_json& rows) {
  for (const ordered_json& row : rows) {
    for (const char* key : {"arguments", "options", "forms", "verdicts"}) {
      if (row.contains(key)) return false;
    }
  }
  return true;
}

/// A schema's node behind its reference.
const ordered_json& resolved(const ordered_json& root, const ordered_json& node) {
  if (!node.contains("$ref")) return node;
  const std::string path = node.at("$ref").get<std::string>().substr(1);
  return root.at(ordered_json::json_pointer(path));
}

std::string type_of(const ordered_json& node) {
  std::string type = node.contains("enum")   ? words(node.at("enum"))
                     : node.contains("type") ? words(node.at("type"))
                                             : std::string("any");
  const auto bound = [&](const char* key, const char* sign) {
    if (node.contains(key)) type += fmt::format(" {} {}", sign, words(node.at(key)));
  };
  bound("minimum", "≥");
  bound("maximum", "≤");
  return type;
}

void add_keys(const ordered_json& root, const ordered_json& node, const std::string& prefix,
              int depth, std::string& text) {
  if (depth > kDeepest || !node.contains("properties")) return;
  for (const auto& [key, given] : node.at("properties").items()) {
    const ordered_json& one = resolved(root, given);
    std::string meaning = given.value("description", one.value("description", std::string()));
    text += fmt::format("| {} | {} | {} |\n", code(prefix + key), cell(type_of(one)),
                        cell(std::move(meaning)));
    add_keys(root, one, prefix + key + ".", depth + 1, text);
    if (one.contains("items")) {
      add_keys(root, resolved(root, one.at("items")), prefix + key + "[].", depth + 1, text);
    }
  }
}

Result<void> write_page(const std::filesystem::path& path, const std::string& text, bool force) {
  const auto there = read_file(path);
  if (there && !force && !there->starts_with(kOrigin)) {
    return failure(ErrorCode::cannot_write,
                   fmt::format("{} is not a page of the reference", path.string()),
                   "choose another folder, or add --force to replace it");
  }
  return write_file(path, text);
}

}  // namespace

std::string catalogue_page(std::string_view name, const ordered_json& rows) {
  std::string text = fmt::format("{}\n# Reference: {}\n\n`flexspline list {}`, from the code.\n",
                                 kOrigin, name, name);
  if (is_table(rows)) {
    text += "\n| id | what | more |\n|---|---|---|\n";
    for (const ordered_json& row : rows) {
      std::vector<std::string> more;
      for (const char* key : {"range", "source", "cases", "unit"}) {
        if (row.contains(key)) more.push_back(words(row.at(key)));
      }
      text +=
          fmt::format("| {} | {} | {} |\n", code(words(row.at("id"))), cell(words(row.at("says"))),
                      cell(fmt::format("{}", fmt::join(more, "; "))));
    }
    return text;
  }
  for (const ordered_json& row : rows) {
    text += fmt::format("\n## {}\n\n{}.\n{}{}", words(row.at("id")), words(row.at("says")),
                        facts_of(row), lists_of(row));
  }
  return text;
}

std::string formats_page() {
  std::string text = fmt::format(
      "{}\n# Reference: formats of files\n\nEvery key of configurations and artefacts, from the "
      "JSON schemas that `flexspline schema NAME` prints. `a.b` is key b of table a, `a[].b` of "
      "each entry of the list a.\n",
      kOrigin);
  for (const EmbeddedText& schema : schemas()) {
    const auto root = ordered_json::parse(schema.text);
    text += fmt::format("\n## {}\n\n{}\n\n| key | type | meaning |\n|---|---|---|\n", schema.name,
                        root.value("description", std::string()));
    add_keys(root, root, "", 0, text);
  }
  return text;
}

Result<void> write_reference(const std::filesystem::path& folder,
                             const std::map<std::string, ordered_json>& catalogues, bool force) {
  std::string index = fmt::format(
      "{}\n# Reference\n\nGenerated from the code.\n\n- [effects](../effects/README.md)\n"
      "- [formats of files](formats.md)\n",
      kOrigin);
  for (const auto& [name, rows] : catalogues) {
    index += fmt::format("- [{0}]({0}.md)\n", name);
    const auto done = write_page(folder / (name + ".md"), catalogue_page(name, rows), force);
    if (!done) return done;
  }
  return write_page(folder / "formats.md", formats_page(), force).and_then([&] {
    return write_page(folder / "README.md", index, force);
  });
}

}  // namespace flexspline::app
