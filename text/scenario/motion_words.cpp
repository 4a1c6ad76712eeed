// SPDX-License-Identifier: Apache-2.0
#include "text/scenario/motion_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/linear.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/keys/key_tree.hpp"

namespace text {
namespace {

/// The paths in a document at which a catalog's path occurs: one, or one in each table of a list.
std::vector<std::string> places_of(const std::string& path, const Document& document) {
  const std::size_t dot = path.find('.');
  const toml::node* first = document.find(path.substr(0, dot));
  if (dot == path.npos || !first || !first->is_array()) return {path};
  std::vector<std::string> places;
  for (std::size_t n = 0; n < first->as_array()->size(); ++n)
    places.push_back(fmt::format("{}[{}]{}", path.substr(0, dot), n, path.substr(dot)));
  return places;
}

void refuse(const std::string& path, const std::string& instead, Complaints& complaints) {
  for (const std::string& place : places_of(path, complaints.document()))
    if (complaints.document().find(place)) complaints.other_motion(place, instead);
}

/// The number to write: the nearest number that becomes `own` again when it is read and divided by the
/// factor.
double written_as(double own, double factor) {
  if (factor == 1.0) return own;
  double x = own * factor;
  for (int n = 0; n < 4 && x / factor != own; ++n)
    x = std::nextafter(x, x / factor < own ? HUGE_VAL : -HUGE_VAL);
  return x;
}

/// A key of [[spread]] by its two names, and the factor from the linear motor's unit to the rotary motor's.
struct TwoNames {
  std::string turning, linear;
  double factor = 1.0;
};

/// The constants of a sheet are spread by their standard keys, which have no other spelling.
const TwoNames of_constants[] = {
    {"motor_override.torque_constant_mNm_A", "motor_override.force_constant_N_A", 1e3},
    {"motor_override.back_emf_mV_s", "motor_override.back_emf_V_s_m", 1e3},
};

std::vector<TwoNames> all_two_names() {
  std::vector<TwoNames> names(std::begin(of_constants), std::end(of_constants));
  for (const KeyEntry& entry : scenario_keys())
    if (const base::Spelling* linear = base::linear_spelling(entry.about))
      names.push_back({entry.path, spelled(entry, *linear).path, base::in_own_unit(1.0, *linear)});
  return names;
}

/// The first entry with the name `key`; null if there is none.
const TwoNames* find(const std::vector<TwoNames>& names, std::string TwoNames::*which,
                     const std::string& key) {
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const TwoNames& two) { return two.*which == key; });
  return found == names.end() ? nullptr : &*found;
}

/// Visits a scenario and replaces the values whose unit follows from a mode or a figure.
class InMetres final : public base::Visitor {
 public:
  explicit InMetres(const study::Scenario& s) : modes_(study::modes_from(s)), mode_(s.control.mode) {}

 private:
  void visit_value(std::string_view, const base::ValueMember& member, const base::About& about) override {
    std::visit([&](auto* of) { write(*of, factor_of(about)); }, member);
  }
  static void write(double& x, double factor) { x = written_as(x, factor); }
  static void write(std::vector<double>& list, double factor) {
    for (double& x : list) x = written_as(x, factor);
  }
  static void write(std::optional<double>& x, double factor) {
    if (x) x = written_as(*x, factor);
  }
  template <class Other>
  static void write(Other&, double) {}
  void visit_table(std::string_view key, base::TableMember& member, const base::About&) override {
    if (member.is_there() && key != study::sheet_table) member.walk(*this);
  }
  void visit_list(std::string_view key, base::ListMember& items, const base::About&) override {
    const sixstep::control::Mode at_start = mode_;
    for (std::size_t n = 0; n < items.size(); ++n) {
      if (key == study::events_list) mode_ = modes_[n];
      items.walk(n, *this);
    }
    mode_ = at_start;
  }
  double factor_of(const base::About& about) const {
    const std::string_view unit = about.mode_unit.empty() ? about.unit_here : study::reference_unit(mode_);
    return base::in_linear(unit).factor;
  }
  std::vector<sixstep::control::Mode> modes_;
  sixstep::control::Mode mode_;
};

}  // namespace

void refuse_other_motion(const std::vector<KeyEntry>& keys, Complaints& complaints) {
  for (const KeyEntry& entry : keys) {
    const base::Spelling* linear = base::linear_spelling(entry.about);
    if (!linear) continue;
    const std::string table = entry.path.substr(0, entry.path.rfind('.') + 1);
    const std::string own(entry.path.substr(table.size()));
    if (!complaints.linear_motor()) {
      refuse(table + std::string(linear->key), own, complaints);
      continue;
    }
    refuse(entry.path, std::string(linear->key), complaints);
    for (const base::Spelling& other : entry.about.also)
      if (!other.linear) refuse(table + std::string(other.key), std::string(linear->key), complaints);
  }
}

void read_spread_keys(study::Scenario& scenario, Complaints& complaints) {
  if (scenario.spread.empty()) return;
  const std::vector<TwoNames> names = all_two_names();
  const bool linear = complaints.linear_motor();
  for (std::size_t n = 0; n < scenario.spread.size(); ++n) {
    study::Spread& spread = scenario.spread[n];
    const std::string at = fmt::format("spread[{}].key", n);
    const TwoNames *own = find(names, &TwoNames::linear, spread.key),
                   *turning = find(names, &TwoNames::turning, spread.key);
    if (linear && turning) complaints.other_motion(at, fmt::format("\"{}\"", turning->linear));
    if (!linear && own) complaints.other_motion(at, fmt::format("\"{}\"", own->turning));
    if (!linear || !own) continue;
    spread.key = own->turning;
    if (spread.absolute) *spread.absolute *= own->factor;
  }
}

void in_units_of_its_motor(study::Scenario& scenario) {
  if (scenario.sheet.kind == design::MotorKind::rotary) return;
  InMetres visitor(scenario);
  describe(visitor, scenario);
  if (scenario.spread.empty()) return;
  const std::vector<TwoNames> names = all_two_names();
  for (study::Spread& spread : scenario.spread)
    if (const TwoNames* key = find(names, &TwoNames::turning, spread.key)) {
      spread.key = key->linear;
      if (spread.absolute) *spread.absolute /= key->factor;
    }
}

}  // namespace text
