// SPDX-License-Identifier: Apache-2.0
// Prints Hall codes, wires and legs as words.
#pragma once
#include <cstdint>
#include <string>

#include "sixstep/analysis/identification/hall/identify.hpp"
#include "text/rooms.hpp"

namespace text {

/// A code as digits: "101", H1 first.
std::string code_word(std::uint8_t code);
/// Probes as digits: "231" are the probes at pins H1, H2, H3, as in a scenario's hall_lines.
std::string probes_word(sixstep::rig::WireOrder probes);
/// Inverted lines as a scenario's hall_inverted has them: "none", "13".
std::string inverted_word(std::uint8_t inverted);
/// A leg's letter: 'a', 'b' or 'c'.
char leg_word(sixstep::control::Leg leg);
/// A wiring in words: "probes 120 degrees apart, probes 2 3 1 at H1 H2 H3, H2 inverted".
std::string wires_words(const analysis::HallWires& wires);
/// The moves of the wires after which every probe is at its own pin: "from H1 to H3, from H2 to H1". Empty if
/// every probe is already at its pin.
std::string moves_words(sixstep::rig::WireOrder probes);
/// The lines of a scenario's [sensors], each with a line end.
std::string sensor_lines(const analysis::HallIdentity& found);

}  // namespace text
