// What each rule of the diagnosis buys: the cases of a trial, or data sets, diagnosed with all
// rules and without each (docs/decisions/0024). Of a trial it prints how many are right, of data
// sets every answer that differs.
//   flexspline_rule_ablation TRIAL.toml CASES SEED [RULE...]
//   flexspline_rule_ablation DATASET... [RULE...]
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "diagnosis/diagnosed.hpp"
#include "flexspline/core/in_parallel.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/studies/trial.hpp"

namespace flexspline::bench {
namespace {

using studies::CaseKind;
using studies::CaseScore;
using studies::ConcealedCase;
using studies::Limits;

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Rule {
  std::string name;
  std::function<void(Limits&)> without;
};

std::vector<Rule> rules() {
  return {
      {"all rules", [](Limits&) {}},
      {"named_gain", [](Limits& l) { l.named_gain = l.gain; }},
      {"half", [](Limits& l) { l.half = kNever; }},
      {"tenth", [](Limits& l) { l.tenth = l.shadow; }},
      {"shadow", [](Limits& l) { l.shadow = l.tenth = 0.0; }},
      {"quarter", [](Limits& l) { l.quarter = 1.0; }},
      {"probability", [](Limits& l) { l.probability = 0.0; }},
      {"incidents", [](Limits& l) { l.incidents = 0; }},
  };
}

bool is_right(const CaseScore& s) {
  switch (s.kind) {
    case CaseKind::null:
      return s.null_right;
    case CaseKind::single:
      return s.exact;
    case CaseKind::pair:
      return s.pair_both && s.false_names == 0;
    case CaseKind::contained:
      return s.contained_right;
    case CaseKind::incident:
      return s.incident_found && s.false_names == 0;
    default:
      return s.unknown_right;
  }
}

struct Answer {
  CaseScore score;
  std::string says;
};

std::string in_words(const Result<studies::Diagnosis>& d) {
  if (!d) return "failed";
  std::string text(studies::name_of(d->verdict));
  for (const auto& cause : d->causes) {
    text +=
        fmt::format(" {}({:.2f} p{:.2f} r{:.3f} m{:.3f} left{:.4f} alt{})", cause.effect,
                    cause.size_fraction, cause.probability, cause.evidence.holdout_rmse_ratio,
                    d->holdout.over_noise(), cause.evidence.left_over, cause.alternatives.size());
  }
  return text;
}

std::vector<Answer> answers(const std::vector<ConcealedCase>& cases, const Limits& limits) {
  std::vector<Answer> list(cases.size());
  in_parallel(cases.size(), 0, [&](std::size_t i) {
    const auto d =
        studies::diagnosed(cases[i].recordings, {}, {.threads = 1, .nested = false}, limits);
    list[i] = {studies::score_case(cases[i].answer, d ? &*d : nullptr), in_words(d)};
  });
  return list;
}

std::string hidden_in(const ConcealedCase& one) {
  std::string text = fmt::format("{} {}:", one.answer.generator, name_of(one.answer.rig));
  for (const auto& effect : one.answer.effects) {
    text += fmt::format(" {} {:.3f}", effect.id, effect.size_fraction);
  }
  for (const auto& other : one.answer.disturbances) text += " ~" + other.id;
  return text;
}

std::string names_in(const CaseScore& score) {
  std::string text;
  for (const auto& name : score.names) {
    text += fmt::format(" {}:{}", name.effect, name.right ? "right" : "false");
  }
  return text;
}

std::vector<ConcealedCase> cases_of(const studies::TrialConfig& trial) {
  std::vector<ConcealedCase> cases;
  for (const auto& one : studies::plan_trial(trial)) {
    auto concealed = studies::conceal(one.plan);
    if (concealed) cases.push_back(std::move(*concealed));
  }
  return cases;
}

void compare(const std::string& rule, const std::vector<ConcealedCase>& cases,
             const std::vector<Answer>& base, const std::vector<Answer>& other) {
  int right = 0, better = 0, worse = 0, names = 0, false_names = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool was = is_right(base[i].score);
    const bool is = is_right(other[i].score);
    right += is, better += is && !was, worse += was && !is;
    names += other[i].score.named, false_names += other[i].score.false_names;
    if (&base == &other || other[i].says == base[i].says) continue;
    fmt::print(stderr, "{} {} {} | {} | {} -> {}\n", rule, i,
               is == was ? "="
               : is      ? "better"
                         : "worse",
               hidden_in(cases[i]), base[i].says, other[i].says);
  }
  fmt::print("| {} | {} | {} | {} | {} of {} |\n", rule, right, better, worse, false_names, names);
  std::fflush(stdout);
}

bool is_asked(const Rule& rule, const std::vector<std::string>& asked) {
  return asked.empty() || std::ranges::count(asked, rule.name) > 0;
}

int on_data_sets(const std::vector<std::string>& folders, const std::vector<std::string>& asked) {
  std::vector<RecordingSet> sets;
  for (const std::string& folder : folders) {
    auto set = data::load_dataset(folder);
    if (!set) {
      fmt::print(stderr, "{}\n", set.error().message());
      return 1;
    }
    sets.push_back(std::move(*set));
  }
  std::vector<std::string> base;
  for (const Rule& rule : rules()) {
    if (!base.empty() && !is_asked(rule, asked)) continue;
    Limits limits;
    rule.without(limits);
    std::vector<std::string> says(sets.size());
    in_parallel(sets.size(), 0, [&](std::size_t i) {
      says[i] = in_words(studies::diagnosed(sets[i], {}, {.threads = 1, .nested = false}, limits));
    });
    if (base.empty()) base = std::vector<std::string>(sets.size());
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if (says[i] != base[i]) fmt::print("{} | {} | {}\n", rule.name, folders[i], says[i]);
      if (base[i].empty()) base[i] = says[i];
    }
    fmt::print("{} | {} data sets\n", rule.name, sets.size());
    std::fflush(stdout);
  }
  return 0;
}

