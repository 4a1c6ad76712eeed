// SPDX-License-Identifier: Apache-2.0
// Describes the board around the chip, as the scenario simulated it:
// - a transducer for each phase current on ADC0..ADC2; each period samples the current of the leg that feeds
//   the
//   driven pair;
// - a potentiometer on ADC3 as the setpoint, which is 0 in the potentiometer's middle;
// - Hall pins on PK0..PK2.
#pragma once
#include <drive_config.hpp>

#include "faces/firmware/example/avr/registers.hpp"
#include "sixstep/control/adc.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/control/one_shunt.hpp"

namespace firmware {

using namespace sixstep::control;
using exported::drive, exported::Scalar, exported::units;

static_assert((drive.mode == Mode::current || drive.mode == Mode::duty) && drive.chopping == Chopping::soft &&
                  drive.extras.pwm.pattern == PwmPattern::upper,
              "this board supports only current or duty mode, soft chopping and PWM of the upper switch");
static_assert(
    !(Scalar{} < drive.extras.commutation.overlap_bus_V),
    "this board has no own pulse for the third leg: set another control.current.commutation than overlap");
static_assert(exported::pwm_centre_aligned, "timer 1 counts up and down: set pwm.alignment = centre");
static_assert(exported::sampled_in_middle,
              "timer 1 starts the conversion in the middle of the on-time: set pwm.sample = middle");
static_assert(exported::adc_bits == 10, "the ATmega2560's converter has 10 bits: set sensors.adc_bits = 10");
static_assert(sizeof(Scalar) == 2, "the signals must have 16 bits: set control.arithmetic = q15 or q14");
#ifndef SIXSTEP_DESPITE  // defined by tools/firmware_image.sh --despite, and for an emulated chip
static_assert(
    exported::cleared,
    "the header says that its drive is not cleared for a bridge; tools/firmware_image.sh builds the image with --despite");
#endif
static_assert(exported::dead_time_ps > 0,
              "without a dead time both switches of a leg are on for a moment: set bridge.dead_time_s");

constexpr std::uint32_t clock_Hz = 16'000'000;
// Counts of the timer in half a period, 62.5 ns each. The timer counts up and down in one period.
constexpr std::uint64_t pwm_counts = exported::pwm_period_ps / 62'500 / 2;
static_assert(pwm_counts >= 3 && pwm_counts < 65536, "timer 1 has 16 bits");
// Dead time in cycles, rounded up. change_over() needs at least four cycles.
constexpr std::uint64_t dead_cycles =
    exported::dead_time_ps <= 250'000 ? 4 : (exported::dead_time_ps + 62'499) / 62'500;
static_assert(dead_cycles <= 80,
              "an interrupt waits for the dead time: set bridge.dead_time_s to 5 us or less");

// Bounds of readings, in counts. An intact board stays within them.
constexpr std::uint16_t middle = 512;
/// A phase current above this value is a fault: 0.9 of its transducer's range. Set it below the limits of
/// switches and motor.
constexpr std::uint16_t over_current_counts = 461;
/// A reading that is closer to an end of the converter's range than this bound indicates a broken wire. Each
/// input needs a resistor of at most 10 kohm to ground. It pulls the input of a broken wire to ground against
/// the charge of the previous channel.
constexpr std::uint16_t end_counts = 8;
/// Bound of the sum of the three currents. The currents' samples are half a period apart, so the bound is
/// larger than any ripple.
constexpr std::uint16_t sum_counts = 192;
constexpr std::uint8_t strange_sums = 3;
/// Band around the potentiometer's middle in which the setpoint counts as 0.
constexpr std::uint16_t zero_counts = 10;

constexpr bool is_within(std::uint16_t counts, std::uint16_t of_middle) {
  return static_cast<std::uint16_t>(counts - middle + of_middle) <= 2 * of_middle;
}
constexpr bool is_at_end(std::uint16_t counts) { return !is_within(counts, middle - 1 - end_counts); }

constexpr AdcConfig<Scalar> currents{.per_eighth = units.amperes_per_count(exported::adc_amperes_per_count),
                                     .offset_counts = middle};
constexpr std::uint16_t offset_tolerance = 15;
constexpr Units<Scalar> plain{};
constexpr AdcConfig<Scalar> potentiometer{
    .per_eighth =
        (drive.mode == Mode::duty ? plain : units).amperes_per_count(exported::setpoint_range / 512),
    .offset_counts = middle};
