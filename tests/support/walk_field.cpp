// SPDX-License-Identifier: Apache-2.0
#include "tests/support/walk_rig.hpp"

namespace sixstep::testing {

namespace {

/// It computes in floating point alone.
template <bool on_general>
Walk walk_on(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  return s.control.arithmetic == study::Arithmetic::float32
             ? detail::walk_in<rig::FieldDrive<float>, on_general>(s, c, plan)
             : detail::walk_in<rig::FieldDrive<double>, on_general>(s, c, plan);
}

}  // namespace

Walk walk_field(const study::Scenario& s, const study::Compiled& c, const WalkPlan& plan) {
  return c.general ? walk_on<true>(s, c, plan) : walk_on<false>(s, c, plan);
}

}  // namespace sixstep::testing
