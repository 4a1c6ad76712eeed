// SPDX-License-Identifier: Apache-2.0
// The measured cases, read before the timed loop.
#pragma once
#include <optional>
#include <string>

#include "benchmarks/yardstick.hpp"
#include "files/scenario_on_disk.hpp"
#include "sixstep/rig/lean_rig.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace benchmarks {

inline constexpr double period_s = 30e-6;

struct Case {
  const char* name;
  const char* scenario;
  const char* trajectory;  ///< file in tests/reference; empty: none
  YardstickMode mode;
  double reference,
      reverse_s;  ///< reference of the yardsticks; its sign is reversed every reverse_s if reverse_s is above 0
  double judged_s;  ///< the errors are computed up to this time
};

/// In R6, a Hall edge is 0.25 us after the tick at 13.26 ms. With a fixed step, the edge is before or after
/// the tick by chance.
inline constexpr Case cases[] = {
    {"R2 voltage run-up", "reference/R2.toml", "R2.csv", YardstickMode::duty, 1.0, 0.0, 1.0},
    {"R3 soft chopping", "reference/R3.toml", "R3.csv", YardstickMode::duty, 0.5, 0.0, 1.0},
    {"R6 current PI", "reference/R6.toml", "R6.csv", YardstickMode::current, 5.0, 5e-3, 13.2e-3},
    {"7.4 speed cascade", "thesis/7.4-speed-thesis-gains.toml", "", YardstickMode::speed, 100.0, 0.0, 0.0},
};

/// Cases that only the general kernel can run; no yardstick can run them.
inline constexpr Case wider_cases[] = {
    {"G1 delta", "reference/G1.toml", "G1.csv", YardstickMode::duty, 0.0, 0.0, 1.0},
    {"G6 salient rotor", "reference/G6.toml", "G6.csv", YardstickMode::duty, 0.0, 0.0, 1.0},
    {"G9 elastic shaft", "reference/G9.toml", "G9.csv", YardstickMode::duty, 0.0, 0.0, 1.0},
};

inline std::string trajectory_file(const Case& c) {
  return std::string(SIXSTEP_SOURCE_DIR "/tests/reference/") + c.trajectory;
}

/// Reads a case. Empty if the files cannot be read. A duration above zero replaces the scenario's duration.
inline std::optional<sixstep::study::Scenario> read(const Case& c, double duration_s) {
  auto scenario = files::read_scenario(std::string(SIXSTEP_SOURCE_DIR "/data/scenarios/") + c.scenario, {});
  if (!scenario) return std::nullopt;
  if (duration_s > 0) scenario->duration_s = duration_s;
  return std::move(*scenario);
}

/// A case, compiled for the engine. The rigs that rig() returns start at rest. They refer to this object,
/// which must outlive them.
class Prepared {
 public:
  using Rig = sixstep::rig::LeanRig<double>;

  using GeneralRig = sixstep::study::GeneralRig<sixstep::rig::LeanDrive<double>>;

  /// Empty if the files cannot be read.
  static std::optional<Prepared> of(const Case& c, double duration_s = 0.0) {
    return of(c, duration_s, false);
  }
  /// Like of(), for general_rig(): the case runs on the general kernel.
  static std::optional<Prepared> on_general(const Case& c) { return of(c, 0.0, true); }
  Rig rig() const {
    const auto& c = compiled_;
    return {{c.motor.machine, c.shaft, c.devices, c.supply, c.start}, c.drive, c.board, c.timeline};
  }
  GeneralRig general_rig() const {
    return sixstep::study::general_rig_of<sixstep::rig::LeanDrive<double>>(
        compiled_, {compiled_.drive, {}, {}}, compiled_.timeline);
  }
  sixstep::sim::Instant end() const { return compiled_.end; }
  const sixstep::study::Scenario& scenario() const { return scenario_; }

 private:
  static std::optional<Prepared> of(const Case& c, double duration_s, bool on_general) {
    auto scenario = read(c, duration_s);
    if (!scenario) return std::nullopt;
    if (on_general) {  // an event sets straight wires: only the general kernel supports this event
      sixstep::study::At straight;
      straight.bridge.phases = sixstep::study::AtOrder::abc;
      scenario->at.push_back(straight);
    }
    auto compiled = sixstep::study::compile(*scenario);
    if (!compiled || compiled->general.has_value() != on_general) return std::nullopt;
    return Prepared(std::move(*scenario), std::move(*compiled));
  }
  Prepared(sixstep::study::Scenario scenario, sixstep::study::Compiled compiled)
      : scenario_(std::move(scenario)), compiled_(std::move(compiled)) {}

  sixstep::study::Scenario scenario_;
  sixstep::study::Compiled compiled_;
};

}  // namespace benchmarks
