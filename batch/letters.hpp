// SPDX-License-Identifier: Apache-2.0
// Defines the messages (letters) between the processes of a cluster, and each letter as bytes
// (batch/byte_format.hpp).
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

// Letters from the leader:

/// Begins a plan.
struct Begin {
  analysis::Plan plan;
  analysis::PlanColumns columns;
  std::uint64_t jobs = 1;  ///< number of threads of each process
  std::string made_of;     ///< Briefing::made_of
};
/// Numbers of the runs that the receiver has to make.
struct Runs {
  std::vector<std::uint64_t> numbers;
};
struct Answer {
  std::uint64_t to = 0;  ///< number of the question that is answered
  std::string bytes;
};
/// Ends the plan; runs in progress are no longer needed.
struct End {};
struct Dismissed {
  std::uint64_t exit = 0;
};

// Letters to the leader:

/// Finished rows without their points, which follow from the plan. The leader joins them with its columns.
struct Rows {
  std::vector<analysis::RunValues> rows;
};
/// The sender requests more work: `idle` threads have no run, and `ahead` more runs would keep all threads
/// busy for the next moment.
struct Hungry {
  std::uint64_t idle = 0, ahead = 0;
};
struct Question {
  std::uint64_t number = 0;
  std::string bytes;
};
/// The sender will send no more rows of this plan. It has not made the runs `unmade`.
struct Gone {
  std::vector<std::uint64_t> unmade;
};

using Letter = std::variant<Begin, Runs, Answer, End, Dismissed, Rows, Hungry, Question, Gone>;

std::string bytes_of(const Letter& letter);
/// Reads a letter. Empty if the bytes are not exactly one letter.
std::optional<Letter> read(std::string_view bytes);

}  // namespace batch::letters
