// SPDX-License-Identifier: Apache-2.0
// Describes a wiring, the motor's behaviour and the cure in words, for the terminal, JSON and the page.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sixstep/analysis/wiring/wiring_study.hpp"
#include "sixstep/base/linear.hpp"
#include "text/rooms.hpp"

namespace text {

inline constexpr std::string_view leg_names[] = {"a", "b", "c"}, hall_pin_names[] = {"H1", "H2", "H3"};

/// The order of the wires as in a scenario: "bac" are the phases at legs a, b, c; "213" are the probes at
/// pins H1, H2, H3.
std::string_view phases_word(const sixstep::rig::Wiring& wiring);
std::string_view hall_lines_word(const sixstep::rig::Wiring& wiring);

/// The behaviours in the order of output: forward, humming, backward.
std::span<const analysis::WiringDoes> told_order();

/// The behaviour in words: "backward, late"; does_name() gives "backward_late" for JSON.
std::string_view does_text(analysis::WiringDoes does);
/// The behaviour without its direction, which the output shows as an arrow: "late".
std::string_view short_does_text(analysis::WiringDoes does);
std::string_view does_name(analysis::WiringDoes does);

/// The symptom at the bench: "runs rough; 17 times the current".
std::string symptom_text(const analysis::WiringStudy& study, analysis::WiringDoes does);

/// The cure in words: "swap the phase wires at legs b and c"; "move the Hall lines: H1 to H2, H2 to H3, H3 to
/// H1"; "nothing".
std::string cure_text(const analysis::Cure& cure);
/// The cure in the length of a table cell: "b-c", "H1>H2>H3", "a-b H2-H3", "-".
std::string cure_mark(const analysis::Cure& cure);

/// The next step if the wires are not labelled (analysis::next_step).
std::string_view next_step_text(analysis::WiringDoes does);

/// Each symptom with the step that follows (analysis::next_step).
std::span<const std::pair<std::string_view, std::string_view>> recipe_steps();
/// The reason why the last step cannot be done with phase wires alone.
std::string_view recipe_note();

/// The mechanical displacement that corresponds to an electrical angle, with its unit: "5.6 deg", for a
/// linear motor "1.2 mm".
std::string way_text(const analysis::WiringStudy& study, double electrical_deg);
/// A speed with its unit: "766 rpm", "0.25 m/s".
std::string wiring_speed_text(const analysis::WiringStudy& study, double rad_s);
/// The bench in words: "24 V, duty 0.1, no load; the stalled motor draws 2.33 A, its nominal current, at full
/// duty 23.3 A".
std::string bench_text(const analysis::WiringStudy& study);

/// The comment above the bench's scenario: its purpose, and how a user crosses wires in it.
std::vector<std::string> wiring_scenario_lines();

}  // namespace text
