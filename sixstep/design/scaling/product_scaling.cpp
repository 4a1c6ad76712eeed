// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/scaling/product_scaling.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/design/scaling/scaling_proof.hpp"

namespace sixstep::design {

namespace {

using control::ProtectedConfig;
using detail::Proof;

template <class Scalar>
control::AdcConfig<Scalar> scaled_adc(const char* name, const control::AdcConfig<double>& adc, double base,
                                      int adc_bits, Proof<Scalar>& proof) {
  if (adc.per_eighth == 0) return {};
  const double top = std::ldexp(1.0, adc_bits) - 1, tolerance = adc.offset_tolerance;
  const double furthest = std::max(adc.offset_counts + tolerance, top - adc.offset_counts + tolerance);
  const double most = static_cast<double>(control::detail::greatest<typename Scalar::Storage>);
  if (8 * furthest > most)
    proof.problems.push_back({name, base::written(furthest) + " counts",
                              "in eighths are above " + base::written(most),
                              "take 32 bits, or convert fewer bits"});
  proof.fits(name, 8 * (furthest - tolerance) * std::fabs(adc.per_eighth), base);
  const double digit = static_cast<double>(Scalar::from_raw(1));
  return {proof.gain(name, adc.per_eighth / base / digit), adc.offset_counts, adc.offset_tolerance,
          adc.log2_samples};
}

template <class Scalar>
void scale_motion(const ProtectedConfig<double>& p, const Bases& b, Proof<Scalar>& proof,
                  ProtectedConfig<Scalar>& c) {
  using Wide = typename Scalar::WideInt;
  const double digit = static_cast<double>(Scalar::from_raw(1));
  const double edges = std::max(1, std::min(6, int{p.speed.edges}));
  const double raw = p.speed.sector_rad_s_ticks / b.speed_rad_s / digit * edges;
  const double most = static_cast<double>(control::detail::greatest<Wide>);
  if (raw > most)
    proof.problems.push_back(
        {"speed.sector_rad_s_ticks", base::written(p.speed.sector_rad_s_ticks),
         "over so many edges is " + base::written(raw / most) + " times what its sum holds",
         "take a slower timer, fewer edges or 32 bits"});
  c.speed = {control::TickRatio<Scalar>(p.speed.sector_rad_s_ticks / b.speed_rad_s), p.speed.timeout_ticks,
             p.speed.edges, p.speed.window_ticks, p.speed.grain_ticks};
  if (p.drive.mode == control::Mode::position)
    c.position = {proof.gain("position.per_sector", p.position.per_sector / b.position_deg / digit),
                  proof.gain("position.per_fraction", p.position.per_fraction / b.position_deg)};
  c.advance = {Scalar(p.advance.fixed), proof.gain("advance.per_speed", p.advance.per_speed * b.speed_rad_s),
               Scalar(p.advance.limit)};
}

template <class Scalar>
control::FaultConfig<Scalar> scaled_faults(const control::FaultConfig<double>& f, const Bases& b,
                                           Proof<Scalar>& proof) {
  return {proof.threshold("faults.over_current_A", f.over_current_A, b.current_A),
          proof.threshold("faults.over_voltage_V", f.over_voltage_V, b.voltage_V),
          proof.threshold("faults.under_voltage_V", f.under_voltage_V, b.voltage_V),
          proof.threshold("faults.over_speed_rad_s", f.over_speed_rad_s, b.speed_rad_s),
          proof.threshold("faults.stall_current_A", f.stall_current_A, b.current_A),
          f.stall_ticks,
          f.voltage_ticks};
}

}  // namespace

template <class Scalar>
base::Result<ScaledProduct<Scalar>> scaled_product(const ProtectedConfig<double>& p,
                                                   const OperatingRange& range, const Bases& bases,
                                                   int adc_bits) {
  const base::Result<Scaled<Scalar>> drive = scaled<Scalar>(p.drive, range, bases);
  if (!drive) return drive.problems();
  const Bases& b = drive->bases;
  Proof<Scalar> proof;
  proof.rows = drive->proof;
  ProtectedConfig<Scalar> c;
  c.drive = drive->config;
  const double unit = setpoint_base(p.drive.mode, b);
  proof.fits("setpoint_limit", p.setpoint_limit, unit);
  c.setpoint_limit = Scalar(p.setpoint_limit / unit);
  c.sensing = p.sensing;
  const char* names[3] = {"current_adc a", "current_adc b", "current_adc c"};
  for (std::size_t k = 0; k < 3; ++k)
    c.current_adc[k] = scaled_adc(names[k], p.current_adc[k], b.current_A, adc_bits, proof);
  c.bus_adc = scaled_adc("bus_adc", p.bus_adc, b.voltage_V, adc_bits, proof);
  c.shunt = {Scalar(p.shunt.least_duty), p.shunt.commutation_samples, Scalar(p.shunt.fade)};
  c.hall = p.hall;
  scale_motion(p, b, proof, c);
  c.faults = scaled_faults(p.faults, b, proof);
  c.align = {proof.threshold("align.current_A", p.align.current_A, b.current_A), p.align.ticks,
             p.align.settled_ticks, p.align.sector};
  c.brake_current_A = proof.threshold("brake_current_A", p.brake_current_A, b.current_A);
  c.short_below_rad_s = proof.threshold("short_below_rad_s", p.short_below_rad_s, b.speed_rad_s);
  c.standing_rad_s = proof.threshold("standing_rad_s", p.standing_rad_s, b.speed_rad_s);
  if (!proof.problems.empty()) return proof.problems;
  return ScaledProduct<Scalar>{c, b, std::move(proof.rows)};
}

template <class Scalar>
base::Result<ScaledProduct<Scalar>> scaled_product(const ProtectedConfig<double>& p,
                                                   const OperatingRange& range, int adc_bits) {
  return scaled_product<Scalar>(p, range, bases_for(p.drive, range, detail::full_scale<Scalar>), adc_bits);
}

using Product = ProtectedConfig<double>;
using Range = OperatingRange;
template base::Result<ScaledProduct<control::Q15>> scaled_product(const Product&, const Range&, int);
template base::Result<ScaledProduct<control::Q15>> scaled_product(const Product&, const Range&, const Bases&,
                                                                  int);
template base::Result<ScaledProduct<control::Q31>> scaled_product(const Product&, const Range&, int);
template base::Result<ScaledProduct<control::Q31>> scaled_product(const Product&, const Range&, const Bases&,
                                                                  int);
template base::Result<ScaledProduct<control::Q14>> scaled_product(const Product&, const Range&, int);
template base::Result<ScaledProduct<control::Q14>> scaled_product(const Product&, const Range&, const Bases&,
                                                                  int);
template base::Result<ScaledProduct<control::Q30>> scaled_product(const Product&, const Range&, int);
template base::Result<ScaledProduct<control::Q30>> scaled_product(const Product&, const Range&, const Bases&,
                                                                  int);
template base::Result<ScaledProduct<control::Fixed<std::int16_t, 13>>> scaled_product(const Product&,
                                                                                      const Range&, int);
template base::Result<ScaledProduct<control::Fixed<std::int16_t, 13>>> scaled_product(const Product&,
                                                                                      const Range&,
                                                                                      const Bases&, int);
template base::Result<ScaledProduct<control::Fixed<std::int32_t, 29>>> scaled_product(const Product&,
                                                                                      const Range&, int);
template base::Result<ScaledProduct<control::Fixed<std::int32_t, 29>>> scaled_product(const Product&,
                                                                                      const Range&,
                                                                                      const Bases&, int);

}  // namespace sixstep::design
