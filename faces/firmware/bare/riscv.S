/* SPDX-License-Identifier: Apache-2.0
   Reset of a RISC-V hart. The three instructions of the semihosting call stand in one 16-byte line, uncompressed, as the
   convention asks; gp is set for the linker's relaxation. */
  .section .init, "ax"
  .global reset
reset:
  .option push
  .option norelax
  la gp, __global_pointer$
  .option pop
  la sp, stack_top
  la t0, fault
  .option push
  .option arch, +zicsr
  csrw mtvec, t0
  .option pop
  j begin

  .text
  .global semihosting
  .balign 16
semihosting:
  .option push
  .option norvc
  slli x0, x0, 0x1f
  ebreak
  srai x0, x0, 7
  .option pop
  ret

  .balign 4
fault:
  j hard_fault
