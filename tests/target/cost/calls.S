/* SPDX-License-Identifier: Apache-2.0
   Calls of the entries. The count begins at the first instruction of an entry, and ends at the label after the call. */
#if defined __arm__
  .syntax unified
  .thumb
  .text
  .global call_tick, call_hall, after_tick, after_hall
  .thumb_func
call_tick:
  push {r4, lr}
  bl entry_tick
after_tick:
  pop {r4, pc}
  .thumb_func
call_hall:
  push {r4, lr}
  bl entry_hall
after_hall:
  pop {r4, pc}
#elif defined __riscv
  .text
  .global call_tick, call_hall, after_tick, after_hall
call_tick:
  addi sp, sp, -16
  sw ra, 0(sp)
  call entry_tick
after_tick:
  lw ra, 0(sp)
  addi sp, sp, 16
  ret
call_hall:
  addi sp, sp, -16
  sw ra, 0(sp)
  call entry_hall
after_hall:
  lw ra, 0(sp)
  addi sp, sp, 16
  ret
#endif
