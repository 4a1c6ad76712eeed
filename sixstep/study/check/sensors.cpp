// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/sensors.hpp"

#include <cmath>
#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/low_side_window.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

namespace {

using rig::CurrentMeasurement;

void check_currents(const Scenario& s, base::Problems& out) {
  const Sensors& sensors = s.sensors;
  if (sensors.currents == CurrentMeasurement::ideal) return;
  if (!sensors.current_range_A)
    out.push_back(
        {"sensors.current_range_A", "", "is missing: the converter of the currents needs its range",
         "give sensors.current_range_A, the current at the converter's full scale, or set currents = \"ideal\""});
  else if (std::fabs(sensors.current_offset_A) >= *sensors.current_range_A)
    out.push_back({"sensors.current_offset_A", base::written(sensors.current_offset_A),
                   "leaves no measuring range within sensors.current_range_A = " +
                       base::written(*sensors.current_range_A),
                   "lower this value, or raise current_range_A"});
  const bool samples_in_middle = s.pwm.sample == SampleAt::middle;
  if (sensors.currents == CurrentMeasurement::dc_link && !samples_in_middle)
    out.push_back(
        {"sensors.currents", "\"dc-link\"",
         "shows the current only in the on-time, and samples at the start of the period come before the on-time",
         "set pwm.sample = \"middle\", best with pwm.alignment = \"centre\""});
}

/// Requires shunts and sample instants by which a field-oriented drive gets two currents at least without a voltage.
void check_low_side(const Scenario& s, base::Problems& out) {
  if (s.sensors.currents != CurrentMeasurement::low_side) return;
  const CurrentLoop& loop = s.control.current;
  if (loop.type == CurrentLoopType::hysteresis && loop.comparator == Comparator::event)
    out.push_back({"sensors.currents", "\"low-side\"",
                   "gives one sample a period, and event comparators watch the currents all the time",
                   "set currents = \"ideal\", or control.current.comparator = \"sampled\""});
  if (s.control.drive != FirmwareKind::field) return;
  const auto legs = static_cast<unsigned>(s.sensors.shunts);
  if ((legs & (legs - 1)) == 0)
    out.push_back({"sensors.shunts", '"' + std::string(base::word(shunt_choices, s.sensors.shunts)) + '"',
                   "shows one current, and the field-oriented drive needs two",
                   "set shunts = \"ab\" or \"abc\""});
  const double most = low_side_of(s).greatest_duty;
  if (s.pwm.sample == SampleAt::middle)
    out.push_back({"pwm.sample", "\"middle\"",
                   "samples within the pulses of the upper switches, where low-side shunts show nothing",
                   "set sample = \"start\", which is the middle of the lower switches' on-time"});
  else if (s.control.field.law == FieldLaw::pi && s.pwm.period_s > 0 && most < 0.5)
    out.push_back(
        {"sensors.currents", "\"low-side\"",
         "shows no current: without a voltage each leg has a duty of 0.5, and a leg is shown up to " +
             base::three_digits(most) + " (" + window_keys(s) + ")",
         "shorten these times, or lengthen pwm.period_s"});
}

/// The converter shows the current as it was current_delay_s before the sample. This instant must lie in the
/// preceding period, so that the delay must be shorter than a period.
void check_front_end(const Scenario& s, base::Problems& out) {
  if (s.sensors.current_delay_s >= s.pwm.period_s)
    out.push_back({"sensors.current_delay_s", base::written(s.sensors.current_delay_s),
                   "must be below pwm.period_s = " + base::written(s.pwm.period_s),
                   "lower this value, or lengthen pwm.period_s"});
}

void check_bits(const Scenario& s, base::Problems& out) {
  const bool used = s.sensors.currents != CurrentMeasurement::ideal || s.sensors.bus == BusSensing::adc;
  const Arithmetic a = s.control.arithmetic;
  if (used && (a == Arithmetic::q15 || a == Arithmetic::q14) && s.sensors.adc_bits > 12)
    out.push_back({"sensors.adc_bits", std::to_string(s.sensors.adc_bits),
                   "is too many for 16-bit fixed point, which computes in eighths of a count",
                   "set adc_bits = 12 or less, or a 32-bit control.arithmetic"});
}

void check_hall(const Scenario& s, base::Problems& out) {
  const Sensors& sensors = s.sensors;
  // The chip compares times by their signed 32-bit difference, which is right for less than 2^31 counts.
  if (sensors.timeout_s * sensors.capture_Hz > 0x1p31)
    out.push_back({"sensors.timeout_s", base::written(sensors.timeout_s),
                   "is more than 2^31 counts of capture_Hz", "lower timeout_s or capture_Hz"});
  if (sensors.hall_break.at_s && !(*sensors.hall_break.at_s < s.duration_s))
    out.push_back({"sensors.hall_break.at_s", base::written(*sensors.hall_break.at_s),
                   "is not before the end of the run (duration_s = " + base::written(s.duration_s) + ")",
                   "lengthen duration_s, or lower at_s"});
}

/// Least distance between neighbouring Hall edges, after the hysteresis, so that the edges keep their order.
constexpr double least_gap_deg = 1.0;
constexpr double most_glitches = 1e5;

void check_probe_edges(const Scenario& s, const std::optional<design::MotorModel>& motor,
                       base::Problems& out) {
  const Sensors& x = s.sensors;
  const std::vector<double>& own = x.hall_edges_deg;
  const std::size_t all = motor ? 6 * static_cast<std::size_t>(motor->machine.pole_pairs) : own.size();
  if (!own.empty() && own.size() != 6 && own.size() != all)
    return out.push_back(
        {"sensors.hall_edges_deg", "",
         "has " + std::to_string(own.size()) + " values, and must have 6 (edges of an electrical turn)" +
             (all > 6 ? " or " + std::to_string(all) + " (edges of a mechanical turn)" : ""),
         "give 6 " + (all > 6 ? "or " + std::to_string(all) + " " : std::string()) + "values"});
  for (std::size_t n = 0; n < own.size(); ++n) {
    const std::size_t next = (n + 1) % own.size();
    const double gap = 60 + own[next] - own[n] - x.hall_hysteresis_deg;
    if (gap < least_gap_deg)
      return out.push_back(
          {"sensors.hall_edges_deg[" + std::to_string(next) + "]", base::written(own[next]),
           "is " + base::written(gap) +
               " deg after the previous edge, with the hysteresis subtracted; at least 1 deg is needed",
           "change the angles so that each edge is at least 1 deg after the previous edge"});
  }
}

void check_probes(const Scenario& s, const std::optional<design::MotorModel>& motor, base::Problems& out) {
  check_probe_edges(s, motor, out);
  if (s.sensors.hall_glitches_Hz * s.duration_s > most_glitches)
    out.push_back({"sensors.hall_glitches_Hz", base::written(s.sensors.hall_glitches_Hz),
                   "causes more than 100000 glitches in duration_s = " + base::written(s.duration_s),
                   "lower sensors.hall_glitches_Hz or duration_s"});
}

}  // namespace

void check_sensors(const Scenario& s, const std::optional<design::MotorModel>& motor, base::Problems& out) {
  check_currents(s, out);
  check_low_side(s, out);
  check_front_end(s, out);
  check_bits(s, out);
  check_hall(s, out);
  check_probes(s, motor, out);
  if (s.sensors.bus == BusSensing::adc && !s.sensors.bus_range_V)
    out.push_back(
        {"sensors.bus_range_V", "", "is missing: the converter of the bus voltage needs its range",
         "give sensors.bus_range_V, the voltage at the converter's upper end, or set bus = \"ideal\""});
  const CurrentLoop& c = s.control.current;
  if (s.pwm.sample == SampleAt::middle && c.type == CurrentLoopType::hysteresis &&
      c.comparator == Comparator::event)
    out.push_back({"pwm.sample", "\"middle\"",
                   "has no effect with comparator = \"event\", which needs no sample",
                   "set sample = \"start\", or comparator = \"sampled\""});
}

}  // namespace sixstep::study
