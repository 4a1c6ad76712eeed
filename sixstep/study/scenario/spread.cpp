// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "sixstep/base/hash.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/base/random.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/study/scenario/draws.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"

namespace sixstep::study {
namespace {

constexpr std::string_view torque_key = "motor_override.torque_constant_mNm_A",
                           back_emf_key = "motor_override.back_emf_mV_s";

/// Motor values that can vary. The sheet's other values, such as the nominal voltage, are not properties of
/// one motor.
constexpr std::string_view motor_keys[] = {"motor_override.resistance_ohm",
                                           "motor_override.inductance_mH",
                                           torque_key,
                                           back_emf_key,
                                           "motor_override.inertia_gcm2",
                                           "motor_override.viscous_friction_Nm_s",
                                           "motor_override.coulomb_friction_mNm",
                                           "motor_override.iron_viscous_Nm_s",
                                           "motor_override.iron_coulomb_mNm",
                                           "motor_override.flat_deg"};
/// The key of one Hall edge continues with the edge's index: "sensors.hall_edges_deg[0]".
constexpr std::string_view hall_edge_keys = "sensors.hall_edges_deg[";
constexpr std::string_view tables[] = {"supply.",
                                       "bridge.",
                                       "load.",
                                       "initial.",
                                       "believed.",
                                       hall_edge_keys,
                                       "sensors.hall_offset_deg",
                                       "sensors.encoder.offset_deg",
                                       "sensors.absolute.offset_deg",
                                       "sensors.resolver.offset_deg"};

bool may_stray(std::string_view key) {
  return std::find(std::begin(motor_keys), std::end(motor_keys), key) != std::end(motor_keys) ||
         std::any_of(std::begin(tables), std::end(tables),
                     [&](std::string_view table) { return key.starts_with(table); });
}

/// Finds the number at a key's path.
class NumberAt final : public base::Visitor {
 public:
  explicit NumberAt(std::string_view path) : path_(path) {}

