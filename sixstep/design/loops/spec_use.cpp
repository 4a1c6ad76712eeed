// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/spec_use.hpp"

#include <string>

namespace sixstep::design {
namespace {

using control::Mode;

bool current_alone(const DesignSpec& w) { return w.mode == Mode::current; }
bool no_probes(const DesignSpec& w) { return !w.rotor.hall; }
bool no_edges(const DesignSpec& w) { return !w.rotor.hall && w.rotor.shaft.kind != ShaftSensorKind::encoder; }
bool never_late(const DesignSpec& w) { return !w.rotor.lags(); }
bool cancels(const DesignSpec& w) { return w.method == GainMethod::cancellation; }
bool cancels_alone(const DesignSpec& w) { return cancels(w) && current_alone(w); }
bool by_bandwidth(const DesignSpec& w) { return cancels(w) && w.bandwidth_rad_s.has_value(); }
bool by_bandwidth_alone(const DesignSpec& w) { return by_bandwidth(w) && current_alone(w); }
bool symmetrical(const DesignSpec& w) { return w.method == GainMethod::symmetrical_optimum; }

struct Idle {
  std::string_view member;
  bool (*where)(const DesignSpec&);
  const char *limit, *cure;
};

constexpr const char* with_speed = "add mode = speed or mode = position, or leave this option out";
constexpr const char* one_of_two = "leave one of the two options out";

/// Reasons why a member of a spec has no effect. If several rows of a member apply, the first is reported.
constexpr Idle idles[] = {
    {"current_settle_s", current_alone,
     "applies to a current loop inside a speed loop, and mode = current has no speed loop",
     "give settle_s, or add mode = speed or mode = position"},
    {"current_settle_s", by_bandwidth, "repeats bandwidth_rad_s", one_of_two},
    {"torque_limit_Nm", current_alone, "applies only to a speed loop, which mode = current does not have",
     with_speed},
    {"lowest_speed_rad_s", current_alone, "applies only to a speed loop, which mode = current does not have",
     with_speed},
    {"lowest_speed_rad_s", never_late,
     "determines the longest delay of a speed sensor, and an ideal sensor has no delay",
     "use rotor = hall or another sensor, or leave this option out"},
    {"load_inertia_kg_m2", current_alone, "has no effect, because mode = current holds the rotor",
     with_speed},
    {"edges", current_alone, "applies only to a speed loop, which mode = current does not have", with_speed},
    {"edges", no_probes, "applies to Hall probes only, and rotor is not hall",
     "use rotor = hall, or leave this option out"},
    {"capture_Hz", current_alone, "applies only to a speed loop, which mode = current does not have",
     with_speed},
    {"capture_Hz", no_edges, "applies to a timer that captures edges, which this rotor sensor does not have",
     "use rotor = hall or rotor = encoder, or leave this option out"},
    {"damping", cancels_alone, "applies to pole placement only, and method is cancellation",
     "use method = pole-placement, or leave this option out"},
    {"settle_s", by_bandwidth_alone, "repeats bandwidth_rad_s", one_of_two},
    {"settle_s", symmetrical,
     "applies to pole placement only; the symmetrical optimum is as fast as the current loop allows",
     "give current_settle_s, or use method = pole-placement"},
};

}  // namespace

std::optional<base::Problem> without_use(const DesignSpec& spec, std::string_view member) {
  for (const Idle& idle : idles)
    if (idle.member == member && idle.where(spec))
      return base::Problem{std::string(member), "", idle.limit, idle.cure};
  return std::nullopt;
}

}  // namespace sixstep::design
