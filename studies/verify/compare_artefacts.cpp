#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/studies/verify.hpp"
#include "verify/quantity_class.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kTold = 12;
constexpr double kSigmas = 4.0;  ///< two estimates of one thing are rarely further apart

/// Wall-clock time, and what names the program and the run: circumstances are told from these.
constexpr std::array<std::string_view, 12> kNotCompared = {
    "seconds",  "seconds_median", "seconds_max", "sha256", "depends_on", "build_id",
    "versions", "salt",           "commitment",  "seed",   "seeds",      "study_sha256"};

struct Place {
  std::string path;
  std::string key;
  double scale = 0.0;  ///< largest of the list it stands in
  double std = 0.0;    ///< of both estimates together
  bool listed = false;
};

class Walk {
 public:
  explicit Walk(bool something_changed) : changed_(something_changed) {}

  void visit(const ordered_json& a, const ordered_json& b, const Place& at);
  ArtefactCheck result();

 private:
  void visit_object(const ordered_json& a, const ordered_json& b, const Place& at);
  void visit_list(const ordered_json& a, const ordered_json& b, const Place& at);
  void visit_numbers(double a, double b, const Place& at);
  void visit_texts(const std::string& a, const std::string& b, const Place& at);
  void note(Difference difference);

  bool changed_;
  ArtefactCheck check_;
};

double number_or(const ordered_json& object, const char* key, double otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : otherwise;
}

/// Of an entry that has a name or id, that; else its number.
std::string name_in(const ordered_json& entry, std::size_t index) {
  for (const char* key : {"name", "id", "key", "recording", "effect", "function"}) {
    if (entry.is_object() && entry.contains(key) && entry[key].is_string()) return entry[key];
  }
  return std::to_string(index);
}

double largest_in(const ordered_json& list) {
  double largest = 0.0;
  for (const ordered_json& one : list) {
    if (one.is_number()) largest = std::max(largest, std::abs(one.get<double>()));
  }
  return largest;
}

/// The words without their numbers: a sentence may say one more digit.
std::string without_numbers(const std::string& text) {
  std::string words;
  for (const char letter : text) {
    if (std::string_view("0123456789.+-e").find(letter) == std::string_view::npos) words += letter;
  }
  return words;
}

std::string short_text(const ordered_json& value) {
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  return text.size() > 80 ? fmt::format("{}...", text.substr(0, 77)) : text;
}

void Walk::note(Difference difference) {
  check_.level = std::max(check_.level, difference.level);
  if (std::isfinite(difference.over_tolerance)) {
    check_.largest = std::max(check_.largest, difference.over_tolerance);
  }
  check_.worst.push_back(std::move(difference));
}

void Walk::visit_numbers(double a, double b, const Place& at) {
  ++check_.numbers;
  if (a == b) return;
  ++check_.unequal;
  const QuantityClass& of = class_of(at.key, at.listed);
  const double scale = at.listed ? at.scale : std::max(std::abs(a), std::abs(b));
  const double off = std::abs(a - b);
  const double tolerance = of.relative * scale + of.of_std * at.std;
  const double looser = of.statistical * scale + kSigmas * at.std;
  const Agreement level = off <= tolerance            ? Agreement::numeric
                          : changed_ && off <= looser ? Agreement::statistical
                                                      : Agreement::differs;
  note({at.path, std::string(of.name), fmt::format("{}", a), fmt::format("{}", b), off / tolerance,
        level});
}

void Walk::visit_texts(const std::string& a, const std::string& b, const Place& at) {
  if (a == b) return;
  const bool same_words = without_numbers(a) == without_numbers(b);
  const Agreement level = same_words ? Agreement::numeric
                          : changed_ && (at.key == "says" || at.key == "why" || at.key == "outcome")
                              ? Agreement::statistical
                              : Agreement::differs;
  note({at.path, "words", short_text(a), short_text(b), std::numeric_limits<double>::quiet_NaN(),
        level});
}

void Walk::visit_object(const ordered_json& a, const ordered_json& b, const Place& at) {
  const double std = std::hypot(number_or(a, "std", 0.0), number_or(b, "std", 0.0));
  std::set<std::string> keys;
  for (const auto& [key, value] : a.items()) keys.insert(key);
  for (const auto& [key, value] : b.items()) keys.insert(key);
  static const ordered_json absent;
  for (const std::string& key : keys) {
    if (std::ranges::find(kNotCompared, key) != kNotCompared.end()) continue;
    const std::string path = at.path.empty() ? key : at.path + "/" + key;
    visit(a.contains(key) ? a[key] : absent, b.contains(key) ? b[key] : absent,
          {path, key, 0.0, key == "std" ? 0.0 : std, false});
  }
}

void Walk::visit_list(const ordered_json& a, const ordered_json& b, const Place& at) {
  if (a.size() != b.size()) {
    note({at.path, "length", std::to_string(a.size()), std::to_string(b.size()),
          std::numeric_limits<double>::quiet_NaN(),
          changed_ ? Agreement::statistical : Agreement::differs});
    return;
  }
  const double scale = std::max(largest_in(a), largest_in(b));
  for (std::size_t i = 0; i < a.size(); ++i) {
    visit(a[i], b[i], {at.path + "/" + name_in(a[i], i), at.key, scale, at.std, true});
  }
}

void Walk::visit(const ordered_json& a, const ordered_json& b, const Place& at) {
  if (a.is_number() && b.is_number()) {
    visit_numbers(a.get<double>(), b.get<double>(), at);
  } else if (a.is_string() && b.is_string()) {
    visit_texts(a.get<std::string>(), b.get<std::string>(), at);
  } else if (a.is_object() && b.is_object()) {
    visit_object(a, b, at);
  } else if (a.is_array() && b.is_array()) {
    visit_list(a, b, at);
  } else if (a != b) {
    note({at.path, "presence", short_text(a), short_text(b),
          std::numeric_limits<double>::quiet_NaN(), Agreement::differs});
  }
}

ArtefactCheck Walk::result() {
  std::ranges::stable_sort(check_.worst, [](const Difference& a, const Difference& b) {
    if (a.level != b.level) return a.level > b.level;
    return a.over_tolerance > b.over_tolerance;
  });
  if (check_.worst.size() > kTold) check_.worst.resize(kTold);
  return std::move(check_);
}

}  // namespace

ArtefactCheck compare_artefacts(const ordered_json& before, const ordered_json& after,
                                bool something_changed) {
  Walk walk(something_changed);
  walk.visit(before, after, {});
  return walk.result();
}

}  // namespace flexspline::studies
