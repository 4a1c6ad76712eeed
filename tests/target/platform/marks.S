/* SPDX-License-Identifier: Apache-2.0
   Empty functions that mark the begin and the end of a count by their addresses (walk/counted.hpp). */
#if defined __arm__
  .syntax unified
  .thumb
#endif
  .text
.macro mark name
  .global \name
#if defined __arm__
  .thumb_func
#endif
\name:
#if defined __arm__
  bx lr
#else
  ret
#endif
.endm
mark count_begins_0
mark count_begins_1
mark count_begins_2
mark count_ends
mark count_next
