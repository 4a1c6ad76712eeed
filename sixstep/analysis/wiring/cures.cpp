// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/wiring/cures.hpp"

#include <algorithm>

namespace sixstep::analysis {
namespace {

constexpr Moves all_moves[] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};

rig::WireOrder after(rig::WireOrder order, const Moves& moves) {
  const std::array<std::uint8_t, 3> from = rig::ends_of(order);
  std::array<std::uint8_t, 3> to{};
  for (std::size_t place = 0; place < 3; ++place) to[moves[place]] = from[place];
  for (const rig::Wiring& w : all_wirings())
    if (rig::ends_of(w.phases) == to) return w.phases;
  return order;  // unreachable: there are only six orders
}

/// Order of cures: 0 moves only phases, 1 only Hall lines, 2 both.
int kind_of(const Cure& c) { return moved(c.pins) == 0 ? 0 : moved(c.legs) == 0 ? 1 : 2; }

}  // namespace

rig::Wiring cured(const rig::Wiring& wiring, const Cure& cure) {
  return {.phases = after(wiring.phases, cure.legs), .probes = after(wiring.probes, cure.pins)};
}

std::vector<Cure> shortest_cures(const rig::Wiring& wiring) {
  std::vector<Cure> best;
  for (const Moves& legs : all_moves)
    for (const Moves& pins : all_moves) {
      const Cure cure{legs, pins};
      if (sectors_ahead(cured(wiring, cure)) != 0) continue;  // each pair must be driven in its own sector
      if (!best.empty() && cure.wires() > best.front().wires()) continue;
      if (!best.empty() && cure.wires() < best.front().wires()) best.clear();
      best.push_back(cure);
    }
  std::stable_sort(best.begin(), best.end(),
                   [](const Cure& a, const Cure& b) { return kind_of(a) < kind_of(b); });
  return best;
}

Cure next_step(WiringDoes does) {
  constexpr Moves swap_first = {1, 0, 2}, swap_last = {0, 2, 1}, on = {1, 2, 0};
  if (does == WiringDoes::hums || does == WiringDoes::unclear) return {.legs = swap_first};
  if (does == WiringDoes::backward) return {.legs = swap_first, .pins = swap_last};
  if (does == WiringDoes::forward) return {};
  return {.legs = on};
}

}  // namespace sixstep::analysis
