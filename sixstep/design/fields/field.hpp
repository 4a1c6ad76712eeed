// SPDX-License-Identifier: Apache-2.0
// What is told of each field of a controller's configuration (drive_fields.hpp, product_fields.hpp), and the
// simplest walk over them. A walk has one member per kind of field:
//
//   flag, choice, count   a switch, an enumeration, a whole number
//   signal                a Scalar, in units of its base
//   threshold             the same, and what a signal is compared with: it must lie below full scale
//   gain, raw_gain        output per input; raw_gain answers in the last bits of its output
//   divisor, sum, ticks   what control/scalar.hpp has beside Scalar and Gain
//   part                  a configuration within, whose fields() are walked; what else they need is handed on
//
// and says where it goes: when_run(runs) of what only a loop that runs needs, when_on(on) of what stands
// behind a flag of its own. Each takes the designed value (double, SI) and the kept one, in the chip's
// number.
#pragma once
#include <cstdint>
#include <type_traits>

#include "sixstep/control/bridge_command.hpp"

namespace sixstep::design {

/// What 1.0 stands for in fixed point: A, V, rad/s, degrees, what the mode sets, or 1.
enum class Base : std::uint8_t { one, current, voltage, speed, position, setpoint };

/// Of a gain: the bases of its output and its input.
struct Ratio {
  Base out = Base::one, in = Base::one;
};

struct Field {
  const char* name;        ///< the member's
  const char* unit = "";   ///< in SI; what has the base `setpoint` has its unit from the mode
  const char* about = "";  ///< beside the number in an exported header
  bool always = false;     ///< shown where it is the default too
};

/// Every field as it is, in another floating-point number.
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
