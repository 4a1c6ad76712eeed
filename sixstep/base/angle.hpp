// SPDX-License-Identifier: Apache-2.0
// Mechanical and electrical angles are different types. Only PolePairs converts between them.
#pragma once

namespace sixstep::base {

/// Angle of the shaft, rad.
struct MechanicalAngle {
  double rad = 0.0;
  bool operator==(const MechanicalAngle&) const = default;
};

/// Electrical angle of the rotor's magnet relative to the stator, rad: the mechanical angle times the pole
/// pairs (model.md 1).
struct ElectricalAngle {
  double rad = 0.0;
  bool operator==(const ElectricalAngle&) const = default;
};

/// Number of pole pairs. For a linear motor: pi/(pole pitch in m), which need not be an integer.
struct PolePairs {
  double count = 1;
  constexpr ElectricalAngle electrical(MechanicalAngle m) const { return {m.rad * count}; }
  constexpr MechanicalAngle mechanical(ElectricalAngle e) const { return {e.rad / count}; }
};

/// An electrical sector, 60 degrees, in rad: pi/3 rounded to the nearest double.
inline constexpr double sector_rad = 1.0471975511965977461542144610932;
inline constexpr double pi = 3.1415926535897932384626433832795;
inline constexpr double rad_per_deg = pi / 180, rpm_per_rad_s = 30 / pi;
inline constexpr double root_3 = 1.7320508075688772935274463415059;
inline constexpr double turn_rad = 2 * pi;

}  // namespace sixstep::base
