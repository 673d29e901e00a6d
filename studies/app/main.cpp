#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>

#include <fmt/format.h>

#include "command.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

std::string bare(std::string_view name) {
  return std::string(name.substr(name.find_first_not_of('-')));
}

/// Values as CLI11 stores them, one slot an argument of a command.
struct Slot {
  const ArgumentInfo* info;
  std::vector<std::string> values;
  CLI::Option* option = nullptr;
};

void add_argument(CLI::App& sub, Slot& slot) {
  const ArgumentInfo& info = *slot.info;
  slot.option = sub.add_option(std::string(info.name), slot.values, std::string(info.meaning));
  slot.option->type_name(std::string(info.value))->required(info.required);
  slot.option->expected(1)->multi_option_policy(info.repeats ? CLI::MultiOptionPolicy::TakeAll
                                                             : CLI::MultiOptionPolicy::Throw);
  slot.option->allow_extra_args(false);  // what follows is the next position's
}

/// A command with the parser that reads its arguments.
struct Parser {
  const CommandRow* row;
  CLI::App* sub = nullptr;
  std::vector<Slot> slots;
};

std::vector<Parser> add_commands(CLI::App& app) {
  std::vector<Parser> parsers;
  for (const CommandRow& row : commands()) {
    Parser& parser = parsers.emplace_back(Parser{&row, nullptr, {}});
    parser.sub = app.add_subcommand(std::string(row.id), std::string(row.summary));
    parser.sub->footer(fmt::format("Example: {}", row.example));
    for (const ArgumentInfo& info : row.arguments) parser.slots.push_back({&info, {}, nullptr});
    for (Slot& slot : parser.slots) add_argument(*parser.sub, slot);
  }
  return parsers;
}

Arguments collect(const Parser& parser) {
  Arguments arguments;
  for (const Slot& slot : parser.slots) {
    if (slot.option->count() > 0) arguments.set(bare(slot.info->name), slot.values);
  }
  return arguments;
}

ExitCode run(const Parser& parser, Console& console) {
  const Result<ExitCode> done = parser.row->run(collect(parser), console);
  if (done) return *done;
  console.error(done.error().message());
  return static_cast<ExitCode>(done.error().code);
}

std::string command_help(const std::string& given) {
  std::vector<std::string_view> names;
  for (const CommandRow& row : commands()) names.push_back(row.id);
  return fmt::format("there is no command '{}'; {}", given, suggestion(given, names));
}

ExitCode refuse(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == 0) return app.exit(error);
  Console console;
  const std::string first = argc > 1 ? argv[1] : "";
  const bool known = first.starts_with('-') ||
                     std::ranges::find(commands(), first, &CommandRow::id) != commands().end();
  console.error(known || first.empty() ? error.what() : command_help(first));
  console.error(
      fmt::format("see flexspline {}--help", known && !first.starts_with('-') ? first + " " : ""));
  return static_cast<ExitCode>(ErrorCode::usage);
}

ExitCode parse_and_run(int argc, char** argv) {
  CLI::App app("Identification and diagnosis of harmonic drive hysteresis", "flexspline");
  Console console;
  app.set_version_flag("--version", version_text());
  app.add_flag("--json", console.json, "Results as JSON");
  app.add_flag("--quiet", console.quiet, "Errors only on stderr");
  app.add_flag("-v,--verbose", console.verbosity, "More on stderr");
  app.require_subcommand(1)->fallthrough();
  const std::vector<Parser> parsers = add_commands(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return refuse(app, error, argc, argv);
  }
  for (const Parser& parser : parsers) {
    if (parser.sub->parsed()) return run(parser, console);
  }
  return static_cast<ExitCode>(ErrorCode::usage);
}

}  // namespace
}  // namespace flexspline::app

int main(int argc, char** argv) {
  try {
    return flexspline::app::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    flexspline::app::Console().error(fmt::format("a defect of ours: {}", error.what()));
    return static_cast<int>(flexspline::ErrorCode::defect);
  }
}
