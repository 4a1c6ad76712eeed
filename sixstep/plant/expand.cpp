// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/expand.hpp"

namespace sixstep::plant::detail {

template void expand_shape<false, double>(const Constants<double>&, const Mode&, Expansion<double>&);
template void expand_shape<true, double>(const Constants<double>&, const Mode&, Expansion<double>&);

}  // namespace sixstep::plant::detail
