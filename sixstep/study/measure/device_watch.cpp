// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/device_watch.hpp"

#include "sixstep/series/quadrature.hpp"
#include "sixstep/study/measure/loss_gauge.hpp"
#include "sixstep/study/scenario/switching_law.hpp"

namespace sixstep::study {

DeviceWatch::DeviceWatch(const Bridge& b)
    : losses_(switching_law(b)),
      igbt_(b.device == Device::igbt),
      sink_degC_(b.sink_degC),
      junction_K_W_(b.junction_K_W) {}

void DeviceWatch::segment(const SegmentView& g, double s) {
  const auto& y = g.plant.expansion();
  const plant::Legs& legs = g.plant.legs();
  begin_segment(losses_, g, {});
  const double dt = y.h * s;
  seconds_ += dt;
  series::with_points_for(y.degree, [&]<int points>() {
    const auto at = series::nodes_up_to<points>(s);
    for (std::size_t k = 0; k < 3; ++k) {
      if (plant::is_floating(legs[k])) continue;
      const auto& terms = g.plant.terms(static_cast<int>(k));
      const auto i = series::values_at<points>(y.i[k], y.degree, at);
      losses_.conducted(k, legs[k],
                        dt * (terms.r_ohm * series::weighted_sum<points>(i, i) -
                              terms.offset_V * series::weighted_sum<points>(i)));
    }
  });
}

std::vector<DeviceLoss> DeviceWatch::losses() const {
  std::vector<DeviceLoss> out;
  if (!(seconds_ > 0.0)) return out;
  static constexpr std::string_view names[] = {"T1", "T2", "T3", "T4", "T5", "T6"};
  for (const plant::LegDevices& leg : losses_.energies())
    for (const plant::DeviceEnergy* e : {&leg.upper, &leg.lower}) {
      const double crystal_W = e->in_crystal(igbt_) / seconds_;
      out.push_back({.device = names[out.size()],
                     .conduction_W = e->conduction / seconds_,
                     .turn_on_W = e->turn_on / seconds_,
                     .turn_off_W = e->turn_off / seconds_,
                     .diode_W = e->diode / seconds_,
                     .recovery_W = e->recovery / seconds_,
                     .junction_degC = junction_K_W_ > 0 ? sink_degC_ + junction_K_W_ * crystal_W : 0.0});
    }
  return out;
}

bool tells_losses(const Bridge& b) { return switching_law(b).any() || b.junction_K_W > 0; }

}  // namespace sixstep::study
