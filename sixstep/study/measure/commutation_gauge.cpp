// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/commutation_gauge.hpp"

#include <algorithm>

#include "sixstep/base/angle.hpp"

namespace sixstep::study {

namespace {

/// The sector, 0 to 5, with this positive pair; -1 if none.
int sector_of_pair(const control::Pair& pair) {
  for (std::uint8_t k = 0; k < 6; ++k)
    if (control::positive_pair(k) == pair) return k;
  return -1;
}

}  // namespace

void CommutationGauge::segment(const SegmentView& g, double) {
  if (!g.modulator.pair) return;
  const rig::BoardCommand& command = g.modulator.pair->command();
  const int before = sector_, now = command.enabled ? sector_of_pair(command.pair) : none;
  sector_ = now;
  const int moved = before == none || now == none ? 0 : (now - before + 9) % 6 - 3;
  if ((moved != 1 && moved != -1) || g.t_s < window_.from_s || !(g.t_s < window_.to_s)) return;
  const double edge_deg = 60.0 * (moved > 0 ? now : before);
  const double at_deg =
      60.0 * static_cast<double>(g.plant.state().sector) + g.plant.state().x * (180.0 / base::pi);
  const double turns = (at_deg - edge_deg) / 180.0;
  const double late_deg = 180.0 * (turns - std::floor(turns + 0.5)) * moved;
  worst_deg_ = std::max(worst_deg_, std::fabs(late_deg));
  squares_ += late_deg * late_deg;
  ++count_;
}

}  // namespace sixstep::study
