#include "import_wish.hpp"

#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/rig.hpp"
#include "flexspline/data/sanity_codes.hpp"

namespace flexspline::app {
namespace {

tl::unexpected<Error> refused(const std::string& problem, const std::string& remedy) {
  return failure(ErrorCode::usage, problem, remedy);
}

Result<double> positive(const Arguments& arguments, const std::string& name) {
  const std::string text = arguments.text(name);
  double value = 0.0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code == std::errc{} && stop == text.data() + text.size() && value > 0.0 && value < 1e12) {
    return value;
  }
  return refused(fmt::format("--{} is '{}'", name, text), "give a positive number");
}

Result<Rig> rig_of(const std::string& name) {
  if (const auto rig = find_rig(name)) return *rig;
  std::vector<std::string_view> names;
  for (const RigRow& row : rigs()) names.push_back(row.id);
  return refused(fmt::format("--rig: there is no rig '{}'", name), suggestion(name, names));
}

/// One character, or a word for one that a shell swallows.
Result<char> letter(const Arguments& arguments, const std::string& name, std::string_view allowed) {
  std::string text = arguments.text(name);
  if (text == "tab") text = "\t";
  if (text == "blank") text = " ";
  if (text.size() == 1 && allowed.find(text[0]) != allowed.npos) return text[0];
  return refused(fmt::format("--{} is '{}'", name, text),
                 name == "decimal" ? "give . or ," : "give ; , | tab or blank");
}

Result<void> take_text_form(const Arguments& arguments, data::TextForm& form) {
  if (arguments.has("delimiter")) {
    const auto mark = letter(arguments, "delimiter", ";,|\t ");
    if (!mark) return tl::unexpected(mark.error());
    form.delimiter = *mark;
  }
  if (arguments.has("decimal")) {
    const auto mark = letter(arguments, "decimal", ".,");
    if (!mark) return tl::unexpected(mark.error());
    form.decimal = *mark;
  }
  const auto line = arguments.integer("header-line", 0, 1, 100000);
  if (!line) return tl::unexpected(line.error());
  form.header_line = arguments.has("header-line") ? static_cast<int>(*line) : 0;
  return {};
}

Result<void> take_constants(const Arguments& arguments, std::map<std::string, double>& constants) {
  static constexpr std::pair<const char*, const char*> kOptions[] = {
      {"ratio", "gear_ratio"},
      {"motor-inertia", "motor_inertia_kgm2"},
      {"load-inertia", "load_inertia_kgm2"}};
  for (const auto& [option, key] : kOptions) {
    if (!arguments.has(option)) continue;
    const auto value = positive(arguments, option);
    if (!value) return tl::unexpected(value.error());
    constants[key] = *value;
  }
  return {};
}

}  // namespace

Result<data::ImportWish> import_wish(const Arguments& arguments) {
  data::ImportWish wish;
  for (const std::string& file : arguments.texts("files")) wish.files.emplace_back(file);
  if (arguments.has("rig")) {
    const auto rig = rig_of(arguments.text("rig"));
    if (!rig) return tl::unexpected(rig.error());
    wish.rig = *rig;
  }
  if (auto taken = take_constants(arguments, wish.constants); !taken)
    return tl::unexpected(taken.error());
  if (arguments.has("split")) {
    const auto seconds = positive(arguments, "split");
    if (!seconds) return tl::unexpected(seconds.error());
    wish.split_s = *seconds;
  }
  for (const std::string& text : arguments.texts("map")) {
    const auto choice = data::parse_column_choice(text);
    if (!choice) return tl::unexpected(choice.error());
    wish.choices.push_back(*choice);
  }
  for (const std::string& code : arguments.texts("accept")) {
    if (!data::is_sanity_code(code)) {
      return refused(fmt::format("--accept: there is no finding '{}'", code),
                     data::sanity_code_suggestion(code));
    }
    wish.accept.push_back(code);
  }
  wish.tables = arguments.texts("table");
  wish.join = arguments.has("join");
  const std::filesystem::path out = std::filesystem::path(arguments.text("out")) / "";
  wish.name = arguments.text("name", out.lexically_normal().parent_path().filename().string());
  wish.license = arguments.text("license");
  if (auto taken = take_text_form(arguments, wish.request.text); !taken)
    return tl::unexpected(taken.error());
  return wish;
}

}  // namespace flexspline::app
