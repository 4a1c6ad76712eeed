// SPDX-License-Identifier: Apache-2.0
// The walk that converts a configuration's fields to fixed point (design/fields). Each field is divided by
// its base, and has lines in the proof.
#pragma once
#include <algorithm>
#include <string>

#include "sixstep/design/fields/product_fields.hpp"
#include "sixstep/design/scaling/magnitudes.hpp"
#include "sixstep/design/scaling/scaling_proof.hpp"

namespace sixstep::design::detail {

inline constexpr double trip_ratio = 1.25;  // 5/4, as in over_limit() of limits.hpp

/// Walk that converts. Fields that the mode does not use, or that a flag disables, keep their defaults.
template <class Scalar>
class Scale {
 public:
  Scale(control::Mode mode, const Bases& bases, const Magnitudes& magnitudes, int adc_bits,
        Proof<Scalar>& proof)
      : mode_(mode), b_(bases), m_(magnitudes), adc_bits_(adc_bits), proof_(proof) {}

  static constexpr bool when_run(bool runs) { return runs; }
  static constexpr bool when_on(bool on) { return on; }

  template <class T>
  void flag(const Field&, T designed, T& kept) {
    kept = designed;
  }
  template <class T>
  void choice(const Field&, T designed, T& kept, T) {
    kept = designed;
  }
  template <class T>
  void count(const Field&, T designed, T& kept, T) {
    kept = designed;
  }
  void signal(const Field&, double designed, Scalar& kept, Base base) {
    kept = Scalar(designed / value(base));
  }
  void threshold(const Field& f, double designed, Scalar& kept, Base base) {
    kept = proof_.threshold(path(f).c_str(), designed, of(base));
  }
  void gain(const Field& f, double designed, control::Gain<Scalar>& kept, Ratio ratio) {
    kept = proof_.gain(path(f).c_str(), designed * value(ratio.in) / value(ratio.out));
  }
  void raw_gain(const Field& f, double designed, control::Gain<Scalar>& kept, Base base) {
    kept = proof_.gain(path(f).c_str(), designed / value(base) / digit);
  }
  void divisor(const Field& f, double designed, control::Divisor<Scalar>& kept, Base base) {
    if (!(designed > 0)) return;
    kept = control::Divisor<Scalar>(designed / value(base));
    proof_.gain(("1/" + path(f)).c_str(), value(base) / designed);
  }
  void sum(const Field& f, double designed, control::Accumulator<Scalar>& kept, Base base) {
    kept = control::Accumulator<Scalar>(designed / value(base));
    if (designed != 0 && kept.raw == 0)
      proof_.problems.push_back({path(f), base::written(designed),
                                 "is below the last bit of the setpoint's sum",
                                 "use a 32-bit format, a faster slew rate or a longer control period"});
  }
  void ticks(const Field&, double designed, control::TickRatio<Scalar>& kept, Base base) {
    kept = control::TickRatio<Scalar>(designed / value(base));
  }

  template <class Designed, class Kept, class... Told>
  void part(const char* name, const Designed& designed, Kept& kept, const Told&... told) {
    const std::string outer = within_;
    if constexpr (!std::is_same_v<Designed, control::DriveExtras<double>>) within_ += name;
    if (prove(designed, told...)) {
      if (!within_.empty() && within_.back() != '.') within_ += '.';
      fields(*this, designed, kept, told...);
    }
    within_ = outer;
  }

 private:
  static constexpr double digit = static_cast<double>(Scalar::from_raw(1));

  double value(Base base) const { return value_of(base, mode_, b_); }
  BaseOf of(Base base) const { return {member_of(base, mode_), value(base)}; }
  std::string path(const Field& f) const { return within_ + f.name; }

  // Checks further conditions of a nested part and adds their lines to the proof. If the result is false, the
  // part keeps its defaults.
  template <class Config, class... Told>
  bool prove(const Config&, const Told&...) {
    return true;
  }
  bool prove(const control::PiConfig<double>& pi, const PiUse& use) {
    const double largest_error =
        use.ratio.in == Base::current ? m_.current + m_.current_ref : m_.speed + m_.speed_ref;
    proof_.integral(within_, pi, value(use.ratio.in), of(use.ratio.out), largest_error);
    return true;
  }
  bool prove(const control::LimitsConfig<double>& l) {
    proof_.threshold("limits.current_A, 5/4 of it", trip_ratio * l.current_A, of(Base::current));
    if (l.limits_speed)
      proof_.fits("limits.speed_rad_s with speed", l.speed_rad_s + m_.speed, of(Base::speed));
    if (l.limits_regeneration) proof_.threshold("limits.bus_V", l.bus_V, of(Base::voltage));
    return true;
  }
  bool prove(const control::DriveExtras<double>& x) {
    extras_ = &x;
    return true;
  }
  bool prove(const control::PiPositionalConfig<double>& pi);
  bool prove(const control::AdcConfig<double>& adc, const AdcUse& use);
  bool prove(const control::HallSpeedConfig<double>& speed);

