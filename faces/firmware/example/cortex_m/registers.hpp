// SPDX-License-Identifier: Apache-2.0
// The registers of an STM32F303 that the example touches. Addresses: ST RM0316, memory map (3.2.2), TIM1
// (20.4), ADC (15.5), TIM2 (21.4), GPIO (11.4).
#pragma once
#include <cstdint>

namespace firmware {

using Register = volatile std::uint32_t;

/// Layout shared by TIM1 and TIM2; what one of them lacks is not used of it.
struct Timer {
  Register CR1, CR2, SMCR, DIER, SR, EGR, CCMR1, CCMR2, CCER, CNT, PSC, ARR, RCR, CCR[4], BDTR;
};
static_assert(sizeof(Timer) == 0x48);

/// ISR and the injected results.
struct Adc {
  Register ISR;
  Register unused[31];
  Register JDR[4];
};
static_assert(sizeof(Adc) == 0x90);

struct Gpio {
  Register MODER, OTYPER, OSPEEDR, PUPDR, IDR;
};

inline Timer& tim1() { return *reinterpret_cast<Timer*>(0x40012C00); }
inline Timer& tim2() { return *reinterpret_cast<Timer*>(0x40000000); }
inline Adc& adc1() { return *reinterpret_cast<Adc*>(0x50000000); }
inline Gpio& gpio_a() { return *reinterpret_cast<Gpio*>(0x48000000); }

constexpr std::uint32_t adc_jeos = 1u << 6;     // ISR: all injected conversions done; cleared by writing 1
constexpr std::uint32_t timer_cc1if = 1u << 1;  // SR: a Hall edge was captured; cleared by writing 0
constexpr std::uint32_t force_low = 4, force_high = 5, pwm_1 = 6,
                        pwm_2 = 7;  // OCxM, with the preload bit below
constexpr std::uint32_t preload = 1u << 3;

}  // namespace firmware
