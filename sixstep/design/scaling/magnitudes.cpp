// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/scaling/magnitudes.hpp"

#include <algorithm>

#include "sixstep/design/fields/drive_fields.hpp"

namespace sixstep::design::detail {

using control::Mode;

Magnitudes magnitudes(const control::DriveConfig<double>& d, const OperatingRange& r) {
  Magnitudes m;
  m.current = r.current_A;
  m.speed = r.speed_rad_s;
  m.bus = r.bus_V;
  if (d.mode == Mode::position) {
    m.position = r.position_deg;
    m.position_ref = r.setpoint;
  }
  // A slewed setpoint begins at the measured value, which may be larger.
  const bool slews = d.extras.on && d.extras.slews_setpoint;
  const auto slewed = [slews](double wanted, double measured) {
    return slews ? std::max(wanted, measured) : wanted;
  };
  m.position_ref = slewed(m.position_ref, m.position);
  m.speed_change = r.speed_change_rad_s > 0 ? std::min(r.speed_change_rad_s, 2 * m.speed) : 2 * m.speed;
  if (runs_speed(d))
    m.speed_ref = d.mode == Mode::position ? d.speed_limit_rad_s : slewed(r.setpoint, m.speed);
  if (runs_current(d)) {
    m.current_ref = d.mode == Mode::current ? slewed(r.setpoint, m.current) : d.current_limit_A;
    m.voltage = d.current.limit;
    const bool hysteresis = d.current_control == control::CurrentControl::hysteresis;
    m.current_levels = m.current_ref + (hysteresis ? d.hysteresis.band_A : 0.0);
    if (d.extras.on) m.emf = std::min(d.current.limit, r.speed_rad_s * d.extras.feed_forward.K_t_V_s);
    // A prediction subtracts two voltages, each of either sign.
    if (d.extras.on && d.extras.predicts_current) m.emf = m.voltage = d.extras.deadbeat.limit;
  }
  return m;
}

}  // namespace sixstep::design::detail
