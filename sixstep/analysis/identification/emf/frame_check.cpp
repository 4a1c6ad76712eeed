// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/frame_check.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"

namespace sixstep::analysis {
namespace {

using base::Quantity;

constexpr double rad_s_per_krpm = 1000.0 / base::rpm_per_rad_s;

/// Constants in V s, or N m/A, per mechanical rad, each with the name of its frame.
struct Frame {
  std::string_view name;
  Interval V_s;
};

/// Torque per ampere: through the driven pair, and per peak or rms ampere of a sine in each phase.
std::vector<Frame> torque_frames(const EmfResult& m, double p) {
  return {{"terminal", scaled(m.constants.phase_peak, p * m.shape_sector_mean)},
          {"peak", scaled(m.constants.phase_fundamental, 1.5 * p)},
          {"rms", scaled(m.constants.phase_fundamental, 1.5 * std::sqrt(2.0) * p)}};
}
std::vector<Frame> voltage_frames(const EmfResult& m, double p) {
  return {{"line-peak", scaled(m.constants.line_peak, p)},
          {"line-rms", scaled(m.constants.line_rms, p)},
          {"phase-peak", scaled(m.constants.phase_peak, p)},
          {"phase-rms", scaled(m.constants.phase_rms, p)}};
}
std::vector<Frame> both(std::vector<Frame> first, const std::vector<Frame>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

class Checks {
 public:
  explicit Checks(double tolerance) : tolerance_(tolerance) {}

  /// `as` converts a constant in V s to the unit of the printed value. `only` is the frame of a key with a
  /// single frame.
  template <class As>
  void add(std::string_view key, const std::optional<Quantity>& q, std::string_view unit,
           const std::vector<Frame>& frames, std::string_view only, As as) {
    if (!q || !(q->value > 0.0)) return;
    FrameCheck check{q->key.empty() ? std::string(key) : q->key, unit, q->value, {}};
    const double doubt = tolerance_ + design::relative_doubt(*q);
    for (const Frame& frame : frames) {
      FrameReading r{frame.name, as(frame.V_s)};
      r.deviation = r.measured.value / q->value - 1.0;
      r.is_printed = frame.name == (only.empty() ? std::string_view(q->frame) : only);
      r.fits = r.measured.low <= q->value * (1.0 + doubt) && r.measured.high >= q->value * (1.0 - doubt);
      check.readings.push_back(r);
    }
    all_.push_back(std::move(check));
  }

  std::vector<FrameCheck> all() { return std::move(all_); }

 private:
  double tolerance_;
  std::vector<FrameCheck> all_;
};

Interval inverse(Interval x, double of) { return {of / x.value, of / x.high, of / x.low}; }

}  // namespace

const FrameReading* FrameCheck::as_printed() const {
  const auto found =
      std::find_if(readings.begin(), readings.end(), [](const FrameReading& r) { return r.is_printed; });
  return found == readings.end() ? nullptr : &*found;
}

std::vector<FrameCheck> check_frames(const EmfResult& m, const design::Sheet& sheet, double tolerance) {
  Checks checks(tolerance);
  const auto per = [](double factor) { return [factor](Interval V_s) { return scaled(V_s, factor); }; };
  if (m.pole_pairs > 0) {
    const double p = m.pole_pairs;
    const std::vector<Frame> torque = torque_frames(m, p), voltage = voltage_frames(m, p),
                             six_step{{"six-step", torque[0].V_s}};
    checks.add("torque_constant_mNm_A", sheet.torque_constant_mNm_A, "mNm/A", both(torque, voltage),
               "terminal", per(1e3));
    checks.add("back_emf_mV_s", sheet.back_emf_mV_s, "mV s", voltage, "phase-peak", per(1e3));
    checks.add("torque_constant_Nm_A", sheet.torque_constant_Nm_A, "Nm/A", both(torque, voltage), "",
               per(1.0));
    checks.add("back_emf_constant_V_krpm", sheet.back_emf_constant_V_krpm, "V/krpm", both(voltage, six_step),
               "", per(rad_s_per_krpm));
    checks.add("speed_constant_rpm_V", sheet.speed_constant_rpm_V, "rpm/V", both(six_step, voltage), "",
               [](Interval V_s) { return inverse(V_s, base::rpm_per_rad_s); });
  }
  const std::vector<Frame> flux{{"phase", m.constants.phase_fundamental},
                                {"line", m.constants.line_fundamental}};
  checks.add("flux_linkage_mWb", sheet.flux_linkage_mWb, "mWb", flux, "phase", per(1e3));
  return checks.all();
}

}  // namespace sixstep::analysis
