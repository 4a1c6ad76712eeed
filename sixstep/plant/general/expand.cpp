// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/general/expand.hpp"

namespace sixstep::plant::general {
namespace {

#ifdef __x86_64__
[[gnu::target("avx")]] void grow_with_avx(const Constants<double>& c, const State<double>& s,
                                          const More<double>& m, Mode& mode, double wanted,
                                          Expansion<double>& y, Series<double>& z) {
  detail::grow(c, s, m, mode, wanted, y, z);
}
#endif

}  // namespace

void expand(const Constants<double>& c, const State<double>& s, const More<double>& m, Mode& mode,
            double wanted, Expansion<double>& y, Series<double>& z) {
#ifdef __x86_64__
  if (plant::detail::has_avx) return grow_with_avx(c, s, m, mode, wanted, y, z);
#endif
  detail::grow(c, s, m, mode, wanted, y, z);
}

}  // namespace sixstep::plant::general
