// SPDX-License-Identifier: Apache-2.0
// Every key of a reference has an effect. It changes the reference over time, or a message names the key and
// refuses it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/check/reference_keys.hpp"
#include "sixstep/study/scenario/reference_description.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::Reference;
using study::Shape;

std::vector<Reference> one_of_each_shape() {
  return {{.value = 1.0},
          {.shape = Shape::steps, .times_s = {0.0, 1e-3}, .values = {1.0, 2.0}},
          {.shape = Shape::square, .high = 4.0, .low = -4.0, .period_s = 2e-3},
          {.shape = Shape::ramp, .begin_s = 1e-3, .start = 1.0, .end = 6.0, .end_s = 5e-3},
          {.shape = Shape::sine, .offset = 1.0, .amplitude = 1.0, .frequency_Hz = 100.0, .phase_deg = 90.0},
          {.shape = Shape::trapezoid,
           .begin_s = 1e-3,
           .start = 1.0,
           .end = 6.0,
           .slope = 2e3,
           .acceleration = 2e6},
          {.shape = Shape::csv, .times_s = {0.0, 1e-3}, .values = {1.0, 2.0}}};
}

/// Visits the keys of a description and counts them. It sets the key with the number `wanted` to another
/// valid value.
class AnotherValue final : public base::Visitor {
 public:
  explicit AnotherValue(std::size_t wanted) : wanted_(wanted) {}
  std::size_t n = 0;
  std::string key;

 private:
  bool is_wanted(std::string_view name) {
    if (n++ != wanted_) return false;
    key = name;
    return true;
  }
  void visit_value(std::string_view name, const base::ValueMember& member, const base::About&) override {
    if (is_wanted(name)) std::visit([](auto* of) { change(*of); }, member);
  }
  void visit_word(std::string_view name, base::WordMember& member, const base::About&) override {
    if (is_wanted(name)) member.choose(member.size() - 1);
  }
  static void change(double& x) { x = x == 0.0 ? 1e-3 : 1.25 * x; }
  static void change(std::optional<double>& x) { x = x.value_or(4e-3) * 1.25; }
  static void change(std::vector<double>& list) {
    if (list.empty()) list = {0.0, 1e-3};
    list.back() *= 2;
  }
  static void change(std::string& text) { text = "x.csv"; }
  static void change(std::optional<std::string>& text) { text = "speed"; }
  template <class Other>
  static void change(Other&) {
    ADD_FAILURE() << "a kind of value that a reference did not have";
  }
  std::size_t wanted_;
};

study::Scenario with(const Reference& r) {
  study::Scenario s = maxon_scenario(control::Mode::current, 0.0);
  s.duration_s = 10e-3;
  s.reference = r;
  return s;
}

bool asks_for_the_same(const Reference& one, const Reference& other) {
  const std::vector<study::Stretch> a = study::reference_waveform(with(one)),
                                    b = study::reference_waveform(with(other));
  const auto at = [](const std::vector<study::Stretch>& all, double t_s) {
    const auto next = std::find_if(all.begin(), all.end(), [t_s](const auto& s) { return s.at_s > t_s; });
    return (next - 1)->at(t_s);
  };
  for (int n = 0; n < 500; ++n)
    if (at(a, n * 2e-5) != at(b, n * 2e-5)) return false;
  return true;
}

TEST(ReferenceKeys, EachChangesWhatIsAskedForOrIsRefusedByName) {
  for (const Reference& good : one_of_each_shape()) {
    ASSERT_TRUE(study::check(with(good)).empty()) << base::to_string(study::check(with(good))[0]);
    std::size_t keys = 1, refused = 0;
    for (std::size_t n = 0; n < keys; ++n) {
      Reference changed = good;
      AnotherValue walk(n);
      describe(walk, changed);
      keys = walk.n;
      // The content of the file is read before this visit. The shape selects which other keys are used.
      if (walk.key == "shape" || (walk.key == "file" && good.shape == Shape::csv)) continue;
      const base::Problems problems = study::check(with(changed));
      SCOPED_TRACE(walk.key + " of " + std::string(base::word(study::shape_choices, good.shape)));
      if (problems.empty()) {
        EXPECT_FALSE(asks_for_the_same(good, changed)) << "given, and without effect";
        continue;
      }
      ++refused;
      EXPECT_EQ(problems[0].where, "reference." + walk.key);
      EXPECT_FALSE(problems[0].cure.empty());
    }
    EXPECT_GT(refused, 5u);
  }
}

/// The table of good references has a row for each key of the description.
TEST(ReferenceKeys, TheTableHasAllOfThem) {
  std::vector<std::string> described, rows;
  for (std::size_t n = 0, keys = 1; n < keys; ++n) {
    Reference r;
    AnotherValue walk(n);
    describe(walk, r);
    keys = walk.n;
    if (walk.key != "shape" && walk.key != "unit") described.push_back(walk.key);
  }
  for (const study::ShapeKey& row : study::shape_keys) rows.emplace_back(row.key);
  EXPECT_EQ(described, rows);
}

TEST(ReferenceKeys, ARampBesideAListIsRefused) {
  Reference r = one_of_each_shape()[3];
  r.times_s = {0.0, 1e-3};
  r.values = {1.0, 2.0};
  const base::Problems problems = study::check(with(r));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(
      base::to_string(problems[0]),
      "reference.times_s has no effect with shape = \"ramp\"; set shape = \"steps\" or \"csv\", or remove this key; if an extended file has this key, reference = { .. } replaces all keys of the extended file's reference");
  EXPECT_EQ(problems[1].where, "reference.values");
}

TEST(ReferenceKeys, WhatATableOfTheLoadLeavesNothingForIsRefused) {
  const auto told = [](const study::Load& load) {
    study::Scenario s = with({.value = 1.0});
    s.load = load;
    const base::Problems problems = study::check(s);
    return problems.empty() ? "" : problems[0].where;
  };
  study::Load load;
  load.torque_Nm = 0.01;
  load.times_s = {0.0};
  load.torques_Nm = {0.02};
  EXPECT_EQ(told(load), "load.torque_Nm");
  load.times_s = {1e-3};
  EXPECT_EQ(told(load), "") << "until then it acts";
  study::Load lines;
  lines.between = study::Between::lines;
  EXPECT_EQ(told(lines), "load.between");
}

}  // namespace SIXSTEP_TEST_FILE
