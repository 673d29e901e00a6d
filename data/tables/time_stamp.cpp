#include "tables/time_stamp.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>

namespace flexspline::data {
namespace {

/// Takes a text from its head; a step that does not fit leaves it where it is.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool ended() const { return rest_.empty(); }
  bool pass(char letter) {
    if (rest_.empty() || rest_.front() != letter) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool pass(std::string_view word) {
    if (!std::ranges::equal(rest_.substr(0, word.size()), word, {}, upper)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  void blanks() {
    while (pass(' ')) continue;
  }
  /// A whole number of so many digits.
  std::optional<int> digits(std::size_t least, std::size_t most) {
    std::size_t count = 0;
    while (count < rest_.size() && count < most && is_digit(rest_[count])) ++count;
    if (count < least) return std::nullopt;
    int value = 0;
    std::from_chars(rest_.data(), rest_.data() + count, value);
    rest_.remove_prefix(count);
    return value;
  }
  /// ".25", ",25" or nothing.
  double fraction() {
    if (rest_.size() < 2 || (rest_[0] != '.' && rest_[0] != ',') || !is_digit(rest_[1])) return 0.0;
    rest_.remove_prefix(1);
    double value = 0.0;
    double scale = 1.0;
    for (; !rest_.empty() && is_digit(rest_.front()); rest_.remove_prefix(1)) {
      value = 10.0 * value + (rest_.front() - '0');
      scale *= 10.0;
    }
    return value / scale;
  }
  char next() const { return rest_.empty() ? '\0' : rest_.front(); }

 private:
  static char upper(char letter) {
    return static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  static bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

  std::string_view rest_;
};

std::optional<std::int64_t> day_of(int year, int month, int day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(unsigned(month)),
                            std::chrono::day(unsigned(day))};
  if (!date.ok() || year < 1900 || year > 2200) return std::nullopt;
  return sys_days(date).time_since_epoch().count();
}

/// False: it begins like a date and is none.
bool take_date(Scanner& text, int first, char mark, bool year_first, TimeStamp& stamp) {
  const auto second = text.digits(1, 2);
  if (!second || !text.pass(mark)) return false;
  const auto third = year_first ? text.digits(1, 2) : text.digits(4, 4);
  if (!third) return false;
  if (year_first) {
    stamp.day = day_of(first, *second, *third);
  } else if (mark == '/' && *second > 12) {
    stamp.day = day_of(*third, first, *second);
  } else if (mark == '/' && first <= 12) {
    stamp.day = day_of(*third, first, *second);
    stamp.order_open = first != *second;
  } else {
    stamp.day = day_of(*third, *second, first);
  }
  return stamp.day.has_value();
}

bool take_zone(Scanner& text, TimeStamp& stamp) {
  if (text.pass('Z')) return true;
  const bool ahead = text.next() == '+';
  if (!ahead && text.next() != '-') return true;
  text.pass(text.next());
  const auto hours = text.digits(2, 2);
  if (!hours) return false;
  text.pass(':');
  const int minutes = text.digits(2, 2).value_or(0);
  stamp.second -= (ahead ? 1.0 : -1.0) * (3600.0 * *hours + 60.0 * minutes);
  return true;
}

bool take_time(Scanner& text, int hour, TimeStamp& stamp) {
  const auto minute = text.digits(2, 2);
  if (!minute || *minute > 59) return false;
  int second = 0;
  double fraction = 0.0;
  if (text.pass(':')) {
    const auto given = text.digits(2, 2);
    if (!given || *given > 60) return false;
    second = *given;
    fraction = text.fraction();
  }
  text.blanks();
  const bool before_noon = text.pass(std::string_view("AM"));
  const bool after_noon = !before_noon && text.pass(std::string_view("PM"));
  if (before_noon || after_noon) hour = hour % 12 + (after_noon ? 12 : 0);
  if (hour > 23) return false;
  stamp.second = 3600.0 * hour + 60.0 * *minute + second + fraction;
  return take_zone(text, stamp);
}

}  // namespace

std::optional<TimeStamp> parse_time_stamp(std::string_view text) {
  if (text.size() < 4 || text.size() > 48) return std::nullopt;
  Scanner scanner(text);
  TimeStamp stamp;
  auto first = scanner.digits(1, 4);
  if (!first) return std::nullopt;
  const char mark = scanner.next();
  if (mark == '-' || mark == '/' || mark == '.') {
    scanner.pass(mark);
    if (!take_date(scanner, *first, mark, *first > 31, stamp)) return std::nullopt;
    if (scanner.ended()) return stamp;
    if (!scanner.pass('T') && !scanner.pass(' ')) return std::nullopt;
    scanner.blanks();
    first = scanner.digits(1, 2);
  }
  if (!first || !scanner.pass(':') || !take_time(scanner, *first, stamp)) return std::nullopt;
  if (!scanner.ended()) return std::nullopt;
  return stamp;
}

}  // namespace flexspline::data
