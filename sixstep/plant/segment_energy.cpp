// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/segment_energy.hpp"

namespace sixstep::plant {

#ifdef __x86_64__
namespace {

[[gnu::target("avx")]] SegmentEnergy<double> with_avx(const Plant<double>& plant, double to) {
  return detail::segment_energy_here(plant, to);
}

}  // namespace
#endif

SegmentEnergy<double> segment_energy(const Plant<double>& plant, double to) {
#ifdef __x86_64__
  if (detail::has_avx) return with_avx(plant, to);
#endif
  return detail::segment_energy_here(plant, to);
}

}  // namespace sixstep::plant
