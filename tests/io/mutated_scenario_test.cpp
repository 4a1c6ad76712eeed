// SPDX-License-Identifier: Apache-2.0
// A file that uses the whole language, damaged in bytes, words and lines: it is read or told what is wrong
// with it, and what is read also compiles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "io/files/text_file.hpp"
#include "io/scenario/scenario_file.hpp"
#include "sixstep/base/random.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace io {
namespace {

using sixstep::base::uniform;

constexpr std::uint64_t seed = 20261121;

class Mutation {
 public:
  explicit Mutation(std::uint64_t number) : number_(number) {}

  std::string of(const std::string& text) {
    std::string out = text;
    for (std::size_t n = 1 + below(3); n > 0; --n) damage(out);
    return out;
  }

 private:
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(uniform({seed, number_, draws_++}) * static_cast<double>(n));
  }
  /// A stretch between two places of a kind of character, as [begin, end).
  std::pair<std::size_t, std::size_t> stretch(const std::string& text, const char* ends) {
    const std::size_t at = below(text.size());
    const std::size_t begin = text.find_last_of(ends, at), end = text.find_first_of(ends, at);
    return {begin == std::string::npos ? 0 : begin + 1, std::max(at, std::min(end, text.size()))};
  }
  void damage(std::string& text) {
    if (text.empty()) return;
    const char* ends = below(2) == 0 ? "\n" : "\n =,[]{}\"";
    const auto [begin, end] = stretch(text, ends);
    if (begin > end) return;
    const std::string piece = text.substr(begin, end - begin);
    switch (below(5)) {
      case 0:
        text.erase(begin, end - begin);
        return;
      case 1:
        text.insert(begin, piece + (ends[1] == '\0' ? "\n" : ""));
        return;
      case 2:
        text.insert(below(text.size()), piece);
        return;
      case 3:
        text.replace(begin, end - begin, words[below(std::size(words))]);
        return;
      default:
        text[below(text.size())] = static_cast<char>(below(256));
    }
  }

  static constexpr const char* words[] = {
      "\"20 mm\"", "-1",     "1e308", "nan",     "\"1e308 kV\"", "[]",   "{}",       "\"/dev\"", "[[at]]",
      "extends",   "\"..\"", "true",  "\"csv\"", "\"square\"",   "1e-9", "\"1 (A\"", "9e6",      "[at]"};
  std::uint64_t number_, draws_ = 0;
};

TEST(MutatedScenario, IsReadOrToldWhatIsWrong) {
  const auto text = read_text(SIXSTEP_SOURCE_DIR "/tests/fuzz/libfuzzer/seeds/toml/language.toml");
  ASSERT_TRUE(text);
  const auto whole = read_scenario_text("whole.toml", *text);
  ASSERT_TRUE(whole) << to_string(whole.problems()[0]);
  int read = 0, refused = 0;
  for (std::uint64_t n = 0; n < 3000; ++n) {
    const auto scenario = read_scenario_text("mutant.toml", Mutation(n).of(*text));
    if (scenario) {
      ++read;
      const auto compiled = sixstep::study::compile(*scenario);
      EXPECT_TRUE(compiled || !compiled.problems().empty()) << n;
      continue;
    }
    ++refused;
    ASSERT_FALSE(scenario.problems().empty()) << n;
    for (const base::Problem& problem : scenario.problems()) {
      EXPECT_NE(problem.where, "") << n;
      EXPECT_NE(problem.limit, "") << n;
      EXPECT_NE(problem.cure, "") << n << ": " << to_string(problem);
    }
  }
  // Both ways are walked, or the test would see one half of the reader only.
  EXPECT_GT(read, 300);
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace io
