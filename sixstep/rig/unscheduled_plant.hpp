// SPDX-License-Identifier: Apache-2.0
// The plant without a board, as a System for sim::run without scheduled actions. A derived class adds
// apply(id), the reaction to a located event.
#pragma once
#include "sixstep/plant/plant.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

template <class RealType, class Plant = plant::Plant<RealType>>
class UnscheduledPlant {
 public:
  using Real = RealType;

  explicit UnscheduledPlant(const Plant& plant) : plant_(plant) {}

  sim::Instant now() const { return now_; }
  sim::Instant next_known() const { return sim::Instant::never(); }
  bool act() { return true; }
  double expand(double h) { return plant_.expand(h); }
  template <class Visit>
  void guards(Visit&& visit) const {
    plant_.guards(visit);
  }
  void end_at(Real s) { plant_.end_at(s); }
  void advance(Real s, const sim::Instant& to) {
    plant_.advance(s);
    now_ = to;
  }

  const Plant& plant() const { return plant_; }

 protected:
  Plant plant_;
  sim::Instant now_{};
};

}  // namespace sixstep::rig
