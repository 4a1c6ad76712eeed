// SPDX-License-Identifier: Apache-2.0
// Encoders on a shaft (model.md 10). The angle is counted in sectors, so that it is exact after any number of
// turns.
//
//   incremental: A = 1 while frac(N theta/(2 pi)) < 1/2; B follows a quarter of a line later;
//                Z = 1 over the first line of a turn; the count is floor(4 N theta/(2 pi))
//   absolute:    Gray code of floor(2^n frac(theta/(2 pi)))
//
// theta is the shaft's mechanical angle, N the number of lines per turn, n the number of bits.
#pragma once
#include <cmath>
#include <cstdint>

#include "sixstep/base/angle.hpp"

namespace sixstep::plant {

/// Mechanical angle theta = (60 deg sector + x)/p, with `sector` and `x` of a State and the pole pairs p.
template <class Real>
struct ShaftAngle {
  std::int64_t sector = 0;
  Real x = 0;
  std::int64_t pole_pairs = 1;
};

/// floor(parts theta/(2 pi)): index of the part in which the shaft is, with `parts` equal parts per turn,
/// counted over all turns.
template <class Real>
std::int64_t parts_of_turn(const ShaftAngle<Real>& at, std::int64_t parts) {
  // Whole sectors are computed in integers: theta/(2 pi) = (sector + x/60 deg)/(6 p). x is less than one
  // sector.
  const std::int64_t per_turn = 6 * at.pole_pairs, turns = at.sector / per_turn, rest = at.sector % per_turn;
  const std::int64_t whole = parts * rest / per_turn, left = parts * rest % per_turn;
  const Real more = (static_cast<Real>(left) + static_cast<Real>(parts) * (at.x / Real(base::sector_rad))) /
                    static_cast<Real>(per_turn);
  return turns * parts + whole + static_cast<std::int64_t>(std::floor(more));
}

/// Index of the quarter of a line at a shaft angle, for an incremental encoder of N lines, counted over all
/// turns.
template <class Real>
std::int64_t encoder_quarter(const ShaftAngle<Real>& at, std::int64_t lines) {
  return parts_of_turn(at, 4 * lines);
}

/// Lines A, B, Z of an encoder of N lines, in the quarter of a line `quarter`: A has the value 4, B 2, Z 1.
inline std::uint8_t encoder_lines_in(std::int64_t quarter, std::int64_t lines) {
  const std::int64_t in_turn = ((quarter % (4 * lines)) + 4 * lines) % (4 * lines), in_line = in_turn % 4;
  const bool a = in_line < 2, b = in_line == 1 || in_line == 2, z = in_turn < 4;
  return static_cast<std::uint8_t>(a << 2 | b << 1 | static_cast<int>(z));
}

/// Lines A, B, Z of an encoder of N lines at a shaft angle: A has the value 4, B 2, Z 1.
template <class Real>
std::uint8_t encoder_lines(const ShaftAngle<Real>& at, std::int64_t lines) {
  return encoder_lines_in(encoder_quarter(at, lines), lines);
}

/// Output of an absolute encoder of `bits` bits: Gray code of the index of the part of the turn.
template <class Real>
std::uint32_t gray_code(const ShaftAngle<Real>& at, int bits) {
  const std::int64_t parts = std::int64_t{1} << bits;
  const auto n = static_cast<std::uint32_t>(((parts_of_turn(at, parts) % parts) + parts) % parts);
  return n ^ n >> 1;
}

}  // namespace sixstep::plant
