// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/scenario_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>
#include <utility>

#include "sixstep/base/linear.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/escape/escape.hpp"
#include "text/scenario/motion_words.hpp"

namespace text {
namespace {

std::string toml(double x) { return sixstep::base::written(x); }
std::string toml(bool x) { return x ? "true" : "false"; }
std::string toml(int x) { return std::to_string(x); }
std::string toml(const std::string& text) { return toml_text(text); }
template <class T>
std::string toml(const std::vector<T>& list) {
  std::string out = "[";
  for (std::size_t n = 0; n < list.size(); ++n) out += (n ? ", " : "") + toml(list[n]);
  return out + "]";
}

/// A number with as many digits after the point as in its file, because these digits define the tolerance.
std::string with_last_digit(const sixstep::base::Quantity& q) {
  std::string text = toml(q.value);
  if (!q.last_digit || text.find_first_not_of("-.0123456789") != std::string::npos) return text;
  const std::size_t point = text.find('.'), there = point == std::string::npos ? 0 : text.size() - point - 1;
  std::size_t wanted = 0;
  for (double digit = *q.last_digit; digit < 0.5 && wanted < 22; digit *= 10) ++wanted;
  if (wanted > there && point == std::string::npos) text += '.';
  return wanted > there ? text + std::string(wanted - there, '0') : text;
}

std::string toml(const sixstep::base::Quantity& q) {
  std::string number = with_last_digit(q);
  if (q.frame.empty() && q.source.empty() && q.kind == sixstep::base::Trust::unstated && !q.range)
    return number;
  std::string out = "{ value = " + number;
  if (!q.frame.empty()) out += ", frame = " + toml_text(q.frame);
  if (!q.source.empty()) out += ", source = " + toml_text(q.source);
  if (q.kind != sixstep::base::Trust::unstated)
    out += fmt::format(", kind = \"{}\"", sixstep::base::word(sixstep::base::trust_choices, q.kind));
  if (q.range) out += fmt::format(", range = [{}, {}]", toml(q.range->low), toml(q.range->high));
  return out + " }";
}

/// Converts a number to the unit of another spelling. If possible, reading the result gives the same double
/// again.
double spelled_as(double own, const sixstep::base::Spelling& spelling) {
  using sixstep::base::in_own_unit;
  double x = sixstep::base::as_spelled(own, spelling);
  for (int n = 0; n < 4 && in_own_unit(x, spelling) != own; ++n)
    x = std::nextafter(x, in_own_unit(x, spelling) < own ? HUGE_VAL : -HUGE_VAL);
  return x;
}
std::vector<double> spelled_as(std::vector<double> list, const sixstep::base::Spelling& spelling) {
  for (double& x : list) x = spelled_as(x, spelling);
  return list;
}

/// Writes one table's keys, then the tables in it, then the lists in it, in the words of the motor's kind.
class TableText final : public sixstep::base::Visitor {
 public:
  explicit TableText(bool linear_motor = false) : linear_motor_(linear_motor) {}

  enum class Heading { with_rows, always, none };

  /// The rows that differ from `usual`, below the table's heading; then the inner tables.
  std::string text(const TableText& usual, const std::string& path, Heading heading) const;
  /// All rows, each with `path`; then the rows of the inner tables and lists.
  void add_values(const TableText& usual, const std::string& path, std::vector<WrittenValue>& out) const;

