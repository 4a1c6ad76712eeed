// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/sensors.hpp"

#include <cmath>
#include <string>

#include "sixstep/base/written.hpp"

namespace sixstep::study {

namespace {

using rig::CurrentMeasurement;

void check_currents(const Scenario& s, base::Problems& out) {
  const Sensors& sensors = s.sensors;
  if (sensors.currents == CurrentMeasurement::ideal) return;
  if (!sensors.current_range_A)
    out.push_back({"sensors.current_range_A", "", "is missing, and currents go through a converter",
                   "give the current at the converter's ends, or currents = \"ideal\""});
  else if (std::fabs(sensors.current_offset_A) >= *sensors.current_range_A)
    out.push_back({"sensors.current_offset_A", base::written(sensors.current_offset_A),
                   "leaves nothing of current_range_A = " + base::written(*sensors.current_range_A),
                   "lower it or widen the range"});
  const bool samples_in_middle = s.pwm.sample == SampleAt::middle;
  if (sensors.currents == CurrentMeasurement::dc_link && !samples_in_middle)
    out.push_back({"sensors.currents", "\"dc-link\"", "shows nothing before the on-time has begun",
                   "set pwm.sample = \"middle\", best with pwm.alignment = \"centre\""});
}

void check_bits(const Scenario& s, base::Problems& out) {
  const bool used = s.sensors.currents != CurrentMeasurement::ideal || s.sensors.bus == BusSensing::adc;
  const Arithmetic a = s.control.arithmetic;
  if (used && (a == Arithmetic::q15 || a == Arithmetic::q14) && s.sensors.adc_bits > 12)
    out.push_back({"sensors.adc_bits", std::to_string(s.sensors.adc_bits),
                   "in eighths of a count is more than 16-bit fixed point holds",
                   "take 12 bits, or a 32-bit format in control.arithmetic"});
}

void check_hall(const Scenario& s, base::Problems& out) {
  const Sensors& sensors = s.sensors;
  // Times are compared by their difference in 32 bits.
  if (sensors.timeout_s * sensors.capture_Hz > 0x1p31)
    out.push_back({"sensors.timeout_s", base::written(sensors.timeout_s),
                   "is more than 2^31 counts of capture_Hz", "lower one of them"});
  if (sensors.hall_break.at_s && !(*sensors.hall_break.at_s < s.duration_s))
    out.push_back({"sensors.hall_break.at_s", base::written(*sensors.hall_break.at_s),
                   "lies behind the end of the run (duration_s = " + base::written(s.duration_s) + ")",
                   "lengthen duration_s or break the line earlier"});
}

}  // namespace

void check_sensors(const Scenario& s, base::Problems& out) {
  check_currents(s, out);
  check_bits(s, out);
  check_hall(s, out);
  if (s.sensors.bus == BusSensing::adc && !s.sensors.bus_range_V)
    out.push_back({"sensors.bus_range_V", "", "is missing, and the bus goes through a converter",
                   "give the voltage at its upper end, or bus = \"ideal\""});
  const CurrentLoop& c = s.control.current;
  if (s.pwm.sample == SampleAt::middle && c.type == CurrentLoopType::hysteresis &&
      c.comparator == Comparator::event)
    out.push_back({"pwm.sample", "\"middle\"", "has no meaning for event comparators",
                   "set sample = \"start\", or comparator = \"sampled\""});
}

}  // namespace sixstep::study
