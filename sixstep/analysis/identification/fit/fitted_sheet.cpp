// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "sixstep/analysis/identification/fit/fit_result.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/visitor.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace sixstep::analysis {

namespace {

constexpr std::string_view motor_table = "motor_override.";

/// x to two digits of the half width of its bounds.
double rounded(double x, const Interval& bounds) {
  double width = bounds.half_width();
  if (!(width > 1e-30) || !(width < 1e30)) return x;
  int power = 1;
  for (; width < 1.0; width *= 10.0) ++power;
  for (; width >= 10.0; width /= 10.0) --power;
  return base::times_ten_to(std::round(base::times_ten_to(x, power)), -power);
}

/// Writes source and range of the fitted values into a sheet.
class SourceWriter final : public base::Visitor {
 public:
  explicit SourceWriter(const Fit& fit) : fit_(fit) {
    source_ = "fitted from ";
    std::vector<std::string> names;
    for (const FitColumn& column : fit.columns)
      if (std::find(names.begin(), names.end(), column.bench) == names.end()) names.push_back(column.bench);
    for (std::size_t n = 0; n < names.size(); ++n) source_ += (n ? ", " : "") + names[n];
    if (is_doubtful(fit)) source_ += "; doubtful, the model differs from the recording by more than noise";
  }

 private:
  void visit_quantity(std::string_view key, const base::QuantityMember& member, const base::About&) override {
    const auto fitted = std::find_if(fit_.values.begin(), fit_.values.end(),
                                     [&](const FittedValue& v) { return motor_key(v) == key; });
    base::Quantity* const quantity = quantity_in(member);
    if (fitted == fit_.values.end() || quantity == nullptr) return;
    quantity->value = rounded(fitted->value.value, fitted->value);
    quantity->source = source_;
    quantity->kind = base::Trust::measured;
    quantity->range =
        base::Interval{rounded(fitted->value.low, fitted->value), rounded(fitted->value.high, fitted->value)};
    quantity->last_digit.reset();
  }

  const Fit& fit_;
  std::string source_;
};

}  // namespace

bool is_doubtful(const Fit& fit) {
  return std::any_of(fit.columns.begin(), fit.columns.end(), [](const FitColumn& c) {
    return std::fabs(c.correlation) >
           std::max(0.2, 4.0 / std::sqrt(static_cast<double>(std::max<std::size_t>(c.t_s.size(), 1))));
  });
}

std::string_view motor_key(const FittedValue& value) {
  const std::string_view key = value.key;
  return key.starts_with(motor_table) ? key.substr(motor_table.size()) : std::string_view();
}

design::Sheet fitted_sheet(const study::Scenario& scenario, const Fit& fit) {
  study::Scenario s = scenario;
  for (const FittedValue& v : fit.values)
    if (!motor_key(v).empty())
      if (base::Result<study::Scenario> next = study::strayed_to(s, v.key, v.value.value))
        s = std::move(*next);
  SourceWriter writer(fit);
  describe(writer, s.sheet);
  return s.sheet;
}

}  // namespace sixstep::analysis
