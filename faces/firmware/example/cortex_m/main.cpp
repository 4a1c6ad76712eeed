// SPDX-License-Identifier: Apache-2.0
// Both entries of the drive on an STM32F303 (Cortex-M4F, 72 MHz), in float. Three phase currents and the bus
// by the injected group of ADC1, six gates by TIM1 with its dead time, Hall pins on PA0..PA2 captured by TIM2
// through its XOR.
#include "faces/firmware/example/cortex_m/bridge.hpp"
#include "faces/firmware/example/cortex_m/drive_config.hpp"
#include "faces/firmware/example/cortex_m/registers.hpp"
#include "sixstep/control/protected_drive.hpp"

namespace firmware {

using namespace sixstep::control;
using exported::Scalar, exported::units;

constexpr std::uint32_t clock_MHz = 72;
constexpr auto pwm_counts = static_cast<std::uint32_t>(exported::pwm_period_ps * clock_MHz / 1'000'000);

constexpr ProtectedConfig<Scalar> make_config() {
  ProtectedConfig<Scalar> c;
  c.drive = exported::drive;
  c.setpoint_limit = units.rad_per_s(600);
  // 3.3 V over 12 bits, 0.05 V/A, 0 A in the middle: 33 A both ways
  for (AdcConfig<Scalar>& adc : c.current_adc)
    adc = {.per_eighth = units.amperes_per_count(3.3 / 4096 / 0.05),
           .offset_counts = 2048,
           .offset_tolerance = 60};
  c.bus_adc = {.per_eighth = units.volts_per_count(3.3 / 4096 * 16)};  // divider 15 to 1
  c.speed = units.hall_speed(exported::pole_pairs, clock_MHz * 1e6, 7'200'000, 6);
  c.faults = {.over_current_A = units.amperes(30),
              .over_voltage_V = units.volts(30),
              .under_voltage_V = units.volts(10),
              .over_speed_rad_s = units.rad_per_s(800),
              .stall_current_A = units.amperes(20),
              .stall_ticks = 10'000,
              .voltage_ticks = 3};
  c.brake_current_A = units.amperes(5);
  c.short_below_rad_s = units.rad_per_s(100);
  c.standing_rad_s = units.rad_per_s(5);
  return c;
}
constexpr ProtectedConfig<Scalar> config = make_config();

ProtectedState<Scalar> state;
ProtectedTelemetry<Scalar> telemetry;  // for a display; the drive never reads it
Request request;                       // from the main loop, with interrupts off
Setpoint<Scalar> setpoint;

void apply(const BridgeCommand<Scalar>& command) {
  const Outputs out = outputs(command);
  const auto compare = static_cast<std::uint32_t>(command.duty * static_cast<float>(pwm_counts));
  for (int n = 0; n < 3; ++n) tim1().CCR[n] = compare;
  tim1().CCMR1 = out.CCMR1;
  tim1().CCMR2 = out.CCMR2;
  tim1().CCER = out.CCER;
}

std::uint8_t hall_pins() {  // PA0 is H1, the highest bit
  const std::uint32_t pins = gpio_a().IDR;
  return static_cast<std::uint8_t>((pins & 1) << 2 | (pins & 2) | (pins & 4) >> 2);
}

}  // namespace firmware

/// Once per PWM period: TIM1 triggers the injected group, its end calls here. The same priority as below.
extern "C" void ADC1_2_IRQHandler() {
  using namespace firmware;
  adc1().ISR = adc_jeos;
  BoardInput in;
  for (int n = 0; n < 3; ++n) in.current_counts[n] = static_cast<std::uint16_t>(adc1().JDR[n]);
  in.bus_counts = static_cast<std::uint16_t>(adc1().JDR[3]);
  in.hall_pins = hall_pins();
  in.now = tim2().CNT;
  apply(protected_step(config, state, in, request, setpoint, telemetry));
}

extern "C" void TIM2_IRQHandler() {
  using namespace firmware;
  tim2().SR = ~timer_cc1if;
  apply(protected_on_hall(config, state, hall_pins(), tim2().CCR[0]));
}
