// SPDX-License-Identifier: Apache-2.0
// Tests properties of every key that follow from the description. All interfaces share this description.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <utility>

#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/toml/table_reader.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

/// Writes a struct as TOML. With `change`, it first sets each member to another value of its allowed range.
class Dump final : public base::Visitor {
 public:
  explicit Dump(bool change) : change_(change) {}
  /// The whole text. Lists are at the end, because all lines after a list's heading belong to the list.
  std::string whole() const { return text_ + lists_; }

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About& about) override {
    std::visit([&](auto* of) { put(key, *of, about); }, member);
  }
  void visit_quantity(std::string_view key, const base::QuantityMember& member,
                      const base::About& about) override {
    std::visit([&](auto* of) { put(key, *of, about); }, member);
  }
  void put(std::string_view key, double& x, const base::About& about) {
    if (change_) x = inside(about.range, x);
    emit(key, fmt::format("{}", x));
  }
  void put(std::string_view key, int& x, const base::About& about) {
    if (change_) x = about.range.holds(7) ? 7 : about.range.high < 2 ? 1 : about.range.holds(3) ? 3 : 12;
    emit(key, fmt::format("{}", x));
  }
  void put(std::string_view key, bool& x, const base::About&) {
    if (change_) x = !x;
    emit(key, x ? "true" : "false");
  }
  void put(std::string_view key, std::string& x, const base::About&) {
    if (change_) x = fmt::format("text of {}", key);
    emit(key, fmt::format("\"{}\"", x));
  }
  void put(std::string_view key, std::vector<double>& x, const base::About&) {
    if (change_) x = {0.25, 0.5};
    emit(key, fmt::format("[{}]", fmt::join(x, ", ")));
  }
  void put(std::string_view key, std::vector<std::string>& x, const base::About&) {
    if (change_) x = {"one", "two"};
    emit(key, fmt::format("[\"{}\"]", fmt::join(x, "\", \"")));
  }
  template <class T>
  void put(std::string_view key, std::optional<T>& x, const base::About& about) {
    if (change_) x.emplace();
    if (x) put(key, *x, about);
  }
  void visit_word(std::string_view key, base::WordMember& x, const base::About&) override {
    if (change_) x.choose(x.size() - 1);
    emit(key, fmt::format("\"{}\"", x.word()));
  }
  void put(std::string_view key, base::Quantity& q, const base::About& about) {
    if (change_) {
      q = {inside(about.range, q.value), std::string(about.frame.substr(about.frame.rfind('|') + 1)),
           "a source"};
      q.kind = base::Trust::measured;
      q.range = base::Interval{0.125, 8.5};
    }
    const std::string frame = q.frame.empty() ? "" : fmt::format("frame = \"{}\", ", q.frame);
    const std::string kind = q.kind == base::Trust::unstated ? "" : ", kind = \"measured\"";
    const std::string range = q.range ? fmt::format(", range = [{}, {}]", q.range->low, q.range->high) : "";
    emit(key, fmt::format("{{ value = {}, {}source = \"{}\"{}{} }}", q.value, frame, q.source, kind, range));
  }
  void put(std::string_view key, std::optional<base::Quantity>& q, const base::About& about) {
    if (change_) q.emplace();
    if (q) put(key, *q, about);
  }
  void visit_table(std::string_view key, base::TableMember& member, const base::About&) override {
    if (change_) member.emplace();
    if (!member.is_there()) return;
    const std::string outer = prefix_;
    prefix_ += std::string(key) + '.';
    member.walk(*this);
    prefix_ = outer;
  }
  void visit_list(std::string_view key, base::ListMember& member, const base::About&) override {
    if (change_) member.resize(2);
    const std::string keys = std::exchange(text_, ""), outer = std::exchange(prefix_, "");
    for (std::size_t n = 0; n < member.size(); ++n) {
      text_ += fmt::format("[[{}{}]]\n", outer, key);
      member.walk(n, *this);
    }
    prefix_ = outer;
    lists_ += std::exchange(text_, keys);
  }
  static double inside(const base::Range& range, double present) {
    const double tried = 0.375;
    if (range.holds(tried) && tried != present) return tried;
    return range.holds(5.5) ? 5.5 : range.holds(1.0) ? 1.0 : (range.low + range.high) / 2;
  }
  void emit(std::string_view key, const std::string& toml) {
    text_ += fmt::format("{}{} = {}\n", prefix_, key, toml);
  }
  bool change_;
  std::string text_, prefix_, lists_;
};

template <class Struct>
std::string dump(Struct& s, bool change) {
  Dump visitor(change);
  describe(visitor, s);
  return visitor.whole();
}

template <class Struct>
void expect_round_trip() {
  Struct written, unread;
  const std::string text = dump(written, true);
  const base::Result<Document> document = Document::parse("x.toml", text);
  ASSERT_TRUE(document) << to_string(document.problems().at(0)) << "\n" << text;
  Struct read;
  Complaints complaints(*document);
  read_root(*document, read, complaints);
  for (const base::Problem& problem : complaints.in_order()) ADD_FAILURE() << to_string(problem);
  EXPECT_EQ(dump(read, false), text);
  // Every line of the changed text must differ from the line of the default. Otherwise the key would not be
  // tested.
  const std::string plain = dump(unread, false);
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos;
       begin = end + 1, end = text.find('\n', begin)) {
    const std::string line = text.substr(begin, end - begin + 1);
    if (line.starts_with("[[")) break;                // lists are empty by default
    if (line.starts_with("bridge.device")) continue;  // the key has only one choice
    EXPECT_EQ(plain.find("\n" + line), std::string::npos) << line;
  }
}

