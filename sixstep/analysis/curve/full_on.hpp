// SPDX-License-Identifier: Apache-2.0
// Simulates motor and bridge at duty 1: the gates follow the sector, without chopping. The class is a System
// for sim::run.
#pragma once
#include "sixstep/analysis/curve/bench.hpp"
#include "sixstep/analysis/curve/sums_recorder.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/rig/unscheduled_plant.hpp"
#include "sixstep/sim/run.hpp"

namespace sixstep::analysis {

/// A shaft with constant speed: 1/J = 0, and dw/dt is exactly zero for any torque. The caller subtracts
/// friction from the torque afterwards, because friction cannot act on the currents at a given speed.
inline plant::Shaft imposed_speed() { return {.J_kg_m2 = std::numeric_limits<double>::infinity()}; }

/// Starts without current. The default angle is the middle of a sector, so that the start is not on an edge.
inline plant::Plant<double> plant_of(const Bench& b, const plant::Shaft& shaft, double speed_rad_s,
                                     double sectors = 0.5) {
  const double angle = sectors * base::sector_rad / b.motor.machine.pole_pairs;
  return {b.motor.machine, shaft, b.devices, {.V_0_V = b.voltage_V}, {speed_rad_s, angle, b.voltage_V}};
}

class FullOn : public rig::UnscheduledPlant<double> {
 public:
  FullOn(const Bench& bench, const plant::Shaft& shaft, double speed_rad_s)
      : UnscheduledPlant(plant_of(bench, shaft, speed_rad_s)),
        keep_going_(bench.keep_going),
        reversed_(bench.duty < 0) {
    commutate();
  }

  void apply(int id) {
    if (!plant_.apply(id)) return;
    ++edges_;
    commutate();
  }

  /// Has the signature of OpenLoop::run_for(), so that a template can use both classes.
  template <class Observer>
  sim::Stop run_for(double seconds, Observer& observer) {
    Asking<Observer> asking{keep_going_, observer};
    return sim::run(*this, now_.plus_seconds(seconds), asking).stop;
  }
  sim::Stop run_for(double seconds) {
    sim::NoObserver none;
    return run_for(seconds, none);
  }

  /// Runs until edges() equals `target`, with or without a recorder. Stop::observer: the edge is reached.
  /// Stop::end: keep_going ended the run. Any other value is a defect.
  sim::Stop run_to_edge(std::int64_t target, SumsRecorder* recorder = nullptr) {
    UntilEdge until{target, recorder, keep_going_, asked_};
    const sim::Stop stop = sim::run(*this, sim::Instant::never(), until).stop;
    return stop == sim::Stop::observer && edges_ < target ? sim::Stop::end : stop;
  }

  std::int64_t edges() const { return edges_; }  ///< sector edges passed

 private:
  struct UntilEdge {
    std::int64_t target;
    SumsRecorder* recorder;
    const std::function<bool()>& keep_going;
    std::uint32_t& asked;  // counter kept between calls, because a sector has only a few segments
    void segment(const FullOn& system, double s) {
      if (recorder) recorder->segment(system, s);
    }
    bool done(const FullOn& system) {
      return system.edges() >= target || (keep_going && ++asked % 256 == 0 && !keep_going());
    }
  };
  void commutate() {
    const control::Pair positive = control::positive_pair(static_cast<std::uint8_t>(plant_.sector()));
    const control::Pair pair = reversed_ ? control::swapped(positive) : positive;
    plant::Gates gates;
    gates.high[static_cast<std::size_t>(pair.source)] = true;
    gates.low[static_cast<std::size_t>(pair.sink)] = true;
    plant_.set_gates(gates);  // two different legs: no leg is shorted
  }

  std::function<bool()> keep_going_;
  std::int64_t edges_ = 0;
  std::uint32_t asked_ = 0;
  bool reversed_;
};

}  // namespace sixstep::analysis
