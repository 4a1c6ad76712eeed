// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_override.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>

#include "sixstep/design/sheet/sheet_description.hpp"

namespace sixstep::design {

namespace {

using Keys = std::span<const std::string_view>;

constexpr std::array<std::string_view, 6> torque_keys = {"torque_constant_mNm_A", "back_emf_mV_s",
                                                         "torque_constant_Nm_A",  "back_emf_constant_V_krpm",
                                                         "flux_linkage_mWb",      "speed_constant_rpm_V"};
constexpr std::array<std::string_view, 3> inductance_keys = {"inductance_mH", "d_axis_inductance_mH",
                                                             "q_axis_inductance_mH"};
constexpr std::array<std::string_view, 4> geometry_keys = {"flux_density_T", "active_length_mm",
                                                           "air_gap_radius_mm", "turns_in_series"};
constexpr std::array<std::string_view, 2> inertia_keys = {"inertia_gcm2", "inertia_with_brake_gcm2"};
constexpr std::array<std::string_view, 4> body_keys = {"rotor_radius_mm", "rotor_inner_radius_mm",
                                                       "rotor_length_mm", "rotor_density_kg_m3"};
constexpr std::array<std::string_view, 2> shape_lists = {"back_emf_angle_deg", "back_emf_shape"};
constexpr std::array<std::string_view, 1> shape_file = {"back_emf_file"};
constexpr std::array<std::string_view, 3> pole_keys = {"pole_pairs", "poles", "winding"};

/// Visitor that clears the given keys of a sheet, except the overridden keys.
class Forget final : public base::Visitor {
 public:
  Forget(Keys keys, const std::function<bool(std::string_view)>& overridden)
      : keys_(keys), overridden_(overridden) {}

 private:
  void visit_quantity(std::string_view key, const base::QuantityMember& member, const base::About&) override {
    std::optional<base::Quantity>* const* q = std::get_if<std::optional<base::Quantity>*>(&member);
    if (q && stale(key)) (*q)->reset();
  }
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About&) override {
    if (!stale(key)) return;
    if (std::optional<int>* const* count = std::get_if<std::optional<int>*>(&member)) (*count)->reset();
    if (std::string* const* text = std::get_if<std::string*>(&member)) (*text)->clear();
    if (std::vector<double>* const* list = std::get_if<std::vector<double>*>(&member)) (*list)->clear();
  }
  bool stale(std::string_view key) const {
    return std::find(keys_.begin(), keys_.end(), key) != keys_.end() && !overridden_(key);
  }
  Keys keys_;
  const std::function<bool(std::string_view)>& overridden_;
};

}  // namespace

void drop_stale(Sheet& sheet, const std::function<bool(std::string_view key)>& overridden) {
  const auto any = [&](Keys keys) { return std::any_of(keys.begin(), keys.end(), overridden); };
  const auto forget = [&](Keys keys) {
    Forget stale(keys, overridden);
    describe(stale, sheet);
  };
  const bool geometry = any(geometry_keys);
  if (geometry || any(torque_keys)) forget(torque_keys);
  if (!geometry && any(torque_keys)) forget(geometry_keys);
  if (any(inductance_keys)) forget(inductance_keys);
  if (any(pole_keys)) forget(pole_keys);
  const bool body = any(body_keys);
  if (body) forget(inertia_keys);
  if (!body && any(inertia_keys)) forget(body_keys);
  if (any(shape_file)) forget(shape_lists);
  if (any(shape_lists)) forget(shape_file);
}

}  // namespace sixstep::design
