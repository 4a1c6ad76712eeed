// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/hall_wires.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "sixstep/control/commutation.hpp"
#include "sixstep/control/hall.hpp"

namespace sixstep::analysis {
namespace {

/// The code of probes 60 degrees apart that control::as_120_degrees() converts to this code.
std::uint8_t as_60_degrees(std::uint8_t code) {
  for (std::uint8_t of_60 = 0; of_60 < 8; ++of_60)
    if (control::as_120_degrees(control::HallArrangement::degrees_60, of_60) == code) return of_60;
  return 0;
}

/// Number of wiring errors that explain the inverted lines. One stage or magnet inverts all three lines at
/// once: one error. Two inverted lines are two errors.
int inversions(std::uint8_t inverted) { return inverted == 0b111 ? 1 : std::popcount(inverted); }

constexpr rig::WireOrder wire_orders[] = {rig::WireOrder::abc, rig::WireOrder::bca, rig::WireOrder::cab,
                                          rig::WireOrder::acb, rig::WireOrder::cba, rig::WireOrder::bac};

}  // namespace

PinCodes codes_behind(const HallWires& wires) {
  rig::Wiring wiring;
  wiring.probes = wires.probes;
  wiring.inverted = wires.inverted;
  PinCodes out{};
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    const std::uint8_t probes = control::hall_of_sector(sector);
    out[sector] = wiring.at_pins(wires.spaced_60 ? as_60_degrees(probes) : probes);
  }
  return out;
}

std::vector<HallWires> wires_behind(const PinCodes& codes) {
  std::vector<HallWires> out;
  for (const bool spaced_60 : {false, true})
    for (const rig::WireOrder order : wire_orders)
      for (std::uint8_t inverted = 0; inverted < 8; ++inverted)
        if (const HallWires wires{spaced_60, order, inverted}; codes_behind(wires) == codes)
          out.push_back(wires);
  std::stable_sort(out.begin(), out.end(), [](const HallWires& a, const HallWires& b) {
    const auto rank = [](const HallWires& w) {
      return std::tuple(inversions(w.inverted), w.spaced_60, static_cast<int>(w.probes));
    };
    return rank(a) < rank(b);
  });
  return out;
}

}  // namespace sixstep::analysis
