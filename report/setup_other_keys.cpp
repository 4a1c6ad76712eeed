// SPDX-License-Identifier: Apache-2.0
// Finds the keys of a scenario that no sentence of its set-up states.
#include <fmt/format.h>

#include <concepts>
#include <utility>

#include "report/scenario_differences.hpp"
#include "report/setup_words.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"

namespace report {
namespace {

using sixstep::base::About;
using sixstep::base::Motion;
using sixstep::study::Scenario;

void alter(double& x) { x = x == 0.0 ? 1.0 : 1.25 * x; }
void alter(int& x) { ++x; }
void alter(bool& x) { x = !x; }
void alter(std::string& x) { x += '_'; }
template <class T>
void alter(std::vector<T>& list) {
  for (T& x : list) alter(x);
}
template <class T>
void alter(std::optional<T>& x) {
  if (x) alter(*x);
}

/// Sets one key to another value.
class KeyChange final : public sixstep::base::Visitor {
 public:
  KeyChange(std::string key, Motion motion) : key_(std::move(key)), motion_(motion) {}

 private:
  bool is_it(std::string_view key) const { return key_ == path_ + std::string(key); }
  void visit_value(std::string_view key, const sixstep::base::ValueMember& member,
                   const About& about) override {
    const sixstep::base::Spelling* linear = motion_.linear ? linear_spelling(about) : nullptr;
    if (is_it(linear ? std::string_view(linear->key) : key)) std::visit([](auto* of) { alter(*of); }, member);
  }
  void visit_word(std::string_view key, sixstep::base::WordMember& member, const About&) override {
    if (is_it(key)) member.choose((member.chosen() + 1) % member.size());
  }
  void visit_table(std::string_view key, sixstep::base::TableMember& member, const About&) override {
    if (!member.is_there()) return;
    const std::string outer = std::exchange(path_, path_ + std::string(key) + ".");
    member.walk(*this);
    path_ = outer;
  }
  void visit_list(std::string_view key, sixstep::base::ListMember& items, const About&) override {
    if (key != sixstep::study::events_list) return;
    const std::string outer = path_;
    for (std::size_t n = 0; n < items.size(); ++n) {
      path_ = fmt::format("at[{}].", n);
      items.walk(n, *this);
    }
    path_ = outer;
  }

  std::string key_;
  Motion motion_;
  std::string path_;
};

/// The first eight values of a list.
std::string shortened(const std::string& text) {
  constexpr int most = 8;
  std::size_t end = 0;
  for (int n = 0; n < most; ++n) {
    end = text.find(", ", end);
    if (end == std::string::npos) return text;
    end += 2;
  }
  return text.substr(0, end) + "…";
}

/// Whether a key's value is printed elsewhere on the page, or only determines units.
bool stands_elsewhere(const std::string& key) {
  return key == "not_usable" || key.ends_with("reference.unit");
}

/// A scenario with the same motor, duration and number of events; each other key has its default.
Scenario all_default(const Scenario& s) {
  Scenario usual;
  usual.motor = s.motor;
  usual.sheet = s.sheet;
  usual.duration_s = s.duration_s;
  usual.at.resize(s.at.size());
  for (std::size_t n = 0; n < s.at.size(); ++n)
    if (s.at[n].reference) usual.at[n].reference.emplace();
  return usual;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> other_keys(
    const Scenario& s, const std::function<std::string(const Scenario&)>& sentences) {
  const Scenario usual = all_default(s);
  const std::string told = sentences(s);
  const Motion motion = sixstep::design::motion_of(s.sheet);
  std::vector<std::pair<std::string, std::string>> out;
  for (KeyDifference& difference : differences({&usual, &s})) {
    if (stands_elsewhere(difference.key)) continue;
    Scenario other = s;
    KeyChange changed(difference.key, motion);
    describe(changed, other);
    if (sentences(other) == told)
      out.emplace_back(std::move(difference.key), shortened(difference.values[1]));
  }
  return out;
}

}  // namespace report
