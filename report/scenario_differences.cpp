// SPDX-License-Identifier: Apache-2.0
#include "report/scenario_differences.hpp"

#include <algorithm>
#include <concepts>
#include <utility>

#include "report/figures.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/scenario/motion_words.hpp"

namespace report {
namespace {

using sixstep::base::About;
using sixstep::base::Motion;

constexpr const char* absent = "–";

std::string value_text(double x, std::string_view unit) {
  return sixstep::base::written(x) + (unit.empty() ? "" : "\u00a0" + std::string(unit));
}
std::string value_text(bool x, std::string_view) { return x ? "true" : "false"; }
template <std::integral Int>
std::string value_text(Int x, std::string_view) {
  return std::to_string(x);
}
std::string value_text(const std::string& x, std::string_view) { return x; }
template <class T>
std::string value_text(const std::optional<T>& x, std::string_view unit) {
  return x ? value_text(*x, unit) : absent;
}
template <class T>
std::string value_text(const std::vector<T>& list, std::string_view unit) {
  std::string out;
  for (std::size_t n = 0; n < list.size(); ++n) out += (n ? ", " : "") + value_text(list[n], "");
  return out.empty() ? absent : out + (unit.empty() ? "" : "\u00a0" + std::string(unit));
}

template <class T>
constexpr bool is_number =
    std::same_as<T, double> || std::same_as<T, std::optional<double>> || std::same_as<T, std::vector<double>>;

double spelled_as(double x, const sixstep::base::Spelling& s) { return sixstep::base::as_spelled(x, s); }
std::optional<double> spelled_as(const std::optional<double>& x, const sixstep::base::Spelling& s) {
  return x ? std::optional(as_spelled(*x, s)) : x;
}
std::vector<double> spelled_as(std::vector<double> list, const sixstep::base::Spelling& s) {
  for (double& x : list) x = as_spelled(x, s);
  return list;
}

/// Every key of a scenario with its value as text, in the order of the descriptions.
class Flat final : public sixstep::base::Visitor {
 public:
  explicit Flat(Motion motion = {}) : motion_(motion) {}
  std::vector<std::pair<std::string, std::string>> rows;

  std::string text_of(const std::string& key) const {
    const auto found = std::ranges::find(rows, key, &std::pair<std::string, std::string>::first);
    return found == rows.end() ? absent : found->second;
  }

 private:
  void visit_value(std::string_view key, const sixstep::base::ValueMember& member,
                   const About& about) override {
    std::visit([&](const auto* of) { row(key, *of, about); }, member);
  }
  template <class T>
  void row(std::string_view key, const T& member, const About& about) {
    const sixstep::base::Spelling* linear = motion_.linear ? linear_spelling(about) : nullptr;
    if constexpr (is_number<T>)
      if (linear) return add(linear->key, value_text(spelled_as(member, *linear), linear->unit));
    add(linear ? linear->key : key, value_text(member, linear ? linear->unit : about.unit));
  }
  void visit_word(std::string_view key, sixstep::base::WordMember& member, const About&) override {
    add(key, std::string(motion_.linear ? member.linear_word() : member.word()));
  }
  void visit_quantity(std::string_view key, const sixstep::base::QuantityMember& member,
                      const About& about) override {
    const sixstep::base::Quantity* const q = quantity_in(member);
    row(key, q ? std::optional(q->value) : std::nullopt, about);
  }
  void visit_table(std::string_view key, sixstep::base::TableMember& member, const About&) override {
    if (!member.is_there()) return;
    const std::string outer = std::exchange(path_, path_ + std::string(key) + ".");
    member.walk(*this);
    path_ = outer;
  }
  /// The list [[at]] is included, because no other list changes a run. Values that an event does not change
  /// are omitted.
  void visit_list(std::string_view key, sixstep::base::ListMember& items, const About&) override {
    if (key != sixstep::study::events_list) return;
    Flat plain(motion_);
    items.walk_usual(plain);
    for (std::size_t n = 0; n < items.size(); ++n) {
      Flat event(motion_);
      items.walk(n, event);
      for (auto& row : event.rows)
        if (row.first == "time_s" || std::ranges::find(plain.rows, row) == plain.rows.end())
          rows.emplace_back("at[" + std::to_string(n) + "]." + row.first, std::move(row.second));
    }
  }

  void add(std::string_view key, std::string text) {
    rows.emplace_back(path_ + std::string(key), std::move(text));
  }
  Motion motion_;
  std::string path_;
};

/// Whether the key has no effect on a run. `extends` has none, because the scenario already contains the
/// values of the extended file.
bool changes_no_run(const std::string& key) {
  return key == "title" || key == "notes" || key == "extends" || key.starts_with("record.");
}

/// Keys in the order of the descriptions. Keys that only a later scenario contains follow at the end.
std::vector<std::string> keys_of(const std::vector<Flat>& all) {
  std::vector<std::string> keys;
  for (const Flat& flat : all)
    for (const auto& row : flat.rows)
      if (std::ranges::find(keys, row.first) == keys.end()) keys.push_back(row.first);
  return keys;
}

}  // namespace

std::vector<KeyDifference> differences(const std::vector<const sixstep::study::Scenario*>& scenarios) {
  std::vector<Flat> all;
  for (const sixstep::study::Scenario* scenario : scenarios) {
    sixstep::study::Scenario copy = *scenario;
    text::in_units_of_its_motor(copy);
    describe(all.emplace_back(sixstep::design::motion_of(copy.sheet)), copy);
  }
  std::vector<KeyDifference> out;
  for (const std::string& key : keys_of(all)) {
    KeyDifference row{key, {}};
    for (const Flat& flat : all) row.values.push_back(flat.text_of(key));
    const bool same =
        std::ranges::all_of(row.values, [&](const std::string& v) { return v == row.values[0]; });
    if (!same && !changes_no_run(key)) out.push_back(std::move(row));
  }
  return out;
}

}  // namespace report