constexpr std::uint8_t potentiometer_channel = 3;

/// Tables indexed by the Hall pins as read from port K. A table look-up takes a few cycles, a computation
/// dozens.
struct ByPins {
  std::uint8_t code[8], source[8], second[8], third[8];
};
constexpr ByPins by_pins = [] {
  ByPins by{};
  for (unsigned pins = 0; pins < 8; ++pins) {  // PK0 is H1, the highest bit
    const auto code = static_cast<std::uint8_t>((pins & 1) << 2 | (pins & 2) | (pins & 4) >> 2);
    by.code[pins] = code;
    by.source[pins] = static_cast<std::uint8_t>(positive_pair(sector_of_hall(code)).source);
    by.second[pins] = static_cast<std::uint8_t>((by.source[pins] + 1) % 3);
    by.third[pins] = static_cast<std::uint8_t>((by.source[pins] + 2) % 3);
  }
  return by;
}();

/// Majority of three readings of the Hall pins, six cycles apart. A switching edge of the bridge disturbs the
/// pins for about 0.3 us (4.8 cycles), so only one reading is disturbed. A Hall edge between the readings
/// causes the Hall interrupt again. The function is in assembly (19 cycles), because a compiler does not
/// guarantee the interval.
inline std::uint8_t hall_pins() {
  std::uint8_t pins, second, third;
  asm volatile(
      "lds %[pins], %[PINK]\n\t"
      "rjmp .+0\n\t"  // takes two cycles, in one word of code
      "rjmp .+0\n\t"
      "lds %[second], %[PINK]\n\t"
      "mov %[third], %[pins]\n\t"
      "and %[pins], %[second]\n\t"
      "or %[second], %[third]\n\t"
      "nop\n\t"
      "lds %[third], %[PINK]\n\t"
      "and %[third], %[second]\n\t"
      "or %[pins], %[third]"
      : [pins] "=&r"(pins), [second] "=&r"(second), [third] "=&r"(third)
      : [PINK] "i"(atmega2560::PINK));
  return pins & 7;
}
static_assert(clock_Hz == 16'000'000);
/// The pins at the last Hall interrupt. The gates drive the pair for these pins until the next Hall
/// interrupt.
inline volatile std::uint8_t pins_seen = 0;

/// Like adc_value(), but without saturation, which 10 bits do not need, and with 16-bit differences: 32-bit
/// differences would take a hundred cycles more.
inline Scalar value_of(const AdcConfig<Scalar>& config, std::int16_t offset, std::uint16_t counts) {
  const auto eighths = static_cast<std::int16_t>(static_cast<std::int16_t>(counts * 8) - offset);
  return ScalarTraits<Scalar>::product(Scalar::from_raw(eighths), config.per_eighth);
}

/// The upper half of a 32-bit product in 20 cycles; the library's function takes 100.
inline std::uint16_t upper_half(std::uint16_t a, std::uint16_t b) {
  std::uint16_t half;
  std::uint8_t low, zero;
  asm("clr %[zero]\n\t"
      "mul %A[a], %A[b]\n\t"
      "mov %[low], r1\n\t"
      "mul %B[a], %B[b]\n\t"
      "movw %A[half], r0\n\t"
      "mul %A[a], %B[b]\n\t"
      "add %[low], r0\n\t"
      "adc %A[half], r1\n\t"
      "adc %B[half], %[zero]\n\t"
      "mul %B[a], %A[b]\n\t"
      "add %[low], r0\n\t"
      "adc %A[half], r1\n\t"
      "adc %B[half], %[zero]\n\t"
      "clr r1"
      : [half] "=&r"(half), [low] "=&r"(low), [zero] "=&r"(zero)
      : [a] "r"(a), [b] "r"(b)
      : "r0");
  return half;
}

/// The on-time in timer counts for a duty from 0 to 1.
inline std::uint16_t counts_of(Scalar duty) {
  constexpr int ahead = 16 - Scalar::fraction_bits;
  static_assert(ahead > 0 && pwm_counts << (ahead - 1) < 65536, "a product of 32 bits, a duty of 1 included");
  return upper_half(static_cast<std::uint16_t>(duty.raw << 1),
                    static_cast<std::uint16_t>(pwm_counts << (ahead - 1)));
}

}  // namespace firmware
