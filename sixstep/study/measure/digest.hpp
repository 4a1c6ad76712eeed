// SPDX-License-Identifier: Apache-2.0
// Reduces a whole trajectory to 64 bits. Two runs with the same digest had the same bits at every event.
#pragma once
#include <cstdint>

#include "sixstep/base/hash.hpp"
#include "sixstep/plant/state.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::study {

/// Observer of a run. It reads time, currents, speed, angle and bus at the beginning of each segment. These
/// are the values at the end of the previous segment, after the event. A copy continues from the original's
/// state, like a copy of the rig.
class Digest {
 public:
  template <class Rig, class Real>
  void segment(const Rig& rig, Real) {
    take(rig);
  }

  /// Digest of all segments so far and of the rig's present state, including the rounding errors that its
  /// compensated sums keep.
  template <class Rig>
  std::uint64_t after(const Rig& rig) const {
    Digest whole = *this;
    whole.take(rig);
    const auto& s = rig.plant().state();
    for (const auto& low : s.i_low) whole.hash_.number(static_cast<double>(low));
    for (const auto& low : {s.w_low, s.x_low, s.bus_low}) whole.hash_.number(static_cast<double>(low));
    if constexpr (requires { rig.plant().more(); }) {
      const auto& m = rig.plant().more();
      for_each_kept(m, [&](const auto& kept) { whole.hash_.number(kept.low); });
    }
    return whole.hash_.value();
  }

 private:
  template <class Rig>
  void take(const Rig& rig) {
    const sim::Instant now = rig.now();
    const auto& s = rig.plant().state();
    hash_.word(static_cast<std::uint64_t>(now.ticks));
    hash_.number(now.offset);
    for (const auto& i : s.i) hash_.number(static_cast<double>(i));
    hash_.number(static_cast<double>(s.w));
    hash_.word(static_cast<std::uint64_t>(s.sector));
    hash_.number(static_cast<double>(s.x));
    hash_.number(static_cast<double>(s.bus));
    if constexpr (requires { rig.plant().more(); }) {
      const auto& m = rig.plant().more();
      for_each_kept(m, [&](const auto& kept) { hash_.number(kept.value); });
    }
  }

  base::Hash hash_;
};

}  // namespace sixstep::study
