// SPDX-License-Identifier: Apache-2.0
// The parts of a live rig that take long to compile. Included by the files that are named after a firmware
// only.
#pragma once
#include "sixstep/study/run/run_rig.hpp"
#include "sixstep/study/session/live_rig.hpp"

namespace sixstep::study::detail {

template <class FirmwareType>
base::Result<LiveRig<FirmwareType>> LiveRig<FirmwareType>::made(const Scenario& scenario,
                                                                const Compiled& compiled,
                                                                rig::Timeline timeline) {
  const base::Result<Chip<Firmware>> chip = chip_of<Firmware>(scenario, compiled);
  if (!chip) return chip.problems();
  return LiveRig{rig_of<Firmware>(compiled, *chip, std::move(timeline)), chip->bases};
}

template <class FirmwareType>
sim::Stop LiveRig<FirmwareType>::advance(const sim::Instant& end, Slice& slice) {
  return sim::run(rig, end, slice).stop;
}

template <class FirmwareType>
void LiveRig<FirmwareType>::look(Slice& slice) const {
  rig::Rig<double, Firmware> twin = rig;
  twin.act();
  if (twin.expand(1e-12) >= 0) slice.take(twin, 0.0, twin.now().seconds());
}

template <class FirmwareType>
base::Problems LiveRig<FirmwareType>::take(const Scenario& scenario, const Compiled& compiled,
                                           rig::Timeline timeline) {
  const base::Result<Chip<Firmware>> chip = chip_of<Firmware>(scenario, compiled);
  if (!chip) return chip.problems();
  rig.replace_future(std::move(timeline), {chip->config, chip->bases.setpoint}, chip->later);
  return {};
}

template <class FirmwareType>
base::Problems LiveRig<FirmwareType>::end(sim::Stop stop, Observers& watchers, Outcome& out) const {
  return note_end(rig, stop, watchers, out);
}

}  // namespace sixstep::study::detail
