// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/any_run.hpp"

#include <utility>

#include "sixstep/study/live/rigs.hpp"

namespace sixstep::study::detail {

namespace {

MadeRun made_with(PairChip (*chip)(const Scenario&, const Compiled&), const Scenario& s, const Compiled& c,
                  rig::Timeline timeline) {
  return c.general ? pair_run_on_general(chip, s, c, std::move(timeline))
                   : pair_run(chip, s, c, std::move(timeline));
}
MadeRun made_with(LegChip (*chip)(const Scenario&, const Compiled&), const Scenario& s, const Compiled& c,
                  rig::Timeline timeline) {
  return c.general ? leg_run_on_general(chip, s, c, std::move(timeline))
                   : leg_run(chip, s, c, std::move(timeline));
}

}  // namespace

MadeRun made_by(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  if (c.board.chip)
    return c.general ? gate_run_on_general(s, c, std::move(timeline)) : gate_run(s, c, std::move(timeline));
  switch (s.control.drive) {
    case FirmwareKind::product:
      return made_with(product_chip, s, c, std::move(timeline));
    case FirmwareKind::sensorless:
      return made_with(sensorless_chip, s, c, std::move(timeline));
    case FirmwareKind::field:
      return made_with(field_chip, s, c, std::move(timeline));
    case FirmwareKind::own:
      return c.own.is->answers == SIXSTEP_ANSWERS_LEGS ? made_with(own_leg_chip, s, c, std::move(timeline))
                                                       : made_with(own_pair_chip, s, c, std::move(timeline));
    case FirmwareKind::lean:
      break;
  }
  // With ideal sensors, the lean drive and the drive with sensors have bit-identical results, and the lean
  // drive is faster.
  const bool alone = c.board.sensors.ideal() && !c.board.core && !c.general;
  return alone && s.control.arithmetic == Arithmetic::float64
             ? lean_run(s, c, std::move(timeline))
             : made_with(sensed_chip, s, c, std::move(timeline));
}

}  // namespace sixstep::study::detail
