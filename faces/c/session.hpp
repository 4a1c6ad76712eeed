// SPDX-License-Identifier: Apache-2.0
// A session of the C interface: the library's session, the caller's commands, and the texts returned to the
// caller. Functions return a status and store their problems in `problems`.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "faces/c/caller.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/rig/registers.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/session/session.hpp"

namespace c_face {

/// The text of a scenario and its name.
struct Source {
  std::string name{};  ///< name in messages; its folder contains the files that the text names
  std::string toml{};
  std::string data_folder{};
  std::vector<std::pair<std::string, std::string>> settings{};
  sixstep_chip chip = SIXSTEP_CHIP_OF_SCENARIO;
};

/// One command of the caller, kept for sixstep_save(). A long run may contain many changes of gates, so a
/// command is small.
struct Command {
  std::int64_t at_ps = 0;
  std::uint32_t gates = 0;
  std::uint32_t answer = 0;  ///< 0: the command sets gates; else the number of an answer, from 1 on
};

struct Commands {
  std::vector<Command> in_order{};
  std::vector<sixstep_answer> answers{};  ///< an answer is added only if it differs from the answer before it

  void add(std::int64_t at_ps, std::uint32_t gates) { in_order.push_back({.at_ps = at_ps, .gates = gates}); }
  void add(std::int64_t at_ps, const sixstep_answer& answer) {
    // memcmp also compares padding. Equal answers with different padding are stored twice, which only costs
    // memory.
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    if (answers.empty() || std::memcmp(&answers.back(), &answer, sizeof answer) != 0)
      answers.push_back(answer);
    in_order.push_back({.at_ps = at_ps, .answer = static_cast<std::uint32_t>(answers.size())});
  }
};

class Session {
 public:
  base::Problems problems;

  sixstep_status open(Source source);
  sixstep_status advance(double to_s);
  sixstep_status advance_to_tick();
  sixstep_status advance_to_hall_edge(double to_s);
  sixstep_status advance_to_crossing(int leg, double level_V, double to_s);
  sixstep_status change(std::string_view toml, double* at_s);
  sixstep_status measure(sixstep_measured& measured, double* setpoint);
  sixstep_status command(const sixstep_answer& answer);
  sixstep_status set_gates(std::uint32_t gates);
  sixstep_status convert(sixstep_counts& counts);
  sixstep_status finish();
  /// Repeats the commands of a saved session and advances to its instant.
  sixstep_status replay(const Commands& commands, std::uint64_t conversions, double to_s);

  /// An independent session in the same state, without its problems and texts.
  Session(const Session& other);
  Session() = default;
  Session& operator=(const Session&) = delete;
  ~Session() = default;

  bool is_open() const { return run_.has_value(); }
  const study::Scenario* scenario() const { return run_ ? &run_->scenario() : nullptr; }
  const Source& source() const { return source_; }
  const Commands& commands() const { return commands_; }
  std::uint64_t conversions() const { return conversions_; }
  double time_s() const;
  double tick_after_s(double at_s) const;
  bool applies(int index) const { return applies_[static_cast<std::size_t>(index)]; }
  double value(int index) const;
  const std::optional<std::string>& outcome() const { return outcome_; }
  std::uint64_t digest() const { return digest_; }

  sixstep_status misuse(const char* function, const char* limit, const char* cure);

  std::string described, written;  ///< texts returned to the caller, valid until the next call

 private:
  /// The run whose signals are read. With SIXSTEP_CHIP_GATES it is ahead_. run_ then stays at the last change
  /// of the gates, so that reading ends no segment.
  study::Session& seen() { return ahead_ ? *ahead_ : *run_; }
  const study::Session& seen() const { return ahead_ ? *ahead_ : *run_; }
  sixstep_status usable(const char* function);
  sixstep_status refused(base::Problems found);
  void note_what_applies();
  bool look_ahead(std::int64_t at_ps);
  template <class Side>
  sixstep_status advance_to_edge(const char* function, double to_s, const Side& side);
  sixstep_status reached(bool goes_on);
  std::int64_t now_ps() const;
  base::Result<study::Scenario> read(const std::string& more) const;

  Source source_;
  std::optional<study::Session> run_, ahead_;
  Exchange exchange_;
  rig::Registers registers_;
  std::uint64_t conversions_ = 0;
  Commands commands_;
  std::array<bool, study::column_count> applies_{};
  std::optional<std::string> outcome_;
  std::uint64_t digest_ = 0;
};

}  // namespace c_face
