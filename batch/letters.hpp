// SPDX-License-Identifier: Apache-2.0
// Defines the messages (struct names and Letter) between the processes of a cluster, and converts each
// message to bytes and back (batch/byte_format.hpp).
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

// Messages from the leader:

/// Begins a plan.
struct Begin {
  analysis::Plan plan;
  analysis::PlanColumns columns;
  std::uint64_t jobs = 1;  ///< number of threads of each process
  std::string made_of;     ///< Briefing::made_of
};
/// Numbers of the runs that the receiver must make.
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

// Messages to the leader:

/// Finished rows without their points, which the leader computes from the plan. The leader adds its columns.
struct Rows {
  std::vector<analysis::RunValues> rows;
};
/// Requests more runs: `idle` threads have no run, and `ahead` further runs would keep all threads busy for a
/// moment.
struct Hungry {
  std::uint64_t idle = 0, ahead = 0;
};
struct Question {
  std::uint64_t number = 0;
  std::string bytes;
};
/// The sender sends no more rows of this plan. It has not made the runs `unmade`.
struct Gone {
  std::vector<std::uint64_t> unmade;
};

using Letter = std::variant<Begin, Runs, Answer, End, Dismissed, Rows, Hungry, Question, Gone>;

std::string bytes_of(const Letter& letter);
/// Reads a message. Empty if the bytes are not exactly one message.
std::optional<Letter> read(std::string_view bytes);

}  // namespace batch::letters
