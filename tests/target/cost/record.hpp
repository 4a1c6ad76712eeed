// SPDX-License-Identifier: Apache-2.0
// One period of a recorded run, as bytes of a fixed layout, lowest byte first: the firmware's inputs at a
// control tick or in a Hall interrupt. The host writes them, and every processor reads them. The numbers are
// sizes in bytes.
//
//   all       kind 1 (0 tick, 1 Hall), pins 1
//   lean      i_a, i_b, i_c, speed, position, bus, setpoint: a scalar each
//   field     as lean, the electrical angle 4
//   product   current counts 3 x 2, bus counts 2, counter 4, run 1, clear 1, setpoint: a scalar
#pragma once
#include <cstdint>

#include "sixstep/control/field/field_drive.hpp"
#include "sixstep/control/protected_drive.hpp"

namespace target {

using namespace sixstep::control;

enum class Kind : std::uint8_t { tick, hall };

template <class Scalar>
struct Bits {
  using Unsigned = std::uint32_t;
  static constexpr Unsigned of(Scalar x) { return __builtin_bit_cast(Unsigned, x); }
  static constexpr Scalar from(Unsigned bits) { return __builtin_bit_cast(Scalar, bits); }
};
template <int FractionBits>
struct Bits<Fixed<std::int16_t, FractionBits>> {
  using Scalar = Fixed<std::int16_t, FractionBits>;
  using Unsigned = std::uint16_t;
  static constexpr Unsigned of(Scalar x) { return static_cast<Unsigned>(x.raw); }
  static constexpr Scalar from(Unsigned bits) { return Scalar::from_raw(static_cast<std::int16_t>(bits)); }
};
template <int FractionBits>
struct Bits<Fixed<std::int32_t, FractionBits>> {
  using Scalar = Fixed<std::int32_t, FractionBits>;
  using Unsigned = std::uint32_t;
  static constexpr Unsigned of(Scalar x) { return static_cast<Unsigned>(x.raw); }
  static constexpr Scalar from(Unsigned bits) { return Scalar::from_raw(static_cast<std::int32_t>(bits)); }
};

/// Copies a field from bytes to a record. Writer copies it from the record to bytes. One list of fields
/// serves both directions.
struct Reader {
  const std::uint8_t* at;
  template <class Unsigned>
  void whole(Unsigned& x) {
    x = 0;
    for (std::uint8_t n = 0; n < sizeof(Unsigned); ++n)
      x = static_cast<Unsigned>(x | static_cast<Unsigned>(static_cast<Unsigned>(*at++) << (8 * n)));
  }
  void flag(bool& x) { x = *at++ != 0; }
  template <class Scalar>
  void scalar(Scalar& x) {
    typename Bits<Scalar>::Unsigned bits{};
    whole(bits);
    x = Bits<Scalar>::from(bits);
  }
};
struct Writer {
  std::uint8_t* at;
  template <class Unsigned>
  void whole(Unsigned x) {
    for (std::uint8_t n = 0; n < sizeof(Unsigned); ++n) *at++ = static_cast<std::uint8_t>(x >> (8 * n));
  }
  void flag(bool x) { *at++ = x ? 1 : 0; }
  template <class Scalar>
  void scalar(Scalar x) {
    whole(Bits<Scalar>::of(x));
  }
};

template <class Scalar>
struct LeanRecord {
  static constexpr std::uint8_t bytes = 2 + 7 * sizeof(typename Bits<Scalar>::Unsigned);
  std::uint8_t kind = 0;
  Measurement<Scalar> measured{};  ///< a Hall edge sets only the code
  Setpoint<Scalar> setpoint{};

  template <class Way>
  void fields(Way&& way) {
    way.whole(kind);
    way.whole(measured.hall);
    way.scalar(measured.i_a_A);
    way.scalar(measured.i_b_A);
    way.scalar(measured.i_c_A);
    way.scalar(measured.speed_rad_s);
    way.scalar(measured.position_deg);
    way.scalar(measured.bus_V);
    way.scalar(setpoint.value);
  }
};

/// The inputs of the lean drive, and an angle. At a Hall edge, no entry is called.
template <class Scalar>
struct FieldRecord : LeanRecord<Scalar> {
  static constexpr std::uint8_t bytes = LeanRecord<Scalar>::bytes + 4;
  BinaryAngle electrical = 0;

  template <class Way>
  void fields(Way&& way) {
    LeanRecord<Scalar>::fields(way);
    way.whole(electrical);
  }
};

template <class Scalar>
struct ProductRecord {
  static constexpr std::uint8_t bytes = 16 + sizeof(typename Bits<Scalar>::Unsigned);
  std::uint8_t kind = 0;
  BoardInput input{};  ///< a Hall edge sets only pins and counter
  Request request{};
  Setpoint<Scalar> setpoint{};

  template <class Way>
  void fields(Way&& way) {
    way.whole(kind);
    way.whole(input.hall_pins);
    for (auto& counts : input.current_counts) way.whole(counts);
    way.whole(input.bus_counts);
    way.whole(input.now);
    way.flag(request.run);
    way.flag(request.clear);
    way.scalar(setpoint.value);
  }
};

}  // namespace target
