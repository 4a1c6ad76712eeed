// SPDX-License-Identifier: Apache-2.0
// Measures the losses of each switch and diode of the bridge over a whole run, and the junction temperature
// that follows.
#pragma once
#include <string_view>
#include <vector>

#include "sixstep/plant/device_losses.hpp"
#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Mean powers over the run, W. junction_degC: the junction's temperature at these mean powers, computed with
/// bridge.junction_K_W. The peak temperature in the run is higher. 0 if junction_K_W is not given.
struct DeviceLoss {
  std::string_view device;  // "T1" to "T6"
  double conduction_W = 0.0, turn_on_W = 0.0, turn_off_W = 0.0, diode_W = 0.0, recovery_W = 0.0;
  double junction_degC = 0.0;
};

class DeviceWatch {
 public:
  explicit DeviceWatch(const Bridge& bridge);
  void segment(const SegmentView& g, double s);
  /// The devices T1 to T6 in order; empty if no time has passed.
  std::vector<DeviceLoss> losses() const;

 private:
  plant::DeviceLosses losses_;
  bool igbt_;
  double sink_degC_, junction_K_W_, seconds_ = 0.0;
};

/// True if a bridge has values for a table of its losses: switching energies, or a junction's thermal
/// resistance.
bool tells_losses(const Bridge& bridge);

}  // namespace sixstep::study
