// SPDX-License-Identifier: Apache-2.0
#include "text/results/hall_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "text/results/interval_text.hpp"

namespace text {

namespace rig = sixstep::rig;

std::string code_word(std::uint8_t code) {
  return fmt::format("{}{}{}", code >> 2 & 1, code >> 1 & 1, code & 1);
}

std::string probes_word(rig::WireOrder probes) {
  std::string out;
  for (const std::uint8_t probe : rig::ends_of(probes)) out += static_cast<char>('1' + probe);
  return out;
}

std::string inverted_word(std::uint8_t inverted) {
  std::string out;
  for (unsigned pin = 0; pin < 3; ++pin)
    if ((inverted >> (2U - pin) & 1U) != 0) out += static_cast<char>('1' + pin);
  return out.empty() ? "none" : out;
}

char leg_word(sixstep::control::Leg leg) {
  switch (leg) {
    case sixstep::control::Leg::a:
      return 'a';
    case sixstep::control::Leg::b:
      return 'b';
    default:
      return 'c';
  }
}

std::string wires_words(const analysis::HallWires& wires) {
  std::string out = fmt::format("probes {} degrees apart, ", wires.spaced_60 ? 60 : 120);
  const std::string probes = probes_word(wires.probes);
  out += probes == "123" ? "each at its own pin"
                         : fmt::format("probes {} {} {} at H1 H2 H3", probes[0], probes[1], probes[2]);
  if (wires.inverted == 0) return out;
  std::string pins;
  for (const char pin : inverted_word(wires.inverted)) pins += std::string(pins.empty() ? "H" : " H") + pin;
  return out + ", " + pins + " inverted";
}

std::string moves_words(rig::WireOrder probes) {
  std::string out;
  const auto ends = rig::ends_of(probes);
  for (std::size_t pin = 0; pin < 3; ++pin)
    if (ends[pin] != pin)
      out += fmt::format("{}the wire at H{} to H{}", out.empty() ? "" : ", ", pin + 1, ends[pin] + 1);
  return out;
}

std::string sensor_lines(const analysis::HallIdentity& found) {
  const analysis::IdentifiedPlace* const place = found.place ? &*found.place : nullptr;
  std::string out = "[sensors]\n";
  if (place) {
    const analysis::HallWires& wires = place->wires.front();
    out += fmt::format("hall_lines = \"{}\"\nhall_inverted = \"{}\"\nhall_spacing = \"{}\"\n",
                       probes_word(wires.probes), inverted_word(wires.inverted), wires.spaced_60 ? 60 : 120);
    out += fmt::format("hall_offset_deg = {}  # 95 %: {}\n", measured_text(place->offset_deg),
                       bounds_text(place->offset_deg));
  } else if (found.mask == 0b010) {
    out += "hall_spacing = \"60\"\n";
  }
  // If the log does not show the rotor's angle, the first edge and the signs are left out: a rotor that
  // turned in the opposite direction would fit the log as well.
  if (!place)
    return out +
           "# without hall_edges_deg: Hall codes show neither the first edge nor the rotor's direction; also record u_ab and u_bc\n";
  out += "hall_edges_deg = [";
  double width = 0.0;
  for (std::size_t n = 0; n < found.edges.size(); ++n) {
    out += (n == 0 ? "" : ", ") + measured_text(found.edges[n].own_deg);
    width = std::fmax(width, found.edges[n].own_deg.half_width());
  }
  out += fmt::format("]  # each +- {:.2g} or less, 95 %\n", width);
  if (place->hysteresis_deg)
    out += fmt::format("hall_hysteresis_deg = {}  # 95 %: {}\n",
                       as_good_as(std::fmax(0.0, place->hysteresis_deg->value), *place->hysteresis_deg),
                       bounds_text(*place->hysteresis_deg));
  return out;
}

}  // namespace text