 private:
  void visit_value(std::string_view key, const sixstep::base::ValueMember& member,
                   const sixstep::base::About& about) override {
    std::visit([&](const auto* of) { add_row(key, *of, about); }, member);
  }
  template <class T>
  void add_row(std::string_view key, const T& member, const sixstep::base::About& about) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::vector<double>>)
      if (const auto* linear = linear_motor_ ? sixstep::base::linear_spelling(about) : nullptr)
        return rows_.push_back({std::string(linear->key), toml(spelled_as(member, *linear)), about.required});
    rows_.push_back({std::string(key), toml(member), about.required});
  }
  /// A linear motor's file also has other keys for the quantities of the sheet.
  void add_row(std::string_view key, const sixstep::base::Quantity& member,
               const sixstep::base::About& about) {
    const auto* const linear = linear_motor_ ? sixstep::base::linear_spelling(about) : nullptr;
    if (linear == nullptr) return rows_.push_back({std::string(key), toml(member), about.required});
    sixstep::base::Quantity spelled = member;
    spelled.value = spelled_as(member.value, *linear);
    if (spelled.last_digit) spelled.last_digit = sixstep::base::as_spelled(*member.last_digit, *linear);
    if (spelled.range) {
      spelled.range->low = spelled_as(member.range->low, *linear);
      spelled.range->high = spelled_as(member.range->high, *linear);
    }
    if (!linear->frame.empty()) spelled.frame.clear();
    rows_.push_back({std::string(linear->key), toml(spelled), about.required});
  }
  template <class T>
  void add_row(std::string_view key, const std::optional<T>& member, const sixstep::base::About& about) {
    if (member) add_row(key, *member, about);
  }
  void visit_word(std::string_view key, sixstep::base::WordMember& member,
                  const sixstep::base::About& about) override {
    add_row(key, std::string(linear_motor_ ? member.linear_word() : member.word()), about);
  }
  void visit_quantity(std::string_view key, const sixstep::base::QuantityMember& member,
                      const sixstep::base::About& about) override {
    std::visit([&](const auto* of) { add_row(key, *of, about); }, member);
  }
  /// The heading of an optional table is written even if every row has its default, because the heading marks
  /// the table as present.
  void visit_table(std::string_view key, sixstep::base::TableMember& member,
                   const sixstep::base::About& about) override {
    TableText inner(linear_motor_);
    member.is_there() ? member.walk(inner) : member.walk_usual(inner);
    inner.key_ = std::string(key);
    inner.shown_ = !member.is_optional() ? about.partial ? Shown::partly : Shown::where_it_differs
                   : member.is_there()   ? Shown::always
                                         : Shown::never;
    tables_.push_back(std::move(inner));
  }
  void visit_list(std::string_view key, sixstep::base::ListMember& items,
                  const sixstep::base::About&) override {
    TableText plain(linear_motor_);
    items.walk_usual(plain);
    for (std::size_t n = 0; n < items.size(); ++n) {
      TableText inner(linear_motor_);
      items.walk(n, inner);
      inner.key_ = std::string(key);
      inner.add_values(plain, fmt::format("{}[{}].", key, n), listed_);
      items_.push_back(std::move(inner));
      usual_items_.push_back(plain);
    }
  }

  enum class Shown { where_it_differs, always, never, partly };  ///< partly: no key of the table is required
  struct Row {
    std::string key, value;
    bool required;
  };

  bool linear_motor_;
  std::string key_;
  Shown shown_ = Shown::where_it_differs;
  std::vector<Row> rows_;
  std::vector<TableText> tables_;
  std::vector<TableText> items_,
      usual_items_;                   ///< items of the lists, and an item of each list with its defaults
  std::vector<WrittenValue> listed_;  ///< values of the lists' items
};

std::string TableText::text(const TableText& usual, const std::string& path, Heading heading) const {
  std::map<std::string, std::string> other;
  for (const Row& row : usual.rows_) other.emplace(row.key, row.value);
  std::string out;
  for (const Row& row : rows_) {
    const auto same = other.find(row.key);
    if ((row.required && shown_ != Shown::partly) || same == other.end() || same->second != row.value)
      out += fmt::format("{} = {}\n", row.key, row.value);
  }
  if (heading == Heading::always || (heading == Heading::with_rows && !out.empty()))
    out = fmt::format("\n[{}]\n", path) + out;
  const auto within = [&path](const TableText& inner) {
    return path.empty() ? inner.key_ : path + "." + inner.key_;
  };
  for (std::size_t n = 0; n < tables_.size(); ++n) {
    const TableText& inner = tables_[n];
    if (inner.shown_ == Shown::never) continue;
    out += inner.text(usual.tables_[n], within(inner),
                      inner.shown_ == Shown::always ? Heading::always : Heading::with_rows);
  }
  for (std::size_t n = 0; n < items_.size(); ++n)
    out += fmt::format("\n[[{}]]\n{}", within(items_[n]),
                       items_[n].text(usual_items_[n], within(items_[n]), Heading::none));
  return out;
}

