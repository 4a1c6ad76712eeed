/* SPDX-License-Identifier: Apache-2.0
   Vectors and reset of an STM32F303 (RM0316, 14.1): the core's sixteen, then 82 of its parts. What nobody serves is a fault. */
  .syntax unified
  .thumb

  .section .vectors, "a"
  .word stack_top
  .word reset
  .word NMI_Handler
  .rept 13
  .word fault
  .endr
  .rept 18
  .word fault
  .endr
  .word ADC1_2_IRQHandler   /* 18 */
  .rept 5
  .word fault
  .endr
  .word TIM1_BRK_IRQHandler /* 24 */
  .rept 2
  .word fault
  .endr
  .word TIM1_CC_IRQHandler  /* 27 */
  .word TIM2_IRQHandler     /* 28 */
  .rept 9
  .word fault
  .endr
  .word USART2_IRQHandler   /* 38 */
  .rept 43
  .word fault
  .endr

  .text
  .global reset
  .thumb_func
reset:
  ldr r0, =0xE000ED88       /* CPACR: the floating-point unit, full access */
  ldr r1, =0xF00000
  str r1, [r0]
  dsb
  isb
  b begin
  .ltorg