  double* number = nullptr;  ///< null: not found
  base::Range range;
  std::string_view unit;
  bool left_out = false;  ///< true: the key exists, but no value is given

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About& about) override {
    if (double* const* x = std::get_if<double*>(&member)) take(key, *x, about);
    if (std::optional<double>* const* x = std::get_if<std::optional<double>*>(&member))
      take(key, **x ? &***x : nullptr, about);
    if (std::vector<double>* const* x = std::get_if<std::vector<double>*>(&member))
      for (std::size_t n = 0; n < (*x)->size(); ++n)
        take(std::string(key) + "[" + std::to_string(n) + "]", &(**x)[n], about);
  }
  void visit_quantity(std::string_view key, const base::QuantityMember& member,
                      const base::About& about) override {
    base::Quantity* const q = quantity_in(member);
    take(key, q ? &q->value : nullptr, about);
  }
  void visit_table(std::string_view key, base::TableMember& member, const base::About&) override {
    if (member.is_optional() || !path_.starts_with(key) || path_.substr(key.size(), 1) != ".") return;
    const std::string_view whole = path_;
    path_.remove_prefix(key.size() + 1);
    member.walk(*this);
    path_ = whole;
  }
  void take(std::string_view key, double* x, const base::About& about) {
    if (key != path_) return;
    number = x;
    range = base::allowed(about);
    unit = about.unit;
    left_out = !x;
  }
  std::string_view path_;
};

NumberAt find_number(Scenario& scenario, std::string_view key) {
  NumberAt finder(key);
  describe(finder, scenario);
  return finder;
}

/// The scenario with explicit numbers for all values that are computed from a varying value. The motor's
/// constants have their standard keys, whichever keys the sheet uses. If a Hall edge varies and the scenario
/// gives no edges, all six edges are set to their nominal value 0.
Scenario written_out(const Scenario& scenario, std::string_view key = {}) {
  Scenario s = scenario;
  s.sheet = design::in_standard_keys(std::move(s.sheet));
  const bool edges = std::any_of(s.spread.begin(), s.spread.end(), [](const Spread& spread) {
    return std::string_view(spread.key).starts_with(hall_edge_keys);
  });
  if ((edges || key.starts_with(hall_edge_keys)) && s.sensors.hall_edges_deg.empty())
    s.sensors.hall_edges_deg.assign(6, 0.0);
  return s;
}

/// Half width or standard deviation in the key's unit.
double width(const Spread& spread, double nominal) {
  return spread.absolute ? *spread.absolute : *spread.relative * std::fabs(nominal);
}

std::uint64_t stream_of(std::string_view key) {
  base::Hash hash;
  for (const char c : key) hash.word(static_cast<unsigned char>(c));
  return hash.value();
}

/// Deviation in units of the width. Values outside of the cut are drawn again: with cut_sigma >= 1 at least
/// 68 % are inside, so that 64 draws in a row are outside once in 10^31 drives. Then the value stays nominal.
double deviation(const Spread& spread, std::uint64_t seed, std::uint64_t number) {
  const std::uint64_t stream = stream_of(spread.key);
  if (spread.distribution == Distribution::uniform) return 2.0 * base::uniform({seed, stream, number}) - 1.0;
  for (std::uint64_t attempt = 0; attempt < 64; ++attempt) {
    const double x = base::normal({seed, stream, number | attempt << 48});
    if (std::fabs(x) <= spread.cut_sigma) return x;
  }
  return 0.0;
}

/// Seed of one drive's noise. It differs from drive to drive, and has no effect without noise.
int noise_seed(const Scenario& scenario, std::uint64_t seed, std::uint64_t number) {
  const std::uint64_t stream = stream_of("sensors.seed") + static_cast<std::uint64_t>(scenario.sensors.seed);
  return static_cast<int>(base::random_bits({seed, stream, number})[0] >> 33);
}

void set_number(Scenario& s, std::string_view key, double x) {
  double* const number = find_number(s, key).number;
  if (number == nullptr) return;  // check_spread() has reported it
  const double before = std::exchange(*number, x);
  if (key != torque_key && key != back_emf_key) return;
  const NumberAt partner = find_number(s, key == torque_key ? back_emf_key : torque_key);
  if (partner.number) *partner.number *= x / before;
}

struct Checker {
  Scenario scenario;  // the scenario with explicit derived values
  base::Problems problems;

  void check(const Spread& spread, const std::string& where) {
    const NumberAt at = find_number(scenario, spread.key);
    if (!may_stray(spread.key) || (!at.number && !at.left_out))
      return add(
          where + ".key", "\"" + spread.key + "\"",
          "is not a number that may differ from drive to drive: only numbers of motor_override, supply, bridge, load, initial or believed, and angles of Hall edges or sensors",
          "write the key as table.key, for example \"supply.voltage_V\"; the help on spread.key lists the motor's keys");
    if (!at.number)
      return add(where + ".key", "\"" + spread.key + "\"",
                 "has no value in the motor file that could differ from drive to drive",
                 spread.key == torque_key     ? "spread back_emf_mV_s, which the sheet gives"
                 : spread.key == back_emf_key ? "spread torque_constant_mNm_A, which the sheet gives"
                                              : "give " + spread.key + " its nominal value first");
    if (!spread.relative == !spread.absolute)
      return add(where + (spread.relative ? ".absolute" : ".relative"), "",
                 spread.relative ? "contradicts relative: both keys give the width" : "is missing",
                 "give relative (as a part of the value) or absolute (in the key's unit)");
    if (spread.relative && *at.number == 0.0)
      return add(where + ".relative", base::written(*spread.relative),
                 "is a part of " + spread.key + " = 0, which is always 0", "give absolute instead");
    check_reach(spread, at, where);
  }

