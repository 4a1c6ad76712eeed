/* SPDX-License-Identifier: Apache-2.0
   Vectors and reset of a Cortex-M: the stack's top and the handlers that a program without interrupts needs. */
  .syntax unified
  .thumb

  .section .vectors, "a"
  .word stack_top
  .word reset
  .rept 14
  .word hard_fault
  .endr

  .text
  .global reset, semihosting
  .thumb_func
reset:
#ifdef __ARM_FP
  ldr r0, =0xE000ED88   /* CPACR: both coprocessors of the floating-point unit, full access */
  ldr r1, =0xF00000
  str r1, [r0]
  dsb
  isb
#endif
  bl begin
  .ltorg

  .thumb_func
semihosting:
  bkpt 0xAB
  bx lr