  control::Mode mode_;
  Bases b_;
  Magnitudes m_;
  int adc_bits_;
  Proof<Scalar>& proof_;
  std::string within_;  ///< path of the present part
  const control::DriveExtras<double>* extras_ = nullptr;
};

/// Conditions of pi_positional.hpp and derivative.hpp; y: output of the derivative, I: integral, e: error.
/// |y| is at most g times the largest step of the speed, and g/b times its largest change per sample. |I| is
/// at most limit + |y| + |K_c| |e|/K_b. K e may saturate. K_i and its increments are proved with
/// DriveConfig::speed.
template <class Scalar>
bool Scale<Scalar>::prove(const control::PiPositionalConfig<double>& pi) {
  const control::DerivativeConfig<double>& d = extras_->speed_derivative;
  const double steepest = d.b > 0 ? d.g / d.b * m_.speed_change : HUGE_VAL;
  const double braked = d.g > 0 ? std::min(2 * m_.speed * d.g, steepest) : 0.0;
  // The part that a setpoint weight removes is fed forward like the derivative, and the integral compensates
  // it.
  const double weighted = extras_->speed_weight_off * m_.speed_ref;
  const double integral =
      pi.K_b > 0 ? pi.limit + braked + weighted + std::fabs(pi.K_c) / pi.K_b * (m_.speed + m_.speed_ref)
                 : 0.0;
  if (!(pi.K_b > 0) && pi.K_i != 0)
    proof_.problems.push_back({"speed.K_b", "0",
                               "lets the integral grow without a limit, which fixed point does not allow",
                               "use K_i/K, or floating point"});
  if (braked + weighted + integral > 14.0 * full_scale<Scalar>)
    proof_.problems.push_back(
        {"speed derivative and integral", at_least(braked + weighted + integral),
         "of full output are above " + at_most(14.0 * full_scale<Scalar>),
         "use a K_b nearer to K_i/K, a longer filter of the derivative, or a format with more "
         "bits before the point"});
  proof_.rows.push_back(
      {"speed derivative and integral", braked + weighted + integral, 14.0 * full_scale<Scalar>});
  return true;
}

/// A converter with gain 0 does not exist and needs no proof.
template <class Scalar>
bool Scale<Scalar>::prove(const control::AdcConfig<double>& adc, const AdcUse& use) {
  if (adc.per_eighth == 0) return false;
  // In the proof "current_adc[1]" is called "current_adc b".
  const std::size_t phase = within_.find('[');
  const std::string name = phase == std::string::npos ? within_
                                                      : within_.substr(0, phase) + " " +
                                                            static_cast<char>('a' + within_[phase + 1] - '0');
  const double top = std::ldexp(1.0, adc_bits_) - 1, tolerance = adc.offset_tolerance;
  const double furthest = std::max(adc.offset_counts + tolerance, top - adc.offset_counts + tolerance);
  const double most = static_cast<double>(control::detail::greatest<typename Scalar::Storage>);
  if (8 * furthest > most)
    proof_.problems.push_back({name, at_least(furthest) + " counts", "in eighths are above " + at_most(most),
                               "use a 32-bit format, or a converter with fewer bits"});
  proof_.fits(name.c_str(), 8 * (furthest - tolerance) * std::fabs(adc.per_eighth), of(use.base));
  return true;
}

template <class Scalar>
bool Scale<Scalar>::prove(const control::HallSpeedConfig<double>& speed) {
  const double edges = std::max(1, std::min(6, int{speed.edges}));
  const double raw = speed.sector_rad_s_ticks / b_.speed_rad_s / digit * edges;
  const double most = static_cast<double>(control::detail::greatest<typename Scalar::WideInt>);
  if (raw > most)
    proof_.problems.push_back(
        {"speed.sector_rad_s_ticks", at_least(speed.sector_rad_s_ticks),
         "over this number of edges is " + at_least(raw / most) + " times the range of its sum: at most " +
             at_most(speed.sector_rad_s_ticks * most / raw) + " fits",
         "use a timer slower by this factor, a " +
             full_scale_words("speed_rad_s", at_least(scale_per_base<Scalar> * b_.speed_rad_s * raw / most)) +
             " or more, fewer edges, or 32 bits"});
  return true;
}

}  // namespace sixstep::design::detail
