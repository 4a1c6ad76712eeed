// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/audit.hpp"

namespace sixstep::plant {

template <>
void Audit<double>::segment(const Plant<double>& plant, double s) {
#ifdef __x86_64__
  if (detail::has_avx) return detail::audit_with_avx(*this, plant, s);
#endif
  take(plant, segment_energy(plant, s));
}

}  // namespace sixstep::plant
