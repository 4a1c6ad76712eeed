// SPDX-License-Identifier: Apache-2.0
// Computes the energy lost to the iron's drag, separate from the bearings' friction, in J, from the segments'
// series (model.md 7). It is the integral of B_iron w^2 over time plus the integral of the dry drag torque
// over the motor shaft's angle; B_iron is the iron's viscous drag in N m s, w the speed. The gauge exists
// only if the sheet gives the iron's drag and the bearings' friction separately.
#pragma once
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/plant/state.hpp"
#include "sixstep/series/polynomial.hpp"
#include "sixstep/series/quadrature.hpp"

namespace sixstep::study {

class IronGauge {
 public:
  explicit IronGauge(const design::IronDrag& iron) : iron_(iron) {}

  /// Adds the plant's segment from its beginning to its fraction s.
  template <class Plant>
  void segment(const Plant& plant, double s) {
    if (!plant::turns(plant.mode().motion)) return;
    const auto& y = plant.expansion();
    series::with_points_for(y.degree, [&]<int points>() {
      const auto w = series::values_at<points>(y.w, y.degree, series::nodes_up_to<points>(s));
      const double dt = y.h * s, dry = plant::against(plant.mode().motion, iron_.coulomb_Nm);
      energy_.add(
          dt * (iron_.B_Nm_s * series::weighted_sum<points>(w, w) + dry * series::weighted_sum<points>(w)));
    });
  }
  double energy_J() const { return energy_.value; }

 private:
  design::IronDrag iron_;
  series::CompensatedSum<double> energy_;
};

}  // namespace sixstep::study
