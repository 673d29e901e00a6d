#include <fmt/format.h>

#include "command.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

/// Text for man(7): hyphens that are typed stay hyphens, backslashes and leading dots are not
/// macros.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  if (result.starts_with('.') || result.starts_with('\'')) result.insert(0, "\\&");
  return result;
}

std::string usage_of(const CommandRow& row) {
  std::string text = fmt::format("flexspline {}", row.id);
  for (const ArgumentInfo& one : row.arguments) {
    const std::string written = one.name.starts_with('-')
                                    ? fmt::format("{} {}", one.name, one.value)
                                    : std::string(one.value);
    text += one.required ? " " + written : " [" + written + "]";
    if (one.repeats) text += " ...";
  }
  return text;
}

std::string section_of(const CommandRow& row) {
  std::string text =
      fmt::format(".SS \"{}\"\n.B {}\n.PP\n{}.\n", row.id, roff(usage_of(row)), roff(row.summary));
  for (const ArgumentInfo& one : row.arguments) {
    text += fmt::format(".TP\n.BR \"{}\" \" {}\"\n{}\n", roff(one.name),
                        one.name.starts_with('-') ? roff(one.value) : "", roff(one.meaning));
  }
  return text + fmt::format(".PP\nExample:\n.PP\n.EX\n{}\n.EE\n", roff(row.example));
}

std::string page() {
  std::string text = fmt::format(
      ".TH FLEXSPLINE 1 \"\" \"flexspline {}\" \"User Commands\"\n.ad l\n.nh\n"
      ".SH NAME\nflexspline \\- identification and diagnosis of harmonic drive hysteresis\n"
      ".SH SYNOPSIS\n.B flexspline\n.I COMMAND\n[options]\n"
      ".SH DESCRIPTION\nFits the torsion law of Dhaouadi and Ghorbel (2003) to recordings of a "
      "gear, says how far the result can be trusted and what physics the model lacks, and draws a "
      "report. Results go to standard output, progress and messages to standard error.\n"
      ".SH OPTIONS\n.TP\n.B \\-\\-json\nresults as JSON\n.TP\n.B \\-\\-quiet\nerrors only on "
      "standard error\n.TP\n.B \\-v\nmore on standard error\n.TP\n.B \\-\\-color WHEN\ncolour "
      "of messages: auto, always, never\n.TP\n.B \\-\\-version\nprogram, "
      "commit, compiler and libraries\n.TP\n.B \\-\\-help\nof the program or of a command\n"
      ".SH COMMANDS\n",
      versions().at("flexspline"));
  for (const CommandRow& row : commands()) text += section_of(row);
  return text +
         ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 1\nfinished, but something in it failed or "
         "differs\n.TP\n.B 2\nusage\n.TP\n.B 65\nbad data or configuration\n.TP\n.B 66\ninput "
         "missing\n.TP\n.B 70\na defect of the program\n.TP\n.B 73\ncannot write\n.TP\n.B "
         "75\ninterrupted; the same command goes on\n"
         ".SH ENVIRONMENT\n.TP\n.B NO_COLOR\nif set, messages have no colour";
}

Result<ExitCode> run(const Arguments&, Console& console) {
  console.result(page());
  return kDone;
}

}  // namespace

CommandRow describe_manual() {
  return {.id = "manual",
          .group = "The program",
          .summary = "Prints the manual page of all commands, for man(1)",
          .arguments = {},
          .example = "flexspline manual > flexspline.1",
          .run = run};
}

}  // namespace flexspline::app
