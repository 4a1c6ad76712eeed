// SPDX-License-Identifier: Apache-2.0
// Converts ADC counts to a signal. The offset is measured while the bridge is off.
//
//   x = per_eighth (8 counts - offset),   offset = mean of 2^n samples, in eighths of a count
//
// x: the signal, n: log2_samples. Calibration fails if the mean differs too much from offset_counts: the
// amplifier is then broken.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// The default converts every count to 0. Counts of converters of up to 12 bits do not saturate 16-bit
/// formats; converters with more bits need 32-bit formats.
template <class Scalar>
struct AdcConfig {
  Gain<Scalar> per_eighth{};           ///< signal per eighth of a count; negative for an inverting amplifier;
                                       ///< fixed point: raw units
  std::uint16_t offset_counts = 0;     ///< nominal counts without current
  std::uint16_t offset_tolerance = 0;  ///< largest deviation of the measured offset, counts
  std::uint8_t log2_samples = 6;       ///< 2^n samples in one calibration, n at most 12
  bool operator==(const AdcConfig&) const = default;
};

struct AdcState {
  std::int32_t offset_eighths = -1;  ///< measured offset; below 0: not measured yet, offset_counts is used
  std::uint32_t sum = 0;
  std::uint16_t samples = 0;
};

enum class Calibration : std::uint8_t { running, done, failed };

/// Adds one sample of the calibration. The bridge must be off, without current. The result is `done` or
/// `failed` at the last sample.
template <class Scalar>
constexpr Calibration adc_calibrate(const AdcConfig<Scalar>& config, AdcState& state, std::uint16_t counts) {
  const std::uint8_t n = config.log2_samples > 12 ? std::uint8_t{12} : config.log2_samples;
  state.sum += counts;
  ++state.samples;
  if (state.samples < static_cast<std::uint32_t>(std::uint32_t{1} << n)) return Calibration::running;
  const std::uint32_t eighths =
      static_cast<std::uint32_t>((state.sum * 8 + ((std::uint32_t{1} << n) >> 1)) >> n);
  state.sum = 0;
  state.samples = 0;
  const std::int32_t off = static_cast<std::int32_t>(eighths) - std::int32_t{8} * config.offset_counts;
  if (off > std::int32_t{8} * config.offset_tolerance || off < std::int32_t{-8} * config.offset_tolerance)
    return Calibration::failed;
  state.offset_eighths = static_cast<std::int32_t>(eighths);
  return Calibration::done;
}

template <class Scalar>
constexpr Scalar adc_value(const AdcConfig<Scalar>& config, const AdcState& state, std::uint16_t counts) {
  const std::int32_t offset =
      state.offset_eighths < 0 ? std::int32_t{8} * config.offset_counts : state.offset_eighths;
  return ScalarTraits<Scalar>::counts(std::int32_t{8} * counts - offset, config.per_eighth);
}

}  // namespace sixstep::control
