// SPDX-License-Identifier: Apache-2.0
// Lists the registers of an STM32F303 that the program uses, and their bits. Source: ST RM0316; each register
// names its section. Source for the core (SCB, NVIC): Arm, ARMv7-M reference, B3.2 and B3.4.
#pragma once
#include <cstdint>

namespace firmware {

using Register = volatile std::uint32_t;

using Address = decltype(sizeof 0);  // as wide as a pointer

template <class Block>
inline Block& block(Address address) {
  return *reinterpret_cast<Block*>(address);
}
inline Register& word_at(Address address) { return block<Register>(address); }

/// Registers of reset and clocks (9.4).
struct Rcc {
  Register CR, CFGR, CIR, APB2RSTR, APB1RSTR, AHBENR, APB2ENR, APB1ENR, BDCR, CSR, AHBRSTR, CFGR2, CFGR3;
};
static_assert(sizeof(Rcc) == 0x34);

/// Registers of TIM1 and TIM2, which have the same layout (20.4 and 21.4). The program does not use registers
/// that a timer lacks.
struct Timer {
  Register CR1, CR2, SMCR, DIER, SR, EGR, CCMR1, CCMR2, CCER, CNT, PSC, ARR, RCR, CCR[4], BDTR;
};
static_assert(sizeof(Timer) == 0x48);

/// Registers of a converter (15.5).
struct Adc {
  Register ISR, IER, CR, CFGR, unused_1, SMPR1, SMPR2, unused_2[12], JSQR, unused_3[12], JDR[4];
};
static_assert(sizeof(Adc) == 0x90);

/// Registers of a port (11.4).
struct Gpio {
  Register MODER, OTYPER, OSPEEDR, PUPDR, IDR, ODR, BSRR, LCKR, AFR[2];
};
static_assert(sizeof(Gpio) == 0x28);

/// Registers of a serial line (29.8).
struct Usart {
  Register CR1, CR2, CR3, BRR, GTPR, RTOR, RQR, ISR, ICR, RDR, TDR;
};
static_assert(sizeof(Usart) == 0x2C);

/// Registers of the independent watchdog (25.4).
struct Watchdog {
  Register KR, PR, RLR, SR;
};

// Addresses from the memory map (3.2.2).
inline Rcc& rcc() { return block<Rcc>(0x40021000); }
inline Register& flash_acr() { return word_at(0x40022000); }  // section 4.5.1
inline Timer& tim1() { return block<Timer>(0x40012C00); }
inline Timer& tim2() { return block<Timer>(0x40000000); }
inline Adc& adc1() { return block<Adc>(0x50000000); }
inline Register& adc12_ccr() { return word_at(0x50000308); }
inline Gpio& gpio_a() { return block<Gpio>(0x48000000); }
inline Gpio& gpio_b() { return block<Gpio>(0x48000400); }
inline Gpio& gpio_c() { return block<Gpio>(0x48000800); }
inline Usart& usart2() { return block<Usart>(0x40004400); }
inline Watchdog& iwdg() { return block<Watchdog>(0x40003000); }
inline Register& debug_apb1_freeze() { return word_at(0xE0042008); }
inline Register& debug_apb2_freeze() { return word_at(0xE004200C); }
inline Register& syscfg_cfgr2() { return word_at(0x40010018); }  // section 12.1
/// Registers for the peripherals' interrupts. One word enables or disables 32 interrupts. Each interrupt has
/// a priority byte, of which only the upper four bits are implemented.
inline Register& nvic_enable(unsigned irq) { return word_at(0xE000E100 + 4 * (irq / 32)); }
inline Register& nvic_disable(unsigned irq) { return word_at(0xE000E180 + 4 * (irq / 32)); }
inline volatile std::uint8_t& nvic_priority(unsigned irq) {
  return block<volatile std::uint8_t>(0xE000E400 + irq);
}
inline Register& aircr() { return word_at(0xE000ED0C); }
inline Register& cpacr() { return word_at(0xE000ED88); }

namespace bit {

// RCC_CR, CFGR, CIR, CSR
constexpr std::uint32_t HSEON = 1u << 16, HSERDY = 1u << 17, HSEBYP = 1u << 18, CSSON = 1u << 19,
                        PLLON = 1u << 24, PLLRDY = 1u << 25;
constexpr std::uint32_t CSSC = 1u << 23;
constexpr std::uint32_t SW_PLL = 2u << 0, SWS = 3u << 2, SWS_PLL = 2u << 2, PPRE1_half = 4u << 8,
                        PLLSRC_HSE = 1u << 16, PLLMUL_9 = 7u << 18;
constexpr std::uint32_t RMVF = 1u << 24, IWDGRSTF = 1u << 29;
// RCC_AHBENR, APB2ENR, APB1ENR
constexpr std::uint32_t IOPAEN = 1u << 17, IOPBEN = 1u << 18, IOPCEN = 1u << 19, ADC12EN = 1u << 28;
constexpr std::uint32_t SYSCFGEN = 1u << 0, TIM1EN = 1u << 11, TIM2EN = 1u << 0, USART2EN = 1u << 17;
// FLASH_ACR
constexpr std::uint32_t LATENCY_2 = 2, PRFTBE = 1u << 4;
// TIMx_CR1, CR2, DIER, SR, EGR, BDTR
constexpr std::uint32_t CEN = 1u << 0, ARPE = 1u << 7;
constexpr std::uint32_t CCPC = 1u << 0, TI1S = 1u << 7, MMS2_OC4REF = 7u << 20;
constexpr std::uint32_t CC1IE = 1u << 1, CC1IF = 1u << 1, CC4IE = 1u << 4, CC4IF = 1u << 4, BIE = 1u << 7,
                        BIF = 1u << 7;
constexpr std::uint32_t UG = 1u << 0, COMG = 1u << 5;
constexpr std::uint32_t OSSI = 1u << 10, OSSR = 1u << 11, BKE = 1u << 12, BKP = 1u << 13, MOE = 1u << 15;
// TIMx_CCMR1 as outputs (OCxM, OCxPE) and as an input (CC1S), CCER
constexpr std::uint8_t force_low = 4, force_high = 5, pwm_1 = 6, pwm_2 = 7;
constexpr std::uint32_t preload = 1u << 3;
constexpr std::uint32_t CC1S_TI1 = 1, IC1F_256_counts = 15u << 4;
constexpr std::uint32_t CC1E = 1u << 0, CC1P = 1u << 1, CC1NP = 1u << 3;
// ADC_ISR, IER, CR, JSQR, CCR
constexpr std::uint32_t ADRDY = 1u << 0, JEOS = 1u << 6;
constexpr std::uint32_t ADEN = 1u << 0, JADSTART = 1u << 3, ADVREGEN = 1u << 28, ADCAL = 1u << 31;
constexpr std::uint32_t JL_4 = 3, JEXTSEL_TIM1_TRGO2 = 8u << 2, JEXTEN_rising = 1u << 6;
constexpr std::uint32_t CKMODE_HCLK = 1u << 16;
// USART_CR1, ISR
constexpr std::uint32_t UE = 1u << 0, RE = 1u << 2, TE = 1u << 3, RXNEIE = 1u << 5, OVER8 = 1u << 15;
constexpr std::uint32_t FE = 1u << 1, NF = 1u << 2, ORE = 1u << 3, RXNE = 1u << 5, TXE = 1u << 7;
// IWDG_KR
constexpr std::uint32_t unlock = 0x5555, reload = 0xAAAA, start = 0xCCCC;
// DBGMCU, SYSCFG_CFGR2, SCB_AIRCR
constexpr std::uint32_t IWDG_STOP = 1u << 12, TIM1_STOP = 1u << 0, TIM2_STOP = 1u << 0;
constexpr std::uint32_t LOCKUP_LOCK = 1u << 0;
constexpr std::uint32_t SYSRESETREQ = 0x05FA0004;

}  // namespace bit

/// Numbers of interrupts in the vector table, counted after the core's own sixteen entries (14.1).
constexpr unsigned irq_adc1_2 = 18, irq_tim1_break = 24, irq_tim1_compare = 27, irq_tim2 = 28,
                   irq_usart2 = 38;

}  // namespace firmware
