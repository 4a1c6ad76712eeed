// SPDX-License-Identifier: Apache-2.0
// The reference motor (model.md 6) in the general kernel, with the board that both kernels share.
#pragma once
#include "sixstep/plant/general/plant.hpp"
#include "tests/support/board.hpp"

namespace sixstep::testing {

namespace general = plant::general;

/// A star winding with a trapezoid, which the lean kernel could also simulate. Each test changes only the
/// members that it tests.
struct GeneralSetup {
  general::Machine machine{.R_ohm = {0.515, 0.515, 0.515},
                           .K_e_V_s = {0.01675, 0.01675, 0.01675},
                           .L_H = 0.286e-3,
                           .pole_pairs = 8};
  general::Shaft shaft{.J_kg_m2 = 1.35e-5, .B_Nm_s = 7.3e-6};
  general::Devices devices{};
  general::Supply supply{.V_0_V = 24};
  general::Start start{.bus_V = 24};
  rig::ProbeGiven probes{};

  general::Plant<double> plant() const { return {machine, shaft, devices, supply, start}; }
};

template <class Firmware>
using GeneralRigOf = rig::Rig<double, Firmware, general::Plant<double>>;
using GeneralRig = GeneralRigOf<rig::LeanDrive<double>>;

inline GeneralRig general_rig(const GeneralSetup& setup, const Board& board) {
  return GeneralRig(setup.plant(), board.drive, board.board, board.timeline, {}, {}, setup.probes);
}

/// The general plant without a board and with constant gates. It is a System for sim::run().
class HeldGeneral : public rig::UnscheduledPlant<double, general::Plant<double>> {
 public:
  explicit HeldGeneral(const GeneralSetup& setup, const plant::Gates& gates = {})
      : UnscheduledPlant(setup.plant()) {
    plant_.set_gates(gates);
  }
  void apply(int id) { plant_.apply(id); }
  using UnscheduledPlant::plant;
  general::Plant<double>& plant() { return plant_; }
};

}  // namespace sixstep::testing
