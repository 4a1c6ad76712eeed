// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/audit.hpp"

namespace sixstep::plant {

namespace {

void for_any(Audit<double>& audit, const Plant<double>& plant, double s) {
  audit.take(plant, detail::segment_energy_here(plant, s));
}
#ifdef __x86_64__
[[gnu::target("avx")]] void with_avx(Audit<double>& audit, const Plant<double>& plant, double s) {
  audit.take(plant, detail::segment_energy_here(plant, s));
}
#endif

}  // namespace

template <>
void Audit<double>::segment(const Plant<double>& plant, double s) {
#ifdef __x86_64__
  if (detail::has_avx) return with_avx(*this, plant, s);
#endif
  for_any(*this, plant, s);
}

}  // namespace sixstep::plant
