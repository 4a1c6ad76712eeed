// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/expand.hpp"

namespace sixstep::plant::detail {

template void expand_shape<false, Build::any>(const Constants<double>&, const Mode&, Expansion<double>&);
template void expand_shape<true, Build::any>(const Constants<double>&, const Mode&, Expansion<double>&);

#ifdef __x86_64__

template void expand_shape<false, Build::avx>(const Constants<double>&, const Mode&, Expansion<double>&);
template void expand_shape<true, Build::avx>(const Constants<double>&, const Mode&, Expansion<double>&);

const bool has_avx = [] {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx") != 0;
}();

namespace {

template <bool sine>
void expand_here(const Constants<double>& c, const Mode& mode, Expansion<double>& y) {
  if (has_avx)
    expand_shape<sine, Build::avx>(c, mode, y);
  else
    expand_shape<sine, Build::any>(c, mode, y);
}

}  // namespace

#else

namespace {

template <bool sine>
void expand_here(const Constants<double>& c, const Mode& mode, Expansion<double>& y) {
  expand_shape<sine, Build::any>(c, mode, y);
}

}  // namespace

#endif

void expand_trapezoid(const Constants<double>& c, const Mode& mode, Expansion<double>& y) {
  expand_here<false>(c, mode, y);
}
void expand_sine(const Constants<double>& c, const Mode& mode, Expansion<double>& y) {
  expand_here<true>(c, mode, y);
}

}  // namespace sixstep::plant::detail
