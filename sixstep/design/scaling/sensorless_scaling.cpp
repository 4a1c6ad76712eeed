// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/scaling/sensorless_scaling.hpp"

#include <algorithm>

#include "sixstep/design/fields/sensorless_fields.hpp"
#include "sixstep/design/scaling/fixed_formats.hpp"
#include "sixstep/design/scaling/observer_scaling.hpp"
#include "sixstep/design/scaling/scale.hpp"

namespace sixstep::design {

using control::SensorlessDriveConfig;

control::DriveConfig<double> while_it_starts(const control::DriveConfig<double>& drive) {
  control::DriveConfig<double> starting = drive;
  starting.mode = control::Mode::current;
  starting.extras.slews_setpoint = false;  // its unit belongs to the mode after the start, not to the current
                                           // mode
  starting.extras.slew = {};
  return starting;
}

OperatingRange while_it_starts(const OperatingRange& range, const SensorlessDriveConfig<double>& sensorless) {
  OperatingRange starting = range;
  starting.setpoint = sensorless.sensorless.start.current_A;
  return starting;
}

Bases bases_for(const SensorlessDriveConfig<double>& p, const OperatingRange& range, double full_scale) {
  const Bases run = bases_for(p.drive, range, full_scale);
  const Bases start = bases_for(while_it_starts(p.drive), while_it_starts(range, p), full_scale);
  return {std::max(run.current_A, start.current_A), std::max(run.voltage_V, start.voltage_V),
          std::max(run.speed_rad_s, start.speed_rad_s), run.position_deg};
}

template <class Scalar>
base::Result<ScaledSensorless<Scalar>> scaled_sensorless(const SensorlessDriveConfig<double>& p,
                                                         const OperatingRange& range, const Bases& bases) {
  const auto drive = scaled<Scalar>(p.drive, range, bases);
  if (!drive) return drive.problems();
  const OperatingRange starting = while_it_starts(range, p);
  const auto start = scaled<Scalar>(while_it_starts(p.drive), starting, bases);
  if (!start) return start.problems();
  detail::Proof<Scalar> proof;
  proof.rows = drive->proof;
  SensorlessDriveConfig<Scalar> c;
  c.drive = drive->config;
  c.drive.current = start->config.current;
  c.drive.nominal_bus_V = start->config.nominal_bus_V;
  c.observer = observer_in<Scalar>(p.observer, bases);
  detail::Scale<Scalar> scale(p.drive.mode, bases, detail::magnitudes(p.drive, range), 0, proof);
  fields(scale, p, c);
  if (!proof.problems.empty()) return proof.problems;
  return ScaledSensorless<Scalar>{c, bases, std::move(proof.rows)};
}

using Sensorless = SensorlessDriveConfig<double>;
using Range = OperatingRange;
#define SIXSTEP_SCALED_IN(Format)                                                               \
  template base::Result<ScaledSensorless<control::Format>> scaled_sensorless(const Sensorless&, \
                                                                             const Range&, const Bases&);
SIXSTEP_FIXED_FORMATS(SIXSTEP_SCALED_IN)
#undef SIXSTEP_SCALED_IN

}  // namespace sixstep::design
