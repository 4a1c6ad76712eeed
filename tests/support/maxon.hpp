// SPDX-License-Identifier: Apache-2.0
// The reference motor of model.md 6, either as a plant without a board and with constant gates, or on the
// virtual board.
#pragma once
#include <functional>
#include <vector>

#include "sixstep/rig/unscheduled_plant.hpp"
#include "sixstep/sim/run.hpp"

namespace sixstep::testing {

inline constexpr double eps = 0x1p-52;

/// maxon EC 45 flat 251601 at 24 V, without load, with ideal devices, at rest at theta = 0.
struct Drivetrain {
  plant::Machine machine{.R_ohm = 0.515, .L_H = 0.572e-3 / 2, .K_e_V_s = 0.01675, .pole_pairs = 8};
  plant::Shaft shaft{.J_kg_m2 = 1.35e-5, .B_Nm_s = 7.3e-6};
  plant::Devices devices{};
  plant::Supply supply{.V_0_V = 24.0};
  plant::Start start{.bus_V = 24.0};

  double R_tt() const { return 2 * machine.R_ohm; }
  double L_tt() const { return 2 * machine.L_H; }
  double tau() const { return machine.L_H / machine.R_ohm; }

  template <class Real = double>
  plant::Plant<Real> plant() const {
    return plant::Plant<Real>(machine, shaft, devices, supply, start);
  }
};

/// Mechanical angle, in rad, for an electrical angle in degrees. The motor has eight pole pairs.
inline double at_electrical_deg(double deg) { return deg * base::pi / 180.0 / 8; }

inline plant::Gates gates(std::array<bool, 3> high, std::array<bool, 3> low) {
  plant::Gates g;
  for (std::size_t k = 0; k < 3; ++k) g.high[k] = high[k], g.low[k] = low[k];
  return g;
}
inline plant::Gates all_off() { return {}; }
inline plant::Gates a_to_b() { return gates({true, false, false}, {false, true, false}); }
inline plant::Gates all_low() { return gates({}, {true, true, true}); }

/// The plant with constant gates, as a System for sim::run(). It records every located event.
template <class RealType = double>
class Held : public rig::UnscheduledPlant<RealType> {
  using rig::UnscheduledPlant<RealType>::plant_;
  using rig::UnscheduledPlant<RealType>::now_;

 public:
  using Real = RealType;
  using rig::UnscheduledPlant<RealType>::plant;
  struct Event {
    int id;
    sim::Instant at;
  };

  Held(const Drivetrain& setup, const plant::Gates& g) : rig::UnscheduledPlant<Real>(setup.plant<Real>()) {
    plant_.set_gates(g);
  }

  void apply(int id) {
    events.push_back({id, now_});
    plant_.apply(id);
  }

  plant::Plant<Real>& plant() { return plant_; }
  const plant::State<Real>& state() const { return plant_.state(); }
  Real angle() const {
    return (static_cast<Real>(state().sector) * Real(base::sector_rad) + state().x) /
           plant_.constants().pole_pairs;
  }

  template <class Observer>
  sim::Stop run_to(double t_s, Observer& observer) {
    return sim::run(*this, sim::to_instant(t_s), observer).stop;
  }
  sim::Stop run_to(double t_s) {
    sim::NoObserver none;
    return run_to(t_s, none);
  }

  std::vector<Event> events;
};

}  // namespace sixstep::testing
