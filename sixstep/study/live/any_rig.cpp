// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/any_rig.hpp"

#include <utility>

namespace sixstep::study::detail {

namespace {

template <class Live>
base::Result<AnyRig> made_of(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  base::Result<Live> live = Live::made(s, c, std::move(timeline));
  if (!live) return live.problems();
  return AnyRig(std::move(*live));
}

template <template <class> class Live>
base::Result<AnyRig> made_in(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  switch (s.control.arithmetic) {
    case Arithmetic::float64:
      return made_of<Live<double>>(s, c, std::move(timeline));
    case Arithmetic::float32:
      return made_of<Live<float>>(s, c, std::move(timeline));
    case Arithmetic::q15:
      return made_of<Live<control::Q15>>(s, c, std::move(timeline));
    case Arithmetic::q14:
      return made_of<Live<control::Q14>>(s, c, std::move(timeline));
    case Arithmetic::q31:
      return made_of<Live<control::Q31>>(s, c, std::move(timeline));
    case Arithmetic::q30:
      return made_of<Live<control::Q30>>(s, c, std::move(timeline));
  }
  return base::Problem{"control.arithmetic", "", "is none that there is", "see control.arithmetic"};
}

/// check() has refused the fixed formats.
template <template <class> class Live>
base::Result<AnyRig> made_in_floating_point(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  return s.control.arithmetic == Arithmetic::float32 ? made_of<Live<float>>(s, c, std::move(timeline))
                                                     : made_of<Live<double>>(s, c, std::move(timeline));
}

template <template <class> class Live>
base::Result<AnyRig> made_to_answer(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  return c.own.is->answers == SIXSTEP_ANSWERS_LEGS
             ? made_of<Live<control::LegCommands<double>>>(s, c, std::move(timeline))
             : made_of<Live<control::BridgeCommand<double>>>(s, c, std::move(timeline));
}

}  // namespace

base::Result<AnyRig> made_by(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  const bool general = c.general.has_value();
  if (c.board.chip)
    return general ? made_of<ChipOnGeneral>(s, c, std::move(timeline))
                   : made_of<ChipRig>(s, c, std::move(timeline));
  switch (s.control.drive) {
    case FirmwareKind::product:
      return general ? made_in<ProductOnGeneral>(s, c, std::move(timeline))
                     : made_in<ProductRig>(s, c, std::move(timeline));
    case FirmwareKind::sensorless:
      return general ? made_in<SensorlessOnGeneral>(s, c, std::move(timeline))
                     : made_in<SensorlessRig>(s, c, std::move(timeline));
    case FirmwareKind::field:
      return general ? made_in_floating_point<FieldOnGeneral>(s, c, std::move(timeline))
                     : made_in_floating_point<FieldRig>(s, c, std::move(timeline));
    case FirmwareKind::own:
      return general ? made_to_answer<OwnOnGeneral>(s, c, std::move(timeline))
                     : made_to_answer<OwnRig>(s, c, std::move(timeline));
    case FirmwareKind::lean:
      break;
  }
  if (general) return made_in<SensedOnGeneral>(s, c, std::move(timeline));
  return c.board.sensors.ideal() && !c.board.core ? made_in<LeanRig>(s, c, std::move(timeline))
                                                  : made_in<SensedRig>(s, c, std::move(timeline));
}

}  // namespace sixstep::study::detail