void TableText::add_values(const TableText& usual, const std::string& path,
                           std::vector<WrittenValue>& out) const {
  for (const Row& row : rows_) {
    const bool same = std::any_of(usual.rows_.begin(), usual.rows_.end(), [&](const Row& other) {
      return other.key == row.key && other.value == row.value;
    });
    if (shown_ == Shown::partly && same) continue;
    out.push_back({path + row.key, row.value, same && !row.required});
  }
  for (std::size_t n = 0; n < tables_.size(); ++n)
    if (tables_[n].shown_ != Shown::never)
      tables_[n].add_values(usual.tables_[n], path + tables_[n].key_ + ".", out);
  for (const WrittenValue& value : listed_) out.push_back({path + value.path, value.text, value.usual});
}

/// Collects the keys of quantities, counts and texts that a sheet gives.
class KeysGiven final : public sixstep::base::Visitor {
 public:
  std::vector<std::string_view> keys;

 private:
  void visit_quantity(std::string_view key, const sixstep::base::QuantityMember& member,
                      const sixstep::base::About&) override {
    if (quantity_in(member)) keys.push_back(key);
  }
  void visit_value(std::string_view key, const sixstep::base::ValueMember& member,
                   const sixstep::base::About&) override {
    const std::optional<int>* const* count = std::get_if<std::optional<int>*>(&member);
    const std::string* const* text = std::get_if<std::string*>(&member);
    if ((count && **count) || (text && !(*text)->empty())) keys.push_back(key);
  }
};

/// The motor's own sheet, without overrides. If the run's sheet lacks a key of the motor's sheet, an override
/// with the same meaning has replaced the key; then all keys are written.
design::Sheet usual_sheet(const study::Scenario& s) {
  if (!s.motor_sheet) return s.sheet;
  design::Sheet own = *s.motor_sheet, used = s.sheet;
  KeysGiven before, now;
  describe(before, own);
  describe(now, used);
  for (const std::string_view key : before.keys)
    if (std::find(now.keys.begin(), now.keys.end(), key) == now.keys.end()) return {};
  return own;
}

}  // namespace

std::string scenario_text(const study::Scenario& scenario, const std::vector<std::string>& comments) {
  study::Scenario copy = scenario, usual;
  // Values read from other files are written out, so that the text does not depend on the folder of its file.
  copy.extends.clear();
  const auto detach = [](study::Reference& r) {
    r.file.clear();
    r.column.reset();
  };
  detach(copy.reference);
  for (study::At& at : copy.at)
    if (at.reference) detach(*at.reference);
  usual.sheet = usual_sheet(scenario);
  const bool linear = copy.sheet.kind == design::MotorKind::linear;
  in_units_of_its_motor(copy);
  TableText text(linear), defaults(linear);
  describe(text, copy);
  describe(defaults, usual);
  std::string out;
  for (const std::string& line : comments) out += "# " + visible(line) + "\n";
  return out + text.text(defaults, "", TableText::Heading::none);
}

std::string sheet_text(const design::Sheet& sheet) {
  design::Sheet copy = sheet, usual;
  copy.back_emf_file.clear();
  const bool linear = sheet.kind == design::MotorKind::linear;
  TableText text(linear), defaults(linear);
  describe(text, copy);
  describe(defaults, usual);
  return text.text(defaults, "", TableText::Heading::none);
}

std::vector<WrittenValue> scenario_values(const study::Scenario& scenario) {
  study::Scenario copy = scenario, usual;
  usual.sheet = usual_sheet(scenario);
  const bool linear = copy.sheet.kind == design::MotorKind::linear;
  in_units_of_its_motor(copy);
  TableText text(linear), defaults(linear);
  describe(text, copy);
  describe(defaults, usual);
  std::vector<WrittenValue> values;
  text.add_values(defaults, "", values);
  return values;
}

}  // namespace text
