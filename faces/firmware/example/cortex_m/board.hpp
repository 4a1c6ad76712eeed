// SPDX-License-Identifier: Apache-2.0
// What stands around the chip, as the scenario simulated it. Pins as an STM32F303RE Nucleo leads them out:
//
//   PA8 PA9 PA10       upper gates a b c     TIM1_CH1..3
//   PB13 PB14 PB15     lower gates a b c     TIM1_CH1N..3N
//   PA0 PC1 PC0, PA1   currents a b c, bus   ADC1_IN1, 7, 6, 2
//   PA15 PB3 PB10      Hall H1 H2 H3         TIM2_CH1..3, whose XOR is captured
//   PA2 PA3            serial line           USART2, on the Nucleo at its debugger's USB
#pragma once
#include <drive_config.hpp>

#include "faces/firmware/example/cortex_m/registers.hpp"
#include "sixstep/control/protected_drive.hpp"

namespace firmware {

using namespace sixstep::control;
using exported::Scalar;

constexpr std::uint32_t clock_Hz = 72'000'000;
/// The Nucleo's 8 MHz come from its debugger, as a clock; with a crystal this is false.
constexpr bool has_external_clock = true;

constexpr auto pwm_counts =
    static_cast<std::uint32_t>(exported::pwm_period_ps * (clock_Hz / 1'000'000) / 1'000'000);
static_assert(pwm_counts >= 100 && pwm_counts <= 65536, "TIM1 has 16 bits");

// Gains, converters, capture and thresholds, as the scenario simulated them.
constexpr const ProtectedConfig<Scalar>& config = exported::product;
static_assert(sizeof(Scalar) == 4 && Scalar(0.5f) > Scalar{}, "a duty becomes counts by multiplying floats");
static_assert(!(Scalar{} < config.drive.extras.commutation.overlap_bus_V),
              "the leg in no pair has no pulse of its own here");
static_assert(!exported::pwm_centre_aligned,
              "TIM1 counts up; a period begins with the on-time, and is sampled there");
static_assert(exported::command_delayed,
              "the compare registers are preloaded: a command counts from the next period on");

/// PA15 is H1, the highest bit.
inline std::uint8_t hall_pins() {
  const std::uint32_t a = gpio_a().IDR, b = gpio_b().IDR;
  return static_cast<std::uint8_t>((a >> 15 & 1) << 2 | (b >> 3 & 1) << 1 | (b >> 10 & 1));
}

}  // namespace firmware
