// SPDX-License-Identifier: Apache-2.0
// Values of motor and sensor that the drive believes, where they differ from the true values. Design, firmware
// and exported header use them; the plant does not (believed_motor.hpp).
#pragma once
#include <optional>

#include "sixstep/base/describe.hpp"
#include "sixstep/rig/wiring.hpp"

namespace sixstep::study {

struct Believed {
  std::optional<int> pole_pairs;
  std::optional<base::Quantity> resistance_ohm;
  std::optional<base::Quantity> inductance_mH;
  std::optional<base::Quantity> d_axis_inductance_mH, q_axis_inductance_mH;
  // The torque constant in its forms, of which at most one is given.
  std::optional<base::Quantity> torque_constant_mNm_A, back_emf_mV_s, torque_constant_Nm_A, flux_linkage_mWb,
      speed_constant_rpm_V;
  std::optional<base::Quantity> inertia_gcm2;
  rig::WireOrder hall_lines = rig::WireOrder::abc;  // probes that the drive assumes at pins H1, H2, H3
  double sensor_offset_deg = 0.0;                   // offset that the drive subtracts from the sensor's angle
};

}  // namespace sixstep::study
