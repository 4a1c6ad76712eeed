// SPDX-License-Identifier: Apache-2.0
// Computes the torque per ampere through a pair of phases over the electrical angle, from the shapes of the
// general kernel (plant/general/shape.hpp).
#pragma once
#include <cstdint>

#include "sixstep/plant/general/machine.hpp"
#include "sixstep/plant/general/shape.hpp"

namespace sixstep::analysis {

/// +1 A into `source`, -1 A into `sink`, nothing into the third:
///   T/i = E_source - E_sink + 1.5 p (lambda_d i_q - lambda_q i_d)/i
/// with the back-EMF per speed E_k of phase k (for a delta, of the equivalent star at its terminals, model.md
/// (9)), the pole pairs p, and flux linkages lambda and currents i in the rotor frame. The second term
/// describes a salient rotor or saturation (model.md 7); only this term depends on the current.
/// Cogging and the torque of a delta's loop current are not included, because they do not depend on the pair.
class PairTorque {
 public:
  PairTorque(const plant::general::Machine& machine, double current_A);

  /// Torque per current at x rad after the begin of a sector, x in [0, pi/3]; N m/A.
  double at(std::uint8_t sector, double x_rad, std::size_t source, std::size_t sink) const;

  /// Back-EMF of a phase per mechanical rad/s at the same angle, V s; for a delta, of the equivalent star.
  double emf_V_s(std::uint8_t sector, double x_rad, std::size_t phase) const;

  /// Means over a part of a sector.
  struct Means {
    double torque = 0.0;  ///< N m/A
    double square = 0.0;  ///< mean of torque^2
  };
  Means means(std::uint8_t sector, double from_rad, double to_rad, std::size_t source,
              std::size_t sink) const;

 private:
  double of_axes(double electrical_rad, std::size_t source, std::size_t sink) const;

  plant::general::Machine machine_;
  plant::general::ShapeTable<double> table_;
  double current_A_;
};

}  // namespace sixstep::analysis
