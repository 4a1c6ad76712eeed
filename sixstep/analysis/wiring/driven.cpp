// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/wiring/driven.hpp"

#include "sixstep/control/commutation.hpp"

namespace sixstep::analysis {
namespace {

using rig::WireOrder;

constexpr WireOrder orders[] = {WireOrder::abc, WireOrder::bca, WireOrder::cab,
                                WireOrder::acb, WireOrder::cba, WireOrder::bac};

/// The sector in which a drive with straight wires drives the pair of source and sink.
int sector_of(std::size_t source, std::size_t sink) {
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    const control::Pair pair = control::positive_pair(sector);
    if (static_cast<std::size_t>(pair.source) == source && static_cast<std::size_t>(pair.sink) == sink)
      return sector;
  }
  return 0;  // unreachable: the table contains each of the six pairs once
}

}  // namespace

Commutation commutation(std::uint8_t sector) {
  const control::Pair pair = control::positive_pair(sector);
  const auto high = static_cast<std::size_t>(pair.source), low = static_cast<std::size_t>(pair.sink);
  return {control::hall_of_sector(sector), high, low, 3 - high - low};
}

std::array<rig::Wiring, ways_to_plug_in> all_wirings() {
  std::array<rig::Wiring, ways_to_plug_in> all{};
  std::size_t n = 0;
  for (const WireOrder phases : orders)
    for (const WireOrder probes : orders) all[n++] = {.phases = phases, .probes = probes};
  return all;
}

Driven driven(const rig::Wiring& wiring, std::uint8_t sector) {
  const std::uint8_t seen = control::sector_of_hall(wiring.at_pins(control::hall_of_sector(sector)));
  const control::Pair legs = control::positive_pair(seen);
  Driven out{.seen = seen,
             .source = wiring.phase(static_cast<std::size_t>(legs.source)),
             .sink = wiring.phase(static_cast<std::size_t>(legs.sink))};
  out.ahead = (sector_of(out.source, out.sink) + 6 - sector) % 6;
  return out;
}

std::optional<int> sectors_ahead(const rig::Wiring& wiring) {
  const int first = driven(wiring, 0).ahead;
  for (std::uint8_t sector = 1; sector < 6; ++sector)
    if (driven(wiring, sector).ahead != first) return std::nullopt;
  return first;
}

}  // namespace sixstep::analysis