TEST(DescribedKeys, EveryScenarioKeyRoundTrips) { expect_round_trip<study::Scenario>(); }
TEST(DescribedKeys, EveryMotorKeyRoundTrips) { expect_round_trip<design::Sheet>(); }

std::vector<KeyEntry> all_keys() {
  std::vector<KeyEntry> keys = scenario_keys();
  const std::vector<KeyEntry>& sheet = sheet_keys();
  keys.insert(keys.end(), sheet.begin(), sheet.end());
  return keys;
}

TEST(DescribedKeys, EveryKeyAndWordHasAMeaning) {
  for (const KeyEntry& key : all_keys()) {
    EXPECT_FALSE(key.about.meaning.empty()) << key.path;
    EXPECT_NE(key.about.meaning.back(), '.') << key.path;
    EXPECT_EQ(key.type == KeyType::word, !key.choices.empty()) << key.path;
    for (const auto& [word, meaning] : key.choices) EXPECT_FALSE(meaning.empty()) << key.path << " " << word;
  }
}

std::string letters(std::string_view text) {
  std::string plain;
  for (const char c : text)
    if (c != ' ' && c != '/' && c != '_') plain += c;
  if (const std::size_t per = plain.find("per"); per != std::string::npos) plain.erase(per, 3);
  return plain;
}

TEST(DescribedKeys, EveryNumberCarriesItsUnitInItsNameOrHasNone) {
  // Exceptions are counts, ratios, gains, and values in the unit of a mode or of a figure that another key
  // names.
  const std::set<std::string> without = {"pole_pairs",
                                         "delay_periods",
                                         "hall_stable_samples",
                                         "damping",
                                         "anti_windup",
                                         "setpoint_weight",
                                         "observer_ratio",
                                         "d1",
                                         "d0",
                                         "kp",
                                         "ki",
                                         "value",
                                         "values",
                                         "slew",
                                         "high",
                                         "low",
                                         "end",
                                         "slope",
                                         "acceleration",
                                         "offset",
                                         "amplitude",
                                         "level",
                                         "start",
                                         "fraction",
                                         "band",
                                         "tail",
                                         "min",
                                         "max",
                                         "relative",
                                         "absolute",
                                         "cut_sigma",
                                         "adc_bits",
                                         "current_gain_error",
                                         "bus_gain_error",
                                         "voltage_samples",
                                         "commutation_samples",
                                         "speed_edges",
                                         "seed",
                                         "line",
                                         "poles",
                                         "sector",
                                         "turns_in_series",
                                         "harmonic_orders",
                                         "harmonic_sizes",
                                         "back_emf_shape",
                                         "phase_resistance_deviation",
                                         "phase_back_emf_deviation",
                                         "cogging_orders",
                                         "gear",
                                         "gear_efficiency",
                                         "battery_charges",
                                         "battery_charge",
                                         "lines",
                                         "bits",
                                         "speed_samples",
                                         "pole_pairs",
                                         "imbalance",
                                         "greatest_load",
                                         "overload",
                                         "lowest_part",
                                         "advance_periods",
                                         "correction",
                                         "mismatch",
                                         "hall_calibration_turns",
                                         "missed_edges",
                                         "track",
                                         "excitation",
                                         "terminal_gain_error",
                                         "scale"};
  for (const KeyEntry& key : all_keys()) {
    const bool number = key.type == KeyType::number || key.type == KeyType::whole_number ||
                        key.type == KeyType::numbers || key.type == KeyType::quantity;
    if (!number) continue;
    const std::string name = key.path.substr(key.path.rfind('.') + 1);
    if (name == "ki_per_s") continue;  // a gain per second; its description states the unit, as for kp and ki
    EXPECT_EQ(key.about.unit.empty(), without.contains(name)) << key.path;
    EXPECT_EQ(letters(name.substr(without_unit(name).size())), letters(key.about.unit)) << key.path;
  }
}

TEST(DescribedKeys, HelpTellsUnitRangeDefaultAndWords) {
  const std::vector<KeyEntry>& keys = scenario_keys();
  const auto find = [&](const char* path) {
    return *std::find_if(keys.begin(), keys.end(), [&](const KeyEntry& k) { return k.path == path; });
  };
  EXPECT_EQ(help_text(find("supply.voltage_V")),
            "supply.voltage_V\n  voltage of the source\n  number, in V, must be above 0 and at most 100000\n "
            " default 24\n");
  EXPECT_EQ(
      help_text(find("pwm.alignment")),
      "pwm.alignment\n  where the on-time lies in the period\n  one of the words below\n  default \"edge\"\n"
      "    edge          on-time starts with the period\n"
      "    centre        on-time lies in the middle of the period\n");
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text
