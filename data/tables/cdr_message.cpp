#include "tables/cdr_message.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>

namespace flexspline::data {
namespace {

constexpr std::size_t kMostTexts = 4096;

/// The bytes behind the four that say how they are written. What is aligned, is so from there.
class Bytes {
 public:
  explicit Bytes(std::string_view all) {
    const bool known = all.size() >= 4 && all[0] == 0 && (all[1] == 0 || all[1] == 1);
    if (!known) return;
    good_ = true;
    little_ = all[1] == 1;
    rest_ = all.substr(4);
  }

  bool good() const { return good_; }

  template <class Number>
  Number take() {
    at_ = (at_ + sizeof(Number) - 1) / sizeof(Number) * sizeof(Number);
    if (!has(sizeof(Number))) return {};
    char raw[sizeof(Number)];
    std::memcpy(raw, rest_.data() + at_, sizeof raw);
    if (little_ != (std::endian::native == std::endian::little)) std::ranges::reverse(raw);
    at_ += sizeof raw;
    Number value;
    std::memcpy(&value, raw, sizeof value);
    return value;
  }

  std::string_view text() {
    const auto size = take<std::uint32_t>();
    if (!has(size)) return {};
    const std::string_view taken = rest_.substr(at_, size);
    at_ += size;
    return taken.substr(0, taken.find('\0'));
  }

 private:
  bool has(std::size_t count) {
    good_ = good_ && at_ <= rest_.size() && count <= rest_.size() - at_;
    return good_;
  }

  std::string_view rest_;
  std::size_t at_ = 0;
  bool good_ = false;
  bool little_ = true;
};

/// One walk through a message by its definition.
class Walk {
 public:
  Walk(const RosDefinition& all, std::size_t most, std::string_view bytes, CdrValues& values,
       std::vector<CdrLeaf>* leaves)
      : all_(all), most_(most), bytes_(bytes), values_(values), leaves_(leaves) {}

  bool run() {
    message(all_.name, "", "");
    return bytes_.good() && fits_;
  }

 private:
  bool going() const { return bytes_.good() && fits_; }

  void message(const std::string& type, const std::string& prefix, std::string_view unit) {
    if (type == "builtin_interfaces/Time") return stamp(prefix);
    std::vector<std::string> labels;
    for (const RosField& field : all_.messages.at(type)) {
      if (!going()) return;
      const std::string name = leaves_ == nullptr ? ""
                               : prefix.empty()   ? field.name
                                                  : prefix + "." + field.name;
      const std::string_view own = leaves_ == nullptr ? "" : ros_unit(type, field.name);
      this->field(field, name, own.empty() ? unit : own, labels);
    }
  }

  /// labels: the texts of a field "name", which call those of the fields behind it.
  void field(const RosField& field, const std::string& name, std::string_view unit,
             std::vector<std::string>& labels) {
    if (!field.many) return one(field, name, unit, nullptr);
    const std::uint32_t count = field.fixed > 0 ? field.fixed : bytes_.take<std::uint32_t>();
    const bool named = field.kind == RosKind::text && field.name == "name";
    std::vector<std::string> texts;
    for (std::uint32_t k = 0; k < count && going(); ++k) {
      const std::string each = leaves_ == nullptr       ? ""
                               : labels.size() == count ? name + "." + labels[k]
                                                        : fmt::format("{}[{}]", name, k + 1);
      one(field, each, unit, named ? &texts : nullptr);
    }
    if (named) labels = std::move(texts);
  }

  void one(const RosField& field, const std::string& name, std::string_view unit,
           std::vector<std::string>* texts) {
    switch (field.kind) {
      case RosKind::boolean:
      case RosKind::u8:
        return number<std::uint8_t>(name, unit);
      case RosKind::i8:
        return number<std::int8_t>(name, unit);
      case RosKind::i16:
        return number<std::int16_t>(name, unit);
      case RosKind::u16:
        return number<std::uint16_t>(name, unit);
      case RosKind::i32:
        return number<std::int32_t>(name, unit);
      case RosKind::u32:
        return number<std::uint32_t>(name, unit);
      case RosKind::i64:
        return number<std::int64_t>(name, unit);
      case RosKind::u64:
        return number<std::uint64_t>(name, unit);
      case RosKind::f32:
        return number<float>(name, unit);
      case RosKind::f64:
        return number<double>(name, unit);
      case RosKind::text:
        return text(texts);
      case RosKind::message:
        return nested(field, name, unit);
    }
  }

  template <class Number>
  void number(const std::string& name, std::string_view unit) {
    const auto value = bytes_.take<Number>();
    leaf(static_cast<double>(value), 0, {name, std::string(unit), false});
  }

  void stamp(const std::string& name) {
    const auto seconds = static_cast<std::int64_t>(bytes_.take<std::int32_t>());
    const auto nanoseconds = static_cast<std::int64_t>(bytes_.take<std::uint32_t>());
    const std::int64_t all = seconds * 1'000'000'000 + nanoseconds;
    leaf(1e-9 * static_cast<double>(all), all, {name, "s", true});
  }

  void text(std::vector<std::string>* texts) {
    const std::string_view taken = bytes_.text();
    fits_ = fits_ && ++texts_ <= kMostTexts;
    if (texts != nullptr && leaves_ != nullptr) texts->emplace_back(taken.substr(0, 256));
  }

  // A message without a field takes a byte.
  void nested(const RosField& field, const std::string& name, std::string_view unit) {
    if (all_.messages.at(field.type).empty()) {
      bytes_.take<std::uint8_t>();
    } else {
      message(field.type, name, unit);
    }
  }

  void leaf(double value, std::int64_t nanoseconds, CdrLeaf called) {
    fits_ = fits_ && values_.numbers.size() < most_;
    if (!going()) return;
    values_.numbers.push_back(value);
    values_.stamps.push_back(nanoseconds);
    if (leaves_ != nullptr) leaves_->push_back(std::move(called));
  }

  const RosDefinition& all_;
  std::size_t most_;
  Bytes bytes_;
  CdrValues& values_;
  std::vector<CdrLeaf>* leaves_;
  std::size_t texts_ = 0;
  bool fits_ = true;
};

}  // namespace

std::optional<std::vector<CdrLeaf>> CdrReader::leaves(std::string_view bytes) const {
  std::vector<CdrLeaf> list;
  CdrValues values;
  if (!Walk(all_, most_, bytes, values, &list).run()) return std::nullopt;
  return list;
}

bool CdrReader::values(std::string_view bytes, CdrValues& to) const {
  to.numbers.clear(), to.stamps.clear();
  return Walk(all_, most_, bytes, to, nullptr).run();
}

}  // namespace flexspline::data
