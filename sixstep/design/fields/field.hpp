// SPDX-License-Identifier: Apache-2.0
// Description of each field of a controller's configuration (drive_fields.hpp, product_fields.hpp), and the
// simplest walk over the fields, which copies them. A walk has one member function per kind of field:
//
//   flag, choice, count   a switch, an enumeration, an integer
//   signal                a Scalar, in units of its base
//   threshold             a Scalar with which a signal is compared: it must be below full scale
//   gain, raw_gain        output per input; the output of raw_gain is in the last bits of its number
//   divisor, sum, ticks   the other types of control/scalar.hpp
//   part                  a nested configuration, whose fields() are visited with the further arguments
//
// Two more functions return whether the walk continues: when_run(runs) before the fields of a loop that may
// be unused, and when_on(on) before fields that depend on a flag. Each function receives the designed value
// (double, SI) and the member that stores it, in the chip's number type.
#pragma once
#include <cstdint>
#include <type_traits>

#include "sixstep/control/bridge_command.hpp"

namespace sixstep::design {

/// Quantity of a fixed-point number. The base of the number is the value that 1.0 represents, in A, V, rad/s,
/// degrees, the setpoint's unit, or 1.
enum class Base : std::uint8_t { one, current, voltage, speed, position, setpoint };

/// Bases of a gain's output and input.
struct Ratio {
  Base out = Base::one, in = Base::one;
};

struct Field {
  const char* name;        ///< name of the member
  const char* unit = "";   ///< SI unit; with the base `setpoint` the unit follows from the mode
  const char* about = "";  ///< comment after the number in an exported header
  bool always = false;     ///< true: the field is shown even if it has its default value
};

/// Copies every field to another floating-point number.
struct AsFloat {
  static constexpr bool when_run(bool) { return true; }
  static constexpr bool when_on(bool) { return true; }

  template <class T>
  void flag(const Field&, T designed, T& kept) const {
    kept = designed;
  }
  template <class T>
  void choice(const Field&, T designed, T& kept, T) const {
    kept = designed;
  }
  template <class T>
  void count(const Field&, T designed, T& kept, T) const {
    kept = designed;
  }
  template <class T>
  void signal(const Field&, double designed, T& kept, Base) const {
    kept = static_cast<T>(designed);
  }
  template <class T>
  void threshold(const Field&, double designed, T& kept, Base) const {
    kept = static_cast<T>(designed);
  }
  template <class T>
  void gain(const Field&, double designed, T& kept, Ratio) const {
    kept = static_cast<T>(designed);
  }
  template <class T>
  void raw_gain(const Field&, double designed, T& kept, Base) const {
    kept = static_cast<T>(designed);
  }
  template <class T>
  void divisor(const Field&, double designed, T& kept, Base) const {
    kept = static_cast<T>(designed);
  }
  template <class T>
  void sum(const Field&, double designed, T& kept, Base) const {
    kept = static_cast<T>(designed);
  }
  template <class T>
  void ticks(const Field&, double designed, T& kept, Base) const {
    kept = static_cast<T>(designed);
  }
  template <class Designed, class Kept, class... Told>
  void part(const char*, const Designed& designed, Kept& kept, const Told&... told) const {
    fields(*this, designed, kept, told...);
  }
};

}  // namespace sixstep::design
