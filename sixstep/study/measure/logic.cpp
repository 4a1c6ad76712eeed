// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/logic.hpp"

namespace sixstep::study {

const std::vector<LogicSignal>& logic_signals() {
  constexpr LogicKind level = LogicKind::level;
  static const std::vector<LogicSignal> signals = {
      {"gates", "T1", 1, level, "upper gate of a"},
      {"gates", "T2", 1, level, "lower gate of a"},
      {"gates", "T3", 1, level, "upper gate of b"},
      {"gates", "T4", 1, level, "lower gate of b"},
      {"gates", "T5", 1, level, "upper gate of c"},
      {"gates", "T6", 1, level, "lower gate of c"},
      {"hall", "H1", 1, level, "Hall line 1 at the board's pin"},
      {"hall", "H2", 1, level, "Hall line 2"},
      {"hall", "H3", 1, level, "Hall line 3"},
      {"hall", "sector", 3, level, "electrical sector 0 to 5"},
      {"encoder", "A", 1, level, "line A at the board's pin; x: no encoder"},
      {"encoder", "B", 1, level, "line B"},
      {"encoder", "Z", 1, level, "the index"},
      {"encoder", "code", 20, level, "Gray code that was latched last; x: no absolute encoder"},
      {"timer", "tick", 1, LogicKind::event, "a control tick"},
      {"timer", "periods", 32, level, "number of control ticks so far"},
      {"timer", "pwm", 1, level, "command for the source leg's switch, without regard to dead time"},
      {"timer", "enabled", 1, level, "the controller drives the bridge"},
      {"comparators", "comparator_1", 1, level,
       "comparator of the motor current or of the source leg; x: not armed"},
      {"comparators", "comparator_2", 1, level, "comparator of the sink leg; x: not armed"},
      {"faults", "shoot_through", 1, level, "both gates of a leg were on"},
      {"faults", "impossible_hall", 1, level, "the drive read the Hall code 000 or 111 and ended the run"},
      {"faults", "shaft_sensor", 1, level,
       "the drive received impossible signals from its encoder or resolver and ended the run"},
      {"faults", "over_current", 1, level, "the product drive tripped"},
      {"faults", "over_voltage", 1, level, "the product drive tripped"},
      {"faults", "under_voltage", 1, level, "the product drive tripped"},
      {"faults", "over_speed", 1, level, "the product drive tripped"},
      {"faults", "hall", 1, level, "the product drive tripped by an impossible code or jump"},
      {"faults", "stall", 1, level, "the product drive tripped"},
      {"faults", "calibration", 1, level, "the product drive tripped by a current amplifier's offset"},
      {"faults", "align", 1, level, "the product drive tripped: the rotor was not aligned in time"},
  };
  return signals;
}

}  // namespace sixstep::study
