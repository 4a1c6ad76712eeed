// SPDX-License-Identifier: Apache-2.0
// Describes the board around the chip, as the scenario simulated it. The pins are those of an STM32F303RE
// Nucleo:
//
//   PA8 PA9 PA10       upper gates a b c     TIM1_CH1..3
//   PB13 PB14 PB15     lower gates a b c     TIM1_CH1N..3N
//   PB12               the power stage's comparator or fault output, low or a lost wire: all gates off   TIM1_BKIN
//   PA0 PC1 PC0, PA1   currents a b c, bus   ADC1_IN1, 7, 6, 2; transducers in line with the phases
//   PA15 PB3 PB10      Hall H1 H2 H3         TIM2_CH1..3, whose XOR is captured
//   PA2 PA3            serial line           USART2, on the Nucleo at its debugger's USB
#pragma once
#include <drive_config.hpp>

#include "faces/firmware/example/cortex_m/registers.hpp"
#include "sixstep/control/protected_drive.hpp"

namespace firmware {

#ifdef SIXSTEP_DESPITE
constexpr bool accepts_uncleared = true;  // set by tools/firmware_image.sh --despite
#else
constexpr bool accepts_uncleared = false;
#endif

using namespace sixstep::control;
using exported::Scalar;

constexpr std::uint32_t clock_Hz = 72'000'000;
/// True: the Nucleo's debugger supplies a clock of 8 MHz. Set it to false for a crystal.
constexpr bool has_external_clock = true;

/// Whether bootstrap capacitors feed the upper gates (IR21xx, L638x and most shields). A capacitor charges
/// while the output of its leg is low. Therefore all lower gates pulse for a while before the first pulse of
/// an upper gate, every on-time is followed by a least off-time, and no chopping mode keeps an upper gate on.
constexpr bool upper_gates_by_bootstrap = true;
constexpr std::uint32_t charge_ns = 2'000, charge_periods = 100, least_gap_ns = 1'500;
/// The level of the break input that turns all gates off. The chip pulls the pin to this level, so a broken
/// wire turns the gates off too. An open-drain output that drives the wire needs a pull-up at the other end
/// of the wire.
constexpr bool break_active_high = false;

// All other constants follow from the drive.
static_assert(
    exported::cleared || accepts_uncleared,
    "the header says that its drive is not cleared for a bridge; tools/firmware_image.sh builds the image with --despite");

constexpr std::uint32_t counts_of_ns(std::uint64_t ns) {
  return static_cast<std::uint32_t>((ns * (clock_Hz / 1'000'000) + 999) / 1'000);
}
constexpr auto pwm_counts =
    static_cast<std::uint32_t>(exported::pwm_period_ps * (clock_Hz / 1'000'000) / 1'000'000);
/// Least control period in timer counts. It is the worst-case number of instructions of a control tick and a
/// Hall interrupt, one count each, plus the flash's wait states. With a shorter period, each Hall edge would
/// delay an answer by a period. A late answer takes effect a period later and is reported
/// (tests/target/image_load.py).
constexpr std::uint32_t least_period_counts = 1600;
static_assert(pwm_counts >= least_period_counts && pwm_counts <= 65536,
              "the interrupts take 1600 counts, and TIM1 has 16 bits: set pwm.period_s to 22.3e-6 or more");
constexpr auto dead_counts =
    static_cast<std::uint32_t>((exported::dead_time_ps * (clock_Hz / 1'000'000) + 999'999) / 1'000'000);
static_assert(dead_counts > 0,
              "without a dead time both switches of a leg are on for a moment: set bridge.dead_time_s");
static_assert(dead_counts <= 1008, "TIM1 counts at most 14 us of dead time: lower bridge.dead_time_s");
static_assert(dead_counts <= pwm_counts / 4,
              "interrupts wait for the dead time: set it to at most a quarter of pwm.period_s");
/// The converter samples the three currents and the bus one microsecond before the update, so that the
/// samples precede the switching at the period's start. The interrupt that changes outputs at the period's
/// end occurs some counts before the update (event_count).
constexpr std::uint32_t sample_count = pwm_counts - clock_Hz / 1'000'000, event_count = pwm_counts - 12;
constexpr std::uint32_t most_on_counts = pwm_counts - counts_of_ns(least_gap_ns);
constexpr std::uint32_t charge_counts = counts_of_ns(charge_ns);
static_assert(counts_of_ns(least_gap_ns) <= pwm_counts / 4 && charge_counts <= pwm_counts / 8);

// Gains, converters, capture and thresholds, as the scenario simulated them.
constexpr const ProtectedConfig<Scalar>& config = exported::product;
static_assert(sizeof(Scalar) == 4 && Scalar(0.5f) > Scalar{},
              "this board computes in float: set control.arithmetic = float");
static_assert(
    !(Scalar{} < config.drive.extras.commutation.overlap_bus_V),
    "this board has no own pulse for the third leg: set another control.current.commutation than overlap");
static_assert(config.drive.current_control != CurrentControl::hysteresis ||
                  config.drive.hysteresis.watch == Watch::none,
              "this board has no comparators that switch the legs: set control.current.comparator = sampled");
static_assert(config.sensing == CurrentSensing::phases,
              "this board has a transducer in each phase: set sensors.currents = phases");
static_assert(
    !upper_gates_by_bootstrap || !config.drive.extras.on ||
        config.drive.extras.pwm.pattern == PwmPattern::upper,
    "this pattern keeps upper gates on for 60 degrees and more, too long for bootstraps at low speed: set pwm.pattern = upper");
static_assert(!exported::pwm_centre_aligned,
              "TIM1 counts up, so that a period begins with the on-time: set pwm.alignment = edge");
static_assert(exported::command_delayed,
              "a command takes effect in the next period: set pwm.delay_periods = 1");
static_assert(!exported::commutate_at_sample,
              "the Hall interrupt changes the pair: set pwm.commutation = hall-edge");
static_assert(!exported::sampled_in_middle,
              "the converter samples at the start of a period: set pwm.sample = start");
static_assert(exported::timer_Hz == clock_Hz,
              "TIM2 counts the core's clock: set sensors.capture_Hz to clock_Hz, or every speed is wrong");

/// Majority of three readings, a quarter of a microsecond apart. A switching edge of the bridge disturbs only
/// one of the readings.
inline std::uint8_t hall_pins_once() {
  const std::uint32_t a = gpio_a().IDR, b = gpio_b().IDR;
  return static_cast<std::uint8_t>((a >> 15 & 1) << 2 | (b >> 3 & 1) << 1 | (b >> 10 & 1));
}
inline void quarter_of_a_microsecond() {
#pragma GCC unroll 18
  for (int n = 0; n < 18; ++n) asm volatile("nop");  // each nop takes at least one clock
}
static_assert(clock_Hz / 4'000'000 == 18);
/// The Hall code of the pins; PA15 is H1, the highest bit.
inline std::uint8_t hall_pins() {
  const unsigned first = hall_pins_once();
  quarter_of_a_microsecond();
  const unsigned second = hall_pins_once();
  quarter_of_a_microsecond();
  const unsigned third = hall_pins_once();
  return static_cast<std::uint8_t>((first & second) | (second & third) | (first & third));
}

}  // namespace firmware
