// SPDX-License-Identifier: Apache-2.0
// What each switch and diode of the bridge lost over a whole run, and how warm that makes its junction.
#pragma once
#include <string_view>
#include <vector>

#include "sixstep/plant/device_losses.hpp"
#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Mean powers, W; the junction's temperature by bridge.junction_K_W, 0 where that is not known.
struct DeviceLoss {
  std::string_view device;  // "T1" to "T6"
  double conduction_W = 0.0, turn_on_W = 0.0, turn_off_W = 0.0, diode_W = 0.0, recovery_W = 0.0;
  double junction_degC = 0.0;
};

class DeviceWatch {
 public:
  explicit DeviceWatch(const Bridge& bridge);
  void segment(const SegmentView& g, double s);
  /// T1 to T6 in order; empty where no time went by.
  std::vector<DeviceLoss> losses() const;

 private:
  plant::DeviceLosses losses_;
  bool igbt_;
  double sink_degC_, junction_K_W_, seconds_ = 0.0;
};

/// Whether a bridge says enough for a table of its losses: energies of switching, or what a junction stands on.
bool tells_losses(const Bridge& bridge);

}  // namespace sixstep::study
