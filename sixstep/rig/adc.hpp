// SPDX-License-Identifier: Apache-2.0
// Simulates an analogue input: an amplifier with offset, gain error and noise, then a converter of `bits`
// bits over a range. The firmware converts the counts back (control/adc.hpp).
//
//   counts = round(((1 + gain_error) x + offset + noise)/lsb) + zero, limited to 0..2^bits - 1
//   both signs:  lsb = 2 range/2^bits, zero = 2^(bits - 1)
//   one sign:    lsb = range/2^bits, zero = 0
#pragma once
#include <cmath>
#include <cstdint>

#include "sixstep/base/random.hpp"

namespace sixstep::rig {

struct AdcPath {
  int bits = 12;           ///< at most 16
  double range = 0.0;      ///< full scale, in the unit of the measured quantity
  bool both_signs = true;  ///< true: the range is -range to range; false: 0 to range
  double offset = 0.0;     ///< offset of the amplifier, in the unit of `range`
  double gain_error = 0.0;
  double noise = 0.0;  ///< rms noise, in the unit of `range`, white and normally distributed

  double lsb() const { return (both_signs ? 2.0 : 1.0) * range / static_cast<double>(1 << bits); }
  std::uint16_t zero() const {
    return both_signs ? static_cast<std::uint16_t>(1 << (bits - 1)) : std::uint16_t{0};
  }
};

/// Counts for an input x, in the unit of `range`. `place` identifies the random number: input and index of
/// the draw.
inline std::uint16_t converted(const AdcPath& path, double x, const base::RandomPlace& place) {
  double seen = (1.0 + path.gain_error) * x + path.offset;
  if (path.noise > 0) seen += path.noise * base::normal(place);
  const double counts = std::floor(seen / path.lsb() + 0.5) + path.zero();
  const double most = static_cast<double>((1 << path.bits) - 1);
  return static_cast<std::uint16_t>(counts < 0 ? 0 : counts > most ? most : counts);
}

}  // namespace sixstep::rig