int on_trial(int argc, char** argv) {
  auto trial = studies::load_trial(argv[1]);
  if (!trial) {
    fmt::print(stderr, "{}\n", trial.error().message());
    return 1;
  }
  trial->cases = std::atoi(argv[2]);
  trial->seed = std::strtoull(argv[3], nullptr, 10);
  const auto cases = cases_of(*trial);
  fmt::print(
      "{} cases\n| without | right | better | worse | false names |\n|---|---|---|---|---|\n",
      cases.size());
  const std::vector<std::string> asked(argv + 4, argv + argc);
  std::vector<Answer> base;
  for (const Rule& rule : rules()) {
    if (!base.empty() && !is_asked(rule, asked)) continue;
    Limits limits;
    rule.without(limits);
    if (base.empty()) {
      base = answers(cases, limits);
      compare(rule.name, cases, base, base);
      for (std::size_t i = 0; i < cases.size(); ++i) {
        fmt::print(stderr, "base {} {} | {} | {} |{}\n", i,
                   is_right(base[i].score) ? "right" : "WRONG", hidden_in(cases[i]), base[i].says,
                   names_in(base[i].score));
      }
      continue;
    }
    compare(rule.name, cases, base, answers(cases, limits));
  }
  return 0;
}

}  // namespace
}  // namespace flexspline::bench

int main(int argc, char** argv) {
  std::vector<std::string> folders, rules;
  for (int i = 1; i < argc; ++i) {
    (std::filesystem::is_directory(argv[i]) ? folders : rules).push_back(argv[i]);
  }
  if (!folders.empty()) return flexspline::bench::on_data_sets(folders, rules);
  if (argc >= 4) return flexspline::bench::on_trial(argc, argv);
  fmt::print(stderr,
             "usage: {0} TRIAL.toml CASES SEED [RULE...]\n       {0} DATASET... [RULE...]\n",
             argv[0]);
  return 2;
}
