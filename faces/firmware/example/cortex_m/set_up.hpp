// SPDX-License-Identifier: Apache-2.0
// Sets the registers before the first interrupt. tests/target/images.py runs these functions and compares
// each register with RM0316.
#pragma once
#include "faces/firmware/example/cortex_m/board.hpp"
#include "faces/firmware/example/cortex_m/bridge.hpp"

namespace firmware {

constexpr std::uint32_t baud = 1'000'000;

/// Whether the condition became true within `looks` checks. The number is limited, so that a broken part does
/// not prevent the report about the other parts. At 8 MHz the checks take 20 ms, less than the watchdog's
/// time. A crystal starts within 10 ms.
template <class Condition>
bool waited_for(Condition condition, std::uint32_t looks = 20'000) {
  for (; looks > 0; --looks)
    if (condition()) return true;
  return false;
}

constexpr std::uint32_t own_clock_Hz =
    8'000'000;  // frequency of the chip's own clock, which runs after a reset and if the external clock is
                // missing

/// Sets the clock to 9 times 8 MHz. Returns false if there is no external clock; the chip then runs on its
/// own 8 MHz. If the external clock stops later, TIM1's break turns the gates off, and NMI_Handler is called
/// (9.2.7).
inline bool set_up_clock() {
  rcc().CR = rcc().CR | bit::HSEON | (has_external_clock ? bit::HSEBYP : 0);
  if (!waited_for([] { return (rcc().CR & bit::HSERDY) != 0; })) return false;
  flash_acr() = bit::LATENCY_2 | bit::PRFTBE;  // wait states for clocks above 48 MHz (4.5.1)
  rcc().CFGR = bit::PPRE1_half | bit::PLLSRC_HSE | bit::PLLMUL_9;
  rcc().CR = rcc().CR | bit::PLLON;
  if (!waited_for([] { return (rcc().CR & bit::PLLRDY) != 0; })) return false;
  rcc().CFGR = rcc().CFGR | bit::SW_PLL;
  if (!waited_for([] { return (rcc().CFGR & bit::SWS) == bit::SWS_PLL; })) return false;
  rcc().CR = rcc().CR | bit::CSSON;
  return true;
}

/// Selects the chip's own 8 MHz. The chip has already switched to it when the external clock stopped.
inline void fall_back_to_own_clock() { rcc().CFGR = 0; }

inline void switch_parts_on() {
  rcc().AHBENR = rcc().AHBENR | bit::IOPAEN | bit::IOPBEN | bit::IOPCEN | bit::ADC12EN;
  rcc().APB2ENR = rcc().APB2ENR | bit::TIM1EN | bit::SYSCFGEN;
  rcc().APB1ENR = rcc().APB1ENR | bit::TIM2EN | bit::USART2EN;
  // A debugger that stops the core also stops the timer, whose outputs are then off, the clock of the log,
  // and the watchdog.
  debug_apb2_freeze() = bit::TIM1_STOP;
  debug_apb1_freeze() = bit::IWDG_STOP | bit::TIM2_STOP;
  syscfg_cfgr2() = bit::LOCKUP_LOCK;  // a lockup of the core causes a break too
}

enum class PinMode : std::uint32_t { input, output, alternate, analog };
enum class Pull : std::uint32_t { none, up, down };

inline void set_pin(Gpio& port, unsigned pin, PinMode mode, Pull pull, std::uint32_t function = 0) {
  const auto with = [pin](std::uint32_t all, unsigned bits, unsigned of, std::uint32_t value) {
    const unsigned shift = pin % of * bits;
    return (all & ~(((1u << bits) - 1) << shift)) | value << shift;
  };
  Register& functions = port.AFR[pin / 8];
  functions = with(functions, 4, 8, function);
  port.PUPDR = with(port.PUPDR, 2, 16, static_cast<std::uint32_t>(pull));
  port.MODER = with(port.MODER, 2, 16, static_cast<std::uint32_t>(mode));
}

/// Sets the pins' functions, from the data sheet's tables of alternate functions (DS9118, DocID026415).
inline void set_up_pins() {
  for (unsigned pin = 8; pin <= 10; ++pin)
    set_pin(gpio_a(), pin, PinMode::alternate, Pull::down, 6);                              // TIM1_CHx
  set_pin(gpio_b(), 13, PinMode::alternate, Pull::down, 6);                                 // TIM1_CH1N
  set_pin(gpio_b(), 14, PinMode::alternate, Pull::down, 6);                                 // TIM1_CH2N
  set_pin(gpio_b(), 15, PinMode::alternate, Pull::down, 4);                                 // TIM1_CH3N
  set_pin(gpio_b(), 12, PinMode::alternate, break_active_high ? Pull::up : Pull::down, 6);  // TIM1_BKIN
  set_pin(gpio_a(), 15, PinMode::alternate, Pull::up, 1);                                   // TIM2_CH1
  set_pin(gpio_b(), 3, PinMode::alternate, Pull::up, 1);                                    // TIM2_CH2
  set_pin(gpio_b(), 10, PinMode::alternate, Pull::up, 1);                                   // TIM2_CH3
  set_pin(gpio_a(), 2, PinMode::alternate, Pull::none, 7);                                  // USART2_TX
  set_pin(gpio_a(), 3, PinMode::alternate, Pull::up, 7);                                    // USART2_RX
  for (unsigned pin = 0; pin <= 1; ++pin) {
    set_pin(gpio_a(), pin, PinMode::analog, Pull::none);
    set_pin(gpio_c(), pin, PinMode::analog, Pull::none);
  }
}

/// Sets the line's rate for a bus clock of `bus_Hz`, with eight samples per bit if the bus is too slow for
/// sixteen (29.5.4).
inline void set_up_serial_line(std::uint32_t bus_Hz) {
  const bool eight = bus_Hz < 16 * baud;
  const std::uint32_t divider = (eight ? 2 * bus_Hz : bus_Hz) / baud;
  usart2().CR1 = 0;  // the line must be off while its settings change
  usart2().BRR = eight ? (divider & ~0xFu) | (divider & 0xF) >> 1 : divider;
  usart2().CR1 = (eight ? bit::OVER8 : 0) | bit::RXNEIE | bit::UE | bit::TE | bit::RE;
}

/// Enables the gates. The break input must be inactive before.
inline void let_gates_work() { tim1().BDTR = tim1().BDTR | bit::MOE; }
/// Disables the gates in hardware, independent of the output registers.
inline void forbid_gates() { tim1().BDTR = tim1().BDTR & ~bit::MOE; }
inline bool gates_may_work() { return (tim1().BDTR & bit::MOE) != 0; }

/// Sets TIM1. It counts up, and its update begins a period. Enable bits and modes are preloaded, and all
/// three channels load them together at a commutation event. The fourth channel has no pin. Its reference
/// rises a microsecond before the update and starts the converter. Without MOE the outputs are driven low
/// (OSSI).
inline void set_up_bridge_timer() {
  const GateOutputs off = registers(BridgeOutputs{});
  tim1().PSC = 0;
  tim1().ARR = pwm_counts - 1;
  tim1().CR2 = bit::CCPC | bit::MMS2_OC4REF;
  tim1().CCMR1 = off.CCMR1;
  tim1().CCMR2 = off.CCMR2;
  tim1().CCER = off.CCER;
  tim1().CCR[3] = sample_count;
  tim1().BDTR =
      dead_time_bits(dead_counts) | bit::OSSR | bit::OSSI | bit::BKE | (break_active_high ? bit::BKP : 0);
  tim1().EGR = bit::UG | bit::COMG;
  tim1().SR = 0;
  tim1().DIER = bit::BIE;
  let_gates_work();
  tim1().CR1 = bit::ARPE | bit::CEN;
}

/// Sets TIM2, with 32 bits at 72 MHz. Each edge of the XOR of its three inputs is captured once the level has
/// been stable for 256 counts, 3.6 us. The ringing after a switching edge of the bridge is shorter.
inline void set_up_hall_timer() {
  tim2().PSC = 0;
  tim2().ARR = 0xFFFFFFFF;
  tim2().CR2 = bit::TI1S;
  tim2().CCMR1 = bit::CC1S_TI1 | bit::IC1F_256_counts;
  tim2().CCER = bit::CC1E | bit::CC1P | bit::CC1NP;
  tim2().DIER = bit::CC1IE;
  tim2().EGR = bit::UG;
  tim2().CR1 = bit::CEN;
}

/// Sets the injected sequence a, b, c, bus. Each conversion samples for 7.5 clocks and converts for 12.5
/// clocks of 72 MHz. The samples are taken from 72 to 64, 52 to 44, 32 to 24 and 12 to 4 counts before the
/// update. Returns false if the converter does not react.
inline bool set_up_converter() {
  adc12_ccr() = bit::CKMODE_HCLK;
  adc1().CR = 0;
  adc1().CR = bit::ADVREGEN;
  for (std::uint32_t n = 0; n < clock_Hz / 100'000; ++n)
    asm volatile("");  // waits 10 us for the converter's voltage regulator (15.3.6)
  adc1().CR = bit::ADVREGEN | bit::ADCAL;
  if (!waited_for([] { return (adc1().CR & bit::ADCAL) == 0; })) return false;
  // ADEN takes effect only four converter clocks after the calibration (15.3.9), so it is written repeatedly
  // until the converter is ready.
  if (!waited_for([] {
        adc1().CR = bit::ADVREGEN | bit::ADEN;
        return (adc1().ISR & bit::ADRDY) != 0;
      }))
    return false;
  constexpr std::uint32_t clocks_7_5 = 3, a = 1, b = 7, c = 6, bus = 2;  // sample time, and channels
  adc1().SMPR1 = clocks_7_5 << 3 * a | clocks_7_5 << 3 * b | clocks_7_5 << 3 * c | clocks_7_5 << 3 * bus;
  adc1().JSQR =
      bit::JL_4 | bit::JEXTSEL_TIM1_TRGO2 | bit::JEXTEN_rising | a << 8 | b << 14 | c << 20 | bus << 26;
  adc1().IER = bit::JEOS;
  adc1().CR = bit::ADVREGEN | bit::ADEN | bit::JADSTART;
  return true;
}

/// Starts the watchdog, which resets the chip after 40 ms of the watchdog's own clock of about 40 kHz.
inline void set_up_watchdog() {
  iwdg().KR = bit::start;
  iwdg().KR = bit::unlock;
  iwdg().PR = 0;  // prescaler: a quarter of its clock
  iwdg().RLR = 400;
  waited_for([] { return iwdg().SR == 0; });
  iwdg().KR = bit::reload;
}

/// Sets priorities and enables interrupts. The control tick and the Hall interrupt have the same priority, so
/// that neither interrupts the other. The interrupts of the period's end and of the break interrupt both of
/// them. The interrupt of the serial line has the lowest priority. The chip implements the upper four bits of
/// a priority.
inline void listen_to_interrupts() {
  nvic_priority(irq_tim1_compare) = 0x00;
  nvic_priority(irq_tim1_break) = 0x00;
  nvic_priority(irq_adc1_2) = 0x40;
  nvic_priority(irq_tim2) = 0x40;
  nvic_enable(0) = 1u << irq_adc1_2 | 1u << irq_tim1_break | 1u << irq_tim1_compare | 1u << irq_tim2;
}
inline void listen_to_serial_line() {
  nvic_priority(irq_usart2) = 0x80;
  nvic_enable(irq_usart2) = 1u << irq_usart2 % 32;
}
inline void stop_control_interrupts() {
  nvic_disable(0) = 1u << irq_adc1_2 | 1u << irq_tim1_compare | 1u << irq_tim2;
}

}  // namespace firmware
