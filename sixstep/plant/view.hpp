// SPDX-License-Identifier: Apache-2.0
// Read access to the plant of the lean or the general kernel, for observers. Both kernels have most values.
// For the values of only one kernel the view has a pointer to the plant. View is not a template, so that
// figures and recorders are compiled once.
#pragma once
#include "sixstep/plant/general/segment_energy.hpp"
#include "sixstep/plant/segment_energy.hpp"

namespace sixstep::plant {

class View {
 public:
  View(const Plant<double>& plant)  // NOLINT(google-explicit-constructor): a plant is its own view
      : common_{&plant.expansion(),          &plant.state(),      &plant.gates(),
                &plant.mode().legs,          plant.mode().motion, plant.sector(),
                plant.constants().pole_pairs},
        lean(&plant) {}
  View(const general::Plant<double>& plant)  // NOLINT(google-explicit-constructor)
      : common_{&plant.expansion(),          &plant.state(),      &plant.gates(),
                &plant.mode().legs,          plant.mode().motion, plant.sector(),
                plant.constants().pole_pairs},
        general(&plant) {}

  const Expansion<double>& expansion() const { return *common_.y; }
  const State<double>& state() const { return *common_.state; }
  const Gates& gates() const { return *common_.gates; }
  const Legs& legs() const { return *common_.legs; }
  Motion motion() const { return common_.motion; }
  int sector() const { return common_.sector; }
  double pole_pairs() const { return common_.pole_pairs; }
  /// Pole terms of leg k, which must be connected.
  const PoleTerms<double>& terms(int k) const {
    const auto leg = static_cast<std::size_t>(k);
    return lean ? lean->constants().poles[static_cast<std::size_t>(legs()[leg])]
                : general->constants().terms(leg, legs()[leg]);
  }
  SegmentEnergy<double> energy(double to) const {
    return lean ? segment_energy(*lean, to) : general::segment_energy(*general, to);
  }

 private:
  struct Common {
    const Expansion<double>* y;
    const State<double>* state;
    const Gates* gates;
    const Legs* legs;
    Motion motion;
    int sector;
    double pole_pairs;
  };
  Common common_;

 public:
  const Plant<double>* lean = nullptr;  ///< exactly one of `lean` and `general` is not null
  const general::Plant<double>* general = nullptr;
};

/// Torque of the scenario's load at the load's side of the gear, N m, at the fraction s of the segment.
inline double load_torque(const Plant<double>& plant, double) { return plant.constants().load; }
inline double load_torque(const general::Plant<double>& plant, double s) {
  return series::evaluate(plant.series().load, plant.expansion().degree, s);
}

}  // namespace sixstep::plant
