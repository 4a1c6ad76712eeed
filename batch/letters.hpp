// SPDX-License-Identifier: Apache-2.0
// What the processes of a cluster tell each other, and each letter as bytes (batch/byte_format.hpp).
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "batch/rooms.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"

namespace batch::letters {

// From the leader.

/// A plan begins.
struct Begin {
  analysis::Plan plan;
  analysis::PlanColumns columns;
  std::uint64_t jobs = 1;  ///< threads of each process
  std::string made_of;     ///< Briefing's
};
/// These are yours.
struct Runs {
  std::vector<std::uint64_t> numbers;
};
struct Answer {
  std::uint64_t to = 0;  ///< number of the question
  std::string bytes;
};
/// The plan ends; what is under way is not wanted any more.
struct End {};
struct Dismissed {
  std::uint64_t exit = 0;
};

// To the leader.

/// Rows that are finished, without their points: the plan tells those. The leader sets them under its columns again.
struct Rows {
  std::vector<analysis::RunValues> rows;
};
/// Work is running out. `idle` threads have none; `ahead` more would keep all busy for the next moment.
struct Hungry {
  std::uint64_t idle = 0, ahead = 0;
};
struct Question {
  std::uint64_t number = 0;
  std::string bytes;
};
/// No more rows of this plan will come from here, and these runs were not made.
struct Gone {
  std::vector<std::uint64_t> unmade;
};

using Letter = std::variant<Begin, Runs, Answer, End, Dismissed, Rows, Hungry, Question, Gone>;

std::string bytes_of(const Letter& letter);
/// Nothing where the bytes are no letter, to the last one.
std::optional<Letter> read(std::string_view bytes);

}  // namespace batch::letters
