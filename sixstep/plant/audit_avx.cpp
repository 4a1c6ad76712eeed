// SPDX-License-Identifier: Apache-2.0
// What the audit integrates, four numbers to an instruction: by GCC the whole file is compiled for AVX, for of a function that asks for
// it by itself the wide vectors are taken apart before anything is inlined. What it shares with other files is inlined here or has
// another name there (series/nodes.hpp); a test looks that no function leaves it that others could be given in place of their own
// (tests/plant/avx_alone.cmake). Other compilers take two numbers to an instruction here too.
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