  void check_reach(const Spread& spread, const NumberAt& at, const std::string& where) {
    const double reach =
        width(spread, *at.number) * (spread.distribution == Distribution::uniform ? 1.0 : spread.cut_sigma);
    for (const double end : {*at.number - reach, *at.number + reach})
      if (!at.range.holds(end))
        return add(where + (spread.relative ? ".relative" : ".absolute"),
                   base::written(spread.relative ? *spread.relative : *spread.absolute),
                   "lets " + spread.key + " reach " + base::six_digits(end) + ", outside the key's range",
                   spread.distribution == Distribution::uniform ? "lower this value"
                                                                : "lower this value, or lower cut_sigma");
  }

  void add(std::string where, std::string value, std::string limit, std::string cure) {
    problems.push_back({std::move(where), std::move(value), std::move(limit), std::move(cure)});
  }
};

/// The scenario with its present values as the controller's design basis.
Scenario with_its_designer(const Scenario& scenario, std::string_view key = {}) {
  Scenario s = written_out(scenario, key);
  if (!s.designed_for) s.designed_for = Nominal{scenario.sheet, scenario.supply, scenario.load};
  return s;
}

/// The key that names the varied quantity. Back-EMF constant and torque constant are one quantity.
std::string_view spread_fact(std::string_view key) { return key == back_emf_key ? torque_key : key; }

}  // namespace

Scenario varied(const Scenario& scenario, std::uint64_t seed, std::uint64_t number) {
  Scenario s = with_its_designer(scenario);
  for (const Spread& spread : scenario.spread) {
    const double nominal = *find_number(s, spread.key).number;
    set_number(s, spread.key, nominal + width(spread, nominal) * deviation(spread, seed, number));
  }
  s.spread.clear();
  // If nothing is drawn, the seed keeps its default. Any other seed would cause the remark that a given key
  // has no effect.
  s.sensors.seed = draws_nothing(s) ? Sensors{}.seed : noise_seed(scenario, seed, number);
  return s;
}

std::vector<double> strayed_values(const Scenario& scenario, Scenario drive) {
  std::vector<double> values;
  values.reserve(scenario.spread.size());
  for (const Spread& spread : scenario.spread) {
    const NumberAt at = find_number(drive, spread.key);
    values.push_back(at.number ? *at.number : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

std::optional<VaryingNumber> varying_number(const Scenario& scenario, std::string_view key) {
  Scenario s = written_out(scenario, key);
  const NumberAt at = find_number(s, key);
  if (!may_stray(key) || !at.number) return {};
  return VaryingNumber{*at.number, std::string(at.unit)};
}

base::Result<Scenario> strayed_to(const Scenario& scenario, std::string_view key, double x) {
  Scenario s = with_its_designer(scenario, key);
  const NumberAt at = find_number(s, key);
  const auto refuse = [&](std::string limit, std::string cure) {
    return base::Problem{std::string(key), base::written(x), std::move(limit), std::move(cure)};
  };
  if (!may_stray(key) || !at.number)
    return refuse(
        "belongs to a key that may not differ from drive to drive",
        "remove strays = true, or vary a key of motor_override, supply, bridge, load, initial or believed, or a Hall edge such as sensors.hall_edges_deg[0]");
  if (!at.range.holds(x)) return refuse("is outside the key's range", "narrow the range");
  set_number(s, key, x);
  return s;
}

base::Problems check_spread(const Scenario& scenario) {
  if (scenario.spread.empty()) return {};
  Checker checker{written_out(scenario), {}};
  for (std::size_t n = 0; n < scenario.spread.size(); ++n) {
    const std::string where = "spread[" + std::to_string(n) + "]";
    const auto same = [&](const Spread& other) {
      return spread_fact(other.key) == spread_fact(scenario.spread[n].key);
    };
    const auto end = scenario.spread.begin() + static_cast<std::ptrdiff_t>(n);
    if (std::any_of(scenario.spread.begin(), end, same))
      checker.add(where + ".key", "\"" + scenario.spread[n].key + "\"", "is spread already",
                  "remove all entries of this quantity except one");
    else
      checker.check(scenario.spread[n], where);
  }
  return checker.problems;
}

}  // namespace sixstep::study
