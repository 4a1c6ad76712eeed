// SPDX-License-Identifier: Apache-2.0
// What a wiring is called, what it does and what cures it, in words: for the terminal, for programs and for the page.
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

/// "bac" of the phases at legs a, b, c; "213" of the probes at pins H1, H2, H3: as a scenario has them.
std::string_view phases_word(const sixstep::rig::Wiring& wiring);
std::string_view hall_lines_word(const sixstep::rig::Wiring& wiring);

/// In the order in which they are told: what runs forward, what hums, what runs backward.
std::span<const analysis::WiringDoes> told_order();

/// "backward, late"; as a name for programs "backward_late".
std::string_view does_text(analysis::WiringDoes does);
/// Beside an arrow that tells the direction: "late".
std::string_view short_does_text(analysis::WiringDoes does);
std::string_view does_name(analysis::WiringDoes does);

/// What a person at the bench sees: "runs rough; 17 times the current".
std::string symptom_text(const analysis::WiringStudy& study, analysis::WiringDoes does);

/// "swap the phase wires at legs b and c"; "move the Hall lines on: H1 to H2, H2 to H3, H3 to H1"; "nothing".
std::string cure_text(const analysis::Cure& cure);
/// The same for a cell: "b-c", "H1>H2>H3", "a-b H2-H3", "-".
std::string cure_mark(const analysis::Cure& cure);

/// What to do then where nobody knows which wire is which (analysis::next_step).
std::string_view next_step_text(analysis::WiringDoes does);

/// What is seen, and the step that follows (analysis::next_step).
std::span<const std::pair<std::string_view, std::string_view>> recipe_steps();
/// Why the last of them cannot be done with phase wires alone.
std::string_view recipe_note();

/// The mechanical way of an electrical angle, with its unit: "5.6 deg", of a linear motor "1.2 mm".
std::string way_text(const analysis::WiringStudy& study, double electrical_deg);
/// "766 rpm", "0.25 m/s".
std::string wiring_speed_text(const analysis::WiringStudy& study, double rad_s);
/// "24 V, duty 0.1, nothing on the shaft; stalled it draws 2.33 A, its nominal current, at full duty 23.3 A".
std::string bench_text(const analysis::WiringStudy& study);

/// Above the scenario of the bench: what it is and how to cross its wires.
std::vector<std::string> wiring_scenario_lines();

}  // namespace text
