// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/scaling/scaling.hpp"

#include <algorithm>

#include "sixstep/design/scaling/fixed_formats.hpp"
#include "sixstep/design/scaling/scale.hpp"

namespace sixstep::design {

namespace {

using control::DriveConfig;

using detail::Magnitudes;
using detail::magnitudes;
using detail::Proof;
using detail::trip_ratio;

template <class Scalar>
void prove_signals(const Magnitudes& m, const Bases& b, Proof<Scalar>& proof) {
  const detail::BaseOf current{"current_A", b.current_A}, voltage{"voltage_V", b.voltage_V},
      speed{"speed_rad_s", b.speed_rad_s}, position{"position_deg", b.position_deg};
  proof.fits("current", m.current, current);
  proof.fits("current reference with band", m.current_levels, current);
  proof.fits("current error", m.current + m.current_ref, current);
  proof.fits("speed", m.speed, speed);
  proof.fits("speed error", m.speed + m.speed_ref, speed);
  proof.fits("position", m.position, position);
  proof.fits("position error", m.position + m.position_ref, position);
  proof.fits("voltage with feed-forward", m.voltage + m.emf, voltage);
  proof.fits("bus", m.bus, voltage);
}

}  // namespace

Bases bases_for(const DriveConfig<double>& drive, const OperatingRange& range, double scale) {
  const Magnitudes m = magnitudes(drive, range);
  const auto base = [scale](double largest) { return largest > 0 ? largest / scale : 1.0; };
  double speed = m.speed + m.speed_ref, bus = std::max(m.bus, drive.nominal_bus_V);
  double current = std::max(m.current + m.current_ref, m.current_levels);
  if (drive.extras.on && drive.extras.limits_current) {
    const control::LimitsConfig<double>& l = drive.extras.limits;
    const double below_the_end = 1 + 1e-3;  // factor: a threshold must be below full scale, so that a signal
                                            // can exceed it
    current = std::max(current, trip_ratio * l.current_A * below_the_end);
    if (l.limits_speed) speed = std::max(speed, m.speed + l.speed_rad_s);
    if (l.limits_regeneration) bus = std::max(bus, l.bus_V * below_the_end);
  }
  return {base(current), base(std::max(m.voltage + m.emf, bus)), base(speed),
          base(m.position + m.position_ref)};
}

template <class Scalar>
base::Result<Scaled<Scalar>> scaled(const DriveConfig<double>& d, const OperatingRange& range,
                                    const Bases& b) {
  Proof<Scalar> proof;
  const Magnitudes m = magnitudes(d, range);
  prove_signals(m, b, proof);
  DriveConfig<Scalar> c;
  detail::Scale<Scalar> scale(d.mode, b, m, 0, proof);
  fields(scale, d, c);
  if (!proof.problems.empty()) return proof.problems;
  return Scaled<Scalar>{c, b, std::move(proof.rows)};
}

template <class Scalar>
base::Result<Scaled<Scalar>> scaled(const DriveConfig<double>& d, const OperatingRange& range) {
  return scaled<Scalar>(d, range, bases_for(d, range, detail::full_scale<Scalar>));
}

using Drive = DriveConfig<double>;
using Range = OperatingRange;
#define SIXSTEP_SCALED_IN(Format)                                                                  \
  template base::Result<Scaled<control::Format>> scaled(const Drive&, const Range&, const Bases&); \
  template base::Result<Scaled<control::Format>> scaled(const Drive&, const Range&);
SIXSTEP_FIXED_FORMATS(SIXSTEP_SCALED_IN)
#undef SIXSTEP_SCALED_IN
// Formats that only tests use.
template base::Result<Scaled<control::Fixed<std::int16_t, 13>>> scaled(const Drive&, const Range&,
                                                                       const Bases&);
template base::Result<Scaled<control::Fixed<std::int32_t, 29>>> scaled(const Drive&, const Range&,
                                                                       const Bases&);
template base::Result<Scaled<control::Fixed<std::int16_t, 13>>> scaled(const Drive&, const Range&);
template base::Result<Scaled<control::Fixed<std::int32_t, 29>>> scaled(const Drive&, const Range&);

}  // namespace sixstep::design
