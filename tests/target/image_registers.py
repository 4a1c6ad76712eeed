# SPDX-License-Identifier: Apache-2.0
"""The STM32F303's registers by their addresses, and the content that each must have after the set-up, from RM0316."""

RCC, GPIOA, GPIOB, GPIOC, TIM1, TIM2, ADC1, USART2, IWDG = (0x40021000, 0x48000000, 0x48000400, 0x48000800, 0x40012C00, 0x40000000,
                                                           0x50000000, 0x40004400, 0x40003000)
EGR, CCMR1, CCMR2, CCER, BDTR = (TIM1 + offset for offset in (0x14, 0x18, 0x1C, 0x20, 0x44))


def fields(bits, values):
    """The value of a register. Each field has `bits` bits; `values` gives the fields by their places."""
    return sum(value << bits * place for place, value in values.items())


# Each register with its mask, its value after the set-up, and the words of RM0316 for this value.
TABLE = [
    ("RCC_CR", RCC + 0x00, 0x010D0000, 0x010D0000, "9.4.1: HSEON, HSEBYP, CSSON, PLLON"),
    ("RCC_CFGR", RCC + 0x04, 0x003DBFF3, 0x001D0402, "9.4.2: SW = PLL, HPRE = 1, PPRE1 = /2, PPRE2 = 1, PLLSRC = HSE, PLLMUL = 9"),
    ("RCC_CFGR2", RCC + 0x2C, 0x0000000F, 0x00000000, "9.4.12: PREDIV = 1"),
    ("FLASH_ACR", 0x40022000, 0x17, 0x12, "4.5.1: two wait states above 48 MHz, prefetch"),
    ("RCC_AHBENR", RCC + 0x14, 0x100E0000, 0x100E0000, "9.4.6: ports A, B, C, ADC12"),
    ("RCC_APB2ENR", RCC + 0x18, 0x801, 0x801, "9.4.7: TIM1, SYSCFG"),
    ("SYSCFG_CFGR2", 0x40010018, 0x1, 0x1, "12.1: LOCKUP_LOCK, a core that gives up is a break"),
    ("RCC_APB1ENR", RCC + 0x1C, 0x20001, 0x20001, "9.4.8: TIM2, USART2"),
    ("GPIOA_MODER", GPIOA, 0xFFFFFFFF, fields(2, {0: 3, 1: 3, 2: 2, 3: 2, 8: 2, 9: 2, 10: 2, 13: 2, 14: 2, 15: 2}),
     "11.4.1: PA0, PA1 analog; PA2, PA3, PA8..10, PA15 alternate; PA13, PA14 stay"),
    ("GPIOA_AFRL", GPIOA + 0x20, 0xFF00, 0x7700, "11.4.9: AF7 is USART2 at PA2, PA3"),
    ("GPIOA_AFRH", GPIOA + 0x24, 0xF0000FFF, 0x10000666, "11.4.10: AF6 is TIM1 at PA8..10, AF1 TIM2_CH1 at PA15"),
    ("GPIOA_PUPDR", GPIOA + 0x0C, fields(2, dict.fromkeys((3, 8, 9, 10, 15), 3)), fields(2, {3: 1, 8: 2, 9: 2, 10: 2, 15: 1}),
     "11.4.4: gates pulled down, H1 and the serial line's input up"),
    ("GPIOB_MODER", GPIOB, fields(2, dict.fromkeys((3, 10, 12, 13, 14, 15), 3)), fields(2, dict.fromkeys((3, 10, 12, 13, 14, 15), 2)),
     "11.4.1: PB3, PB10, PB12..15 alternate"),
    ("GPIOB_AFRL", GPIOB + 0x20, 0xF000, 0x1000, "11.4.9: AF1 is TIM2_CH2 at PB3"),
    ("GPIOB_AFRH", GPIOB + 0x24, 0xFFFF0F00, 0x46660100, "11.4.10: AF1 TIM2_CH3 at PB10, AF6 TIM1_BKIN at PB12, TIM1_CH1N, CH2N at PB13, PB14, AF4 CH3N at PB15"),
    ("GPIOB_PUPDR", GPIOB + 0x0C, fields(2, dict.fromkeys((3, 10, 12, 13, 14, 15), 3)), fields(2, {3: 1, 10: 1, 12: 2, 13: 2, 14: 2, 15: 2}),
     "11.4.4: gates pulled down, the break input to its active level, H2 and H3 up"),
    ("GPIOC_MODER", GPIOC, 0xF, 0xF, "11.4.1: PC0, PC1 analog"),
    ("USART2_BRR", USART2 + 0x0C, 0xFFFF, 36, "29.8.4: 36 MHz / 1 000 000"),
    ("USART2_CR1", USART2 + 0x00, 0xFFFFFFFF, 0x2D, "29.8.1: UE, RE, TE, RXNEIE, 8 bits, no parity"),
    ("TIM1_CR1", TIM1 + 0x00, 0xFFFF, 0x81, "20.4.1: counts up, ARR preloaded, runs"),
    ("TIM1_CR2", TIM1 + 0x04, 0xFFFFFF, 0x700001, "20.4.2: CCPC, a COM event by software alone (CCUS = 0), TRGO2 is OC4REF"),
    ("TIM1_PSC", TIM1 + 0x28, 0xFFFF, 0, "20.4.11"),
    ("TIM1_ARR", TIM1 + 0x2C, 0xFFFF, 2159, "20.4.12: 30 us of 72 MHz"),
    ("TIM1_CCMR1", CCMR1, 0x0101FFFF, 0x4848, "20.4.7: OC1M = OC2M = 100 (forced inactive), OCxPE"),
    ("TIM1_CCMR2", CCMR2, 0x0101FFFF, 0x7848, "20.4.8: OC4M = 111 (high from its compare value on), OC4PE"),
    ("TIM1_CCER", CCER, 0xFFFF, 0x111, "20.4.9: of each leg one output, at its forced low level, the other driven inactive (OSSR)"),
    ("TIM1_CCR4", TIM1 + 0x40, 0xFFFF, 2088, "20.4.17: 1 us before the update"),
    ("TIM1_DIER", TIM1 + 0x0C, 0xFFFF, 0x80, "20.4.4: BIE"),
    ("TIM1_BDTR", BDTR, 0x3FFFFFF, 0x9C24, "20.4.18: MOE, BKE, active low, no filter, OSSR, OSSI, DTG = 36: 0.5 us of 72 MHz"),
    ("TIM2_CR2", TIM2 + 0x04, 0xFF, 0x80, "21.4.2: TI1 is the XOR of three inputs"),
    ("TIM2_ARR", TIM2 + 0x2C, 0xFFFFFFFF, 0xFFFFFFFF, "21.4.12: all of its 32 bits"),
    ("TIM2_CCMR1", TIM2 + 0x18, 0xFF, 0xF1, "21.4.7: IC1 at TI1, eight samples alike of a 32nd of the clock: 3.6 us"),
    ("TIM2_CCER", TIM2 + 0x20, 0xF, 0xB, "21.4.9: both edges"),
    ("TIM2_DIER", TIM2 + 0x0C, 0xFFFF, 0x2, "21.4.4: CC1IE"),
    ("TIM2_CR1", TIM2 + 0x00, 0xFF, 0x1, "21.4.1"),
    ("ADC1_CR", ADC1 + 0x08, 0xFFFFFFFF, 0x10000009, "15.5.3: ADVREGEN = 01, ADEN, JADSTART"),
    ("ADC1_IER", ADC1 + 0x04, 0x7FF, 0x40, "15.5.2: JEOSIE"),
    ("ADC1_SMPR1", ADC1 + 0x14, 0x3FFFFFFF, fields(3, {1: 3, 2: 3, 6: 3, 7: 3}), "15.5.5: channels 1, 2, 6, 7 for 7.5 clocks"),
    ("ADC1_JSQR", ADC1 + 0x4C, 0x7FFFFFFF, 3 | 8 << 2 | 1 << 6 | 1 << 8 | 7 << 14 | 6 << 20 | 2 << 26,
     "15.5.12: four, at the rising edge of TIM1_TRGO2, channels 1 7 6 2"),
    ("ADC12_CCR", ADC1 + 0x308, 0x30000, 0x10000, "15.6.2: CKMODE = 01, HCLK itself"),
    ("IWDG_RLR", IWDG + 0x08, 0xFFF, 400, "25.4.3"),
    ("NVIC_ISER0", 0xE000E100, 0xFFFFFFFF, 1 << 18 | 1 << 24 | 1 << 27 | 1 << 28, "14.1: ADC1_2, TIM1_BRK, TIM1_CC and TIM2"),
    ("NVIC_ISER1", 0xE000E104, 0xFFFFFFFF, 1 << 6, "14.1: USART2, 38"),
    ("NVIC_IPR18", 0xE000E412, 0xFF, 0x40, "ADC1_2: the same priority as"),
    ("NVIC_IPR28", 0xE000E41C, 0xFF, 0x40, "TIM2"),
    ("NVIC_IPR24", 0xE000E418, 0xFF, 0x00, "TIM1_BRK before both"),
    ("NVIC_IPR27", 0xE000E41B, 0xFF, 0x00, "TIM1_CC before both"),
    ("NVIC_IPR38", 0xE000E426, 0xFF, 0x80, "USART2 behind both"),
    ("DBGMCU_APB1_FZ", 0xE0042008, 0x1001, 0x1001, "the watchdog and TIM2, the log's clock, stop with the core"),
    ("DBGMCU_APB2_FZ", 0xE004200C, 0x1, 0x1, "so does TIM1"),
]
