// SPDX-License-Identifier: Apache-2.0
// Computes the leg commands of a voltage vector that rests or turns, and the currents in the frame of that
// vector.
//
//   v_k = v cos(angle - 120 k),   d_k = 1/2 + v_k + v_0,  v_0 = -(max v_k + min v_k)/2     (model.md 11)
//   3 i_alpha = 2 i_a - i_b - i_c,   3 i_beta = sqrt 3 (i_b - i_c)
//
// A rotation by -angle results in the components of the current along and across the vector. v is the
// vector's length. v_k and d_k are voltage and duty of leg k = 0, 1, 2. v_0 is the common voltage that
// centres the three duties. All numbers are integers. Voltages are in units of 2^-20 of the bus. Currents are
// in 24ths of a converter's count: the offsets are in eighths (adc.hpp), and the result of the formula is 3
// i. Only commissioning_result.hpp converts to V and A.
#pragma once
#include <cstdint>

#include "sixstep/control/adc.hpp"
#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/root.hpp"
#include "sixstep/control/sensing/sine.hpp"

namespace sixstep::control {

/// The whole bus voltage, in units of 2^-20 of the bus.
inline constexpr std::int32_t whole_bus = std::int32_t{1} << 20;
/// The longest vector that the three legs can produce in every direction: 1/sqrt 3 of the bus in units of
/// 2^-20, rounded down.
inline constexpr std::int32_t longest_vector = 605411;

/// Components along the vector and across it, in units of 2^-20 of the bus or in 24ths of a count.
struct FieldVector {
  std::int32_t along = 0, across = 0;
};

namespace detail {

inline constexpr std::int32_t root_3_30 = 1859775393;  ///< sqrt 3 2^30

/// x y/2^30, rounded to nearest.
constexpr std::int32_t scaled_30(std::int32_t x, std::int32_t y) {
  return static_cast<std::int32_t>(shifted_down(static_cast<std::int64_t>(x) * y, 30));
}

}  // namespace detail

/// Commands of the three legs for the vector; its length v is in 0..longest_vector.
template <class Scalar>
constexpr LegCommands<Scalar> legs_of_vector(std::int32_t v, BinaryAngle angle) {
  const Direction<Q30> to = direction_of<Q30>(angle);
  const std::int32_t alpha = detail::scaled_30(v, to.cos.raw), beta = detail::scaled_30(v, to.sin.raw);
  const std::int32_t side = detail::scaled_30(beta, detail::root_3_30) / 2;
  const std::int32_t leg[3] = {alpha, -alpha / 2 + side, -alpha / 2 - side};
  std::int32_t least = leg[0], most = leg[0];
  for (const std::int32_t x : leg) {
    if (x < least) least = x;
    if (x > most) most = x;
  }
  LegCommands<Scalar> legs{};
  legs.enabled = true;
  for (std::uint8_t k = 0; k < 3; ++k) {
    const std::int32_t duty = whole_bus / 2 + leg[k] - (most + least) / 2;
    const std::int32_t held = duty < 0 ? 0 : duty > whole_bus ? whole_bus : duty;
    legs.leg[k] = {LegState::pwm, PwmSwitches::complementary,
                   ScalarTraits<Scalar>::fraction(static_cast<std::uint32_t>(held),
                                                  static_cast<std::uint32_t>(whole_bus))};
  }
  return legs;
}

/// Components of the three phase currents along `angle` and across it, in 24ths of a count. The currents are
/// in eighths of a count.
constexpr FieldVector seen_along(const std::int32_t (&eighths)[3], BinaryAngle angle) {
  const Direction<Q30> to = direction_of<Q30>(angle);
  const std::int32_t alpha = 2 * eighths[0] - eighths[1] - eighths[2];
  const std::int32_t beta = detail::scaled_30(eighths[1] - eighths[2], detail::root_3_30);
  return {detail::scaled_30(alpha, to.cos.raw) + detail::scaled_30(beta, to.sin.raw),
          detail::scaled_30(beta, to.cos.raw) - detail::scaled_30(alpha, to.sin.raw)};
}

constexpr std::uint32_t length_of(std::int32_t x, std::int32_t y) {
  const std::int64_t a = x, b = y;
  return static_cast<std::uint32_t>(
      whole_root(static_cast<std::uint64_t>(a * a) + static_cast<std::uint64_t>(b * b)));
}

}  // namespace sixstep::control
