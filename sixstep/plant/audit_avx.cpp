// SPDX-License-Identifier: Apache-2.0
// Compiles the audit's integrals for AVX, four numbers per instruction. With GCC the whole file is compiled
// for AVX: in a function with a target attribute, GCC splits wide vectors before it inlines. Code that other
// files also use is inlined in this file, or has another name in this file (series/nodes.hpp).
// tests/plant/avx_alone.cmake checks that this file exports no function that the linker could use for other
// files. Other compilers use two numbers per instruction in this file too.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC target("avx")
#define SIXSTEP_FOUR_LANES
#endif
#include "sixstep/plant/audit.hpp"

#ifdef __x86_64__

namespace sixstep::plant::detail {

void audit_with_avx(Audit<double>& audit, const Plant<double>& plant, double s) {
  audit.take(plant, segment_energy_here(plant, s));
}

}  // namespace sixstep::plant::detail

#endif
