// SPDX-License-Identifier: Apache-2.0
#include "text/motor/motor_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/decimal.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/key_advice.hpp"

namespace text {
namespace {

using design::Constant;
using design::Relation;
using design::RelationVerdict;
using design::SheetCheck;
using design::SheetConstants;

std::string short_number(double x) { return fmt::format("{:.4g}", x); }

/// Removes trailing spaces and ends the row as one line, whatever text the sheet has.
std::string trimmed(std::string row) {
  row.erase(row.find_last_not_of(' ') + 1);
  return visible(row) + "\n";
}

/// Visits a sheet and writes one row per value that the sheet gives.
class SheetRows final : public base::Visitor {
 public:
  const std::string& text() const { return text_; }

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About& about) override {
    std::visit([&](const auto* of) { row(key, *of, about); }, member);
  }
  template <class T>
  void row(std::string_view key, const T& member, const base::About& about) {
    add(key, fmt::format("{}", member), about.unit, "", "");
  }
  void row(std::string_view key, const std::string& member, const base::About&) {
    if (!member.empty()) add(key, member, "", "", "");
  }
  void row(std::string_view key, const bool& member, const base::About&) {
    if (member != (key == "simulatable")) add(key, member ? "true" : "false", "", "", "");
  }
  void row(std::string_view key, const double& member, const base::About& about) {
    if (member != 0) add(key, fmt::format("{}", member), about.unit, "", "");
  }
  /// A long list is printed as its length and its first and last value.
  template <class T>
  void row(std::string_view key, const std::vector<T>& member, const base::About& about) {
    constexpr std::size_t read_at_a_glance = 12;
    if (member.empty()) return;
    if (member.size() <= read_at_a_glance)
      return add(key, fmt::format("{}", fmt::join(member, ", ")), "", "", "");
    add(key, fmt::format("{} values, {} to {}", member.size(), member.front(), member.back()), about.unit, "",
        "");
  }
  template <class T>
  void row(std::string_view key, const std::optional<T>& member, const base::About& about) {
    if (member) row(key, *member, about);
  }
  /// The first choice of connection, rotor and kind applies to nearly every motor and is not printed.
  void visit_word(std::string_view key, base::WordMember& member, const base::About&) override {
    if ((key != "connection" && key != "rotor" && key != "kind") || member.chosen() != 0)
      add(key, member.word(), "", "", "");
  }
  /// Prints the quantity in the unit of the file's key.
  void visit_quantity(std::string_view key, const base::QuantityMember& member,
                      const base::About& about) override {
    const base::Quantity* const q = quantity_in(member);
    if (!q) return;
    double value = q->value;
    std::string_view unit = about.unit;
    const auto spelling =
        std::find_if(about.also.begin(), about.also.end(), [&](const auto& s) { return s.key == q->key; });
    const int ten = spelling == about.also.end() ? 0 : -spelling->ten;
    if (spelling != about.also.end() && !spelling->unit.empty()) unit = spelling->unit;
    if (spelling != about.also.end() && spelling->factor != 1.0) value /= spelling->factor;
    value = base::times_ten_to(value, ten);
    std::string source = q->source;
    if (q->kind != base::Trust::unstated)
      source.append(
          fmt::format("{}[{}]", source.empty() ? "" : " ", base::word(base::trust_choices, q->kind)));
    if (q->range)
      source += fmt::format(" (sources: {} to {})", shortest(base::times_ten_to(q->range->low, ten)),
                            shortest(base::times_ten_to(q->range->high, ten)));
    const bool converted =
        spelling != about.also.end() && spelling->factor != 1.0;  // the conversion may have lost the last
                                                                  // digit
    add(q->key.empty() ? key : std::string_view(q->key),
        converted ? fmt::format("{:.12g}", value) : shortest(value), unit, q->frame, source);
  }
  void add(std::string_view key, std::string_view value, std::string_view unit, std::string_view frame,
           std::string_view source) {
    text_ += trimmed(fmt::format("{:<26} {:>10} {:<8}{:<10}{}", key, value, unit, frame, source));
  }
  std::string text_;
};

std::string model_row(std::string_view symbol, const std::string& value, std::string_view from) {
  return trimmed(fmt::format("  {:<6} {:<18} {}", symbol, value, from));
}

std::string model_row(std::string_view symbol, const std::optional<Constant>& constant, double unit,
                      std::string_view unit_word, std::string_view from = "") {
  if (!constant) return model_row(symbol, "not given", "");
  return model_row(symbol, fmt::format("{:.4g} {}", constant->value * unit, unit_word),
                   from.empty() ? std::string_view(constant->from) : from);
}

std::string back_emf_words(const design::Sheet& sheet) {
  std::string words = sheet.back_emf == design::BackEmfShape::sine ? "sine"
                      : sheet.back_emf == design::BackEmfShape::table
                          ? fmt::format("table of {} points", sheet.back_emf_shape.size())
                          : fmt::format("trapezoid, {:g} deg flat", sheet.flat_deg);
  for (std::size_t n = 0; n < sheet.harmonic_orders.size() && n < sheet.harmonic_sizes.size(); ++n)
    words += fmt::format(", {:+g} of order {:g}", sheet.harmonic_sizes[n], sheet.harmonic_orders[n]);
  return words + (sheet.connection == design::WindingConnection::delta ? ", delta" : "");
}

/// A torque as text: "6.197 mNm"; for a linear motor a force in N.
std::string torque_text(double torque_Nm, bool linear) {
  return linear ? short_number(torque_Nm) + " N" : short_number(torque_Nm * 1e3) + " mNm";
}

std::string friction_rows(const design::Friction& f, bool linear) {
  const char *unit = linear ? "N s/m" : "Nm s", *dry = linear ? "F_c" : "T_c";
  std::string text = model_row("B", fmt::format("{} {}", short_number(f.B_Nm_s), unit), f.from);
  if (f.coulomb_Nm > 0.0) text += model_row(dry, torque_text(f.coulomb_Nm, linear), "");
  if (f.iron.B_Nm_s > 0.0 || f.iron.coulomb_Nm > 0.0)
    text += fmt::format("         share of the iron in these values: B = {} {}, {} = {}\n",
                        short_number(f.iron.B_Nm_s), unit, dry, torque_text(f.iron.coulomb_Nm, linear));
  if (f.all_viscous_Nm_s) {
    text += fmt::format("         no-load point at {} {}: B = {} {} if all friction is viscous,\n",
                        short_number(f.no_load_speed_rad_s), linear ? "m/s" : "rad/s",
                        short_number(*f.all_viscous_Nm_s), unit);
    text += fmt::format("         {} = {} if all friction is Coulomb friction\n", dry,
                        torque_text(*f.all_coulomb_Nm, linear));
  }
  if (f.split_viscous_Nm_s)
    text +=
        fmt::format("         with the second point: B = {} {} and {} = {}\n",
                    short_number(*f.split_viscous_Nm_s), unit, dry, torque_text(*f.split_coulomb_Nm, linear));
  return text;
}

std::string_view word(RelationVerdict verdict) {
  switch (verdict) {
    case RelationVerdict::holds:
      return "ok";
    case RelationVerdict::known:
      return "known";
    case RelationVerdict::doubted:
      return "doubt";
    case RelationVerdict::broken:
      break;
  }
  return "BROKEN";
}

constexpr double most_percentage = 10.0;

std::string relation_rows(const Relation& r) {
  // A name that is wider than its column gets a separate line.
  const bool wide = r.name.size() > 25;
  std::string text = wide ? fmt::format("  {:<7}{}\n", word(r.verdict), r.name) : "";
  // From ten times on, a factor is clearer than a percentage.
  const std::string deviation = std::fabs(r.deviation) < most_percentage
                                    ? fmt::format("{:>+7.2f} %", 100.0 * r.deviation)
                                    : fmt::format("{:>9}", "x " + short_number(r.deviation + 1.0));
  text +=
      trimmed(fmt::format("  {:<7}{:<25} {:<27} {:>9} {:>9} {:<13} {} {:>+7.2f} {:>+6.2f} %",
                          wide ? "" : word(r.verdict), wide ? "" : r.name, r.left_words, short_number(r.left),
                          short_number(r.right), r.unit, deviation, 100.0 * r.lowest, 100.0 * r.highest));
  if (!r.remark.empty()) text += trimmed("         " + r.remark);
  return text;
}

/// The reason why the motor cannot be simulated; empty if it can.
std::string not_simulatable(const design::Sheet& sheet, const SheetCheck& check) {
  std::string missing;
  const base::Problems& all = check.constants.missing;
  for (std::size_t n = 0; n < all.size(); ++n)
    missing += (n == 0 ? "" : n + 1 == all.size() ? " and " : ", ") + all[n].where;
  if (!missing.empty())
    return fmt::format("; it cannot be simulated: {} {} missing", missing, all.size() == 1 ? "is" : "are");
  if (!sheet.simulatable) return "; it cannot be simulated: " + sheet.not_simulatable_because;
  const base::Result<design::MotorModel> model = design::motor_model(sheet);
  return model ? "" : "; it cannot be simulated: " + base::to_string(model.problems().front());
}

/// Lists the values that the sheet prints with one digit. Their rounding widens the tolerance of every
/// relation that contains them. The sheet's voltage counts as exact.
std::string coarse_lines(const SheetCheck& check) {
  constexpr double wide = 0.05;
  std::string text;
  for (const design::LineUse& line : check.lines)
    if (line.doubt > wide && line.in_file == std::floor(line.in_file) &&
        line.key.find("voltage") == std::string::npos)
      text += trimmed(fmt::format("  {} = {} is read as {} +- {:.2g} %", line.key, shortest(line.in_file),
                                  shortest(line.in_file), 100.0 * line.doubt));
  return text;
}

std::string verdict_line(const SheetCheck& check) {
  std::size_t holds = 0, known = 0, broken = 0, doubted = 0;
  for (const Relation& r : check.relations)
    ++(r.verdict == RelationVerdict::holds     ? holds
       : r.verdict == RelationVerdict::known   ? known
       : r.verdict == RelationVerdict::doubted ? doubted
                                               : broken);
  if (check.relations.empty()) return "consistent: no two values of the sheet can be compared";
  std::string text = fmt::format("{}: {} of {} relations hold",
                                 !check.consistent ? "INCONSISTENT"
                                 : doubted > 0     ? "not contradictory"
                                                   : "consistent",
                                 holds, check.relations.size());
  if (known > 0) text += fmt::format(", {} broken as known_deviation states", known);
  if (doubted > 0) text += fmt::format(", {} in doubt", doubted);
  if (broken > 0) text += fmt::format(", {} broken", broken);
  return text;
}

}  // namespace

std::string sheet_table(const design::Sheet& sheet) {
  SheetRows rows;
  design::Sheet copy = sheet;
  describe(rows, copy);
  return rows.text();
}

std::string model_table(const design::Sheet& sheet, const SheetCheck& check) {
  const SheetConstants& c = check.constants;
  std::string text = "Model, per phase of the star\n";
  if (!sheet.simulatable) text += trimmed("  not simulatable: " + sheet.not_simulatable_because);
  for (const base::Problem& p : c.missing) text += trimmed("  " + base::to_string(p));
  const bool linear = sheet.kind == design::MotorKind::linear;
  if (linear)
    text += model_row("tau", c.pole_pitch_m ? fmt::format("{:.4g} mm", *c.pole_pitch_m * 1e3) : "not given",
                      "pole pitch; pi/tau replaces the pole pairs");
  else
    text += model_row("p", c.pole_pairs ? fmt::format("{}", *c.pole_pairs) : "not given", "pole pairs");
  text += model_row("R_s", c.R_ohm, 1.0, "ohm");
  text += model_row("L_s", c.L_H, 1e3, "mH");
  const bool table = sheet.back_emf == design::BackEmfShape::table;
  const std::string peak = fmt::format("{} per {}; {}", table ? "times the table" : "a phase's peak",
                                       linear ? "m/s" : "rad/s", back_emf_words(sheet));
  text +=
      linear ? model_row("K_e", c.K_e_V_s, 1, "V s/m", peak) : model_row("K_e", c.K_e_V_s, 1e3, "mV s", peak);
  text += linear ? model_row("K_f", c.K_t_Nm_A, 1, "N/A") : model_row("K_t", c.K_t_Nm_A, 1e3, "mNm/A");
  text += linear ? model_row("m", c.J_kg_m2, 1, "kg") : model_row("J", c.J_kg_m2, 1e7, "g cm2");
  if (check.electrical_time_constant_s)
    text += model_row("tau_e", short_number(*check.electrical_time_constant_s * 1e3) + " ms", "L / R");
  if (check.mechanical_time_constant_s)
    text += model_row("tau_m", short_number(*check.mechanical_time_constant_s * 1e3) + " ms",
                      linear ? "R m / K_f^2, between two terminals" : "R J / K_t^2, between two terminals");
  if (check.stall_current_A) text += model_row("I_st", short_number(*check.stall_current_A) + " A", "U / R");
  text += friction_rows(c.friction, linear);
  if (const std::string more = design::left_to_a_run(sheet); !more.empty())
    text += trimmed("  A run also includes: " + more);
  return text;
}

std::string check_report(const design::Sheet& sheet, const SheetCheck& check) {
  std::string text = trimmed(sheet.name);
  if (!check.relations.empty())
    text += fmt::format("\n  {:<32} {:<27} {:>9} {:>9} {:<13} {:>9} {:>16}\n", "Relation", "computed", "",
                        "printed", "", "deviation", "tolerated");
  for (const Relation& r : check.relations) text += relation_rows(r);
  text.append("\n").append(model_table(sheet, check));
  std::string unused;
  for (const design::LineUse& line : check.lines)
    if (!line.used) unused += trimmed(fmt::format("  {}: {}", line.key, line.why));
  if (!unused.empty()) text += "\nLines of the sheet that the model does not use\n" + unused;
  if (const std::string coarse = coarse_lines(check); !coarse.empty())
    text +=
        "\nValues with one digit: write also the zeros that the sheet prints, as in 4.00, to narrow the tolerance\n" +
        coarse;
  std::string doubts;
  for (const base::Problem& doubt : check.doubts) doubts += "; in doubt: " + base::to_string(doubt);
  return text + "\n" + trimmed(verdict_line(check) + not_simulatable(sheet, check) + doubts);
}

std::string motor_line_heading(std::size_t width) {
  return fmt::format("{:<{}} {:>2} {:>6} {:>10} {:>10} {:>10}\n", "", width, "p", "U/V", "R_tt/ohm",
                     "K_t/mNm/A", "J/gcm2");
}

std::string motor_line(const std::string& name, const design::Sheet& sheet, std::size_t width) {
  const SheetConstants c = design::sheet_constants(sheet);
  const auto number = [](const auto& constant, double unit) {
    return constant ? short_number(constant->value * unit) : std::string("-");
  };
  const auto with_unit = [](const auto& constant, const char* unit) {
    return constant ? short_number(constant->value) + unit : std::string("-");
  };
  if (sheet.kind == design::MotorKind::linear)  // in the units of a linear motor
    return trimmed(fmt::format(
        "{:<{}} {:>2} {:>6} {:>10} {:>10} {:>10}  {}", name, width, "-",
        c.nominal_voltage_V ? short_number(*c.nominal_voltage_V) : "-", number(c.R_ohm, 2.0),
        with_unit(c.K_t_Nm_A, " N/A"), with_unit(c.J_kg_m2, " kg"),
        sheet.simulatable ? "linear" : fmt::format("not simulatable: {}", sheet.not_simulatable_because)));
  return trimmed(fmt::format(
      "{:<{}} {:>2} {:>6} {:>10} {:>10} {:>10}  {}", name, width,
      c.pole_pairs ? fmt::format("{}", *c.pole_pairs) : "-",
      c.nominal_voltage_V ? short_number(*c.nominal_voltage_V) : "-", number(c.R_ohm, 2.0),
      number(c.K_t_Nm_A, 1e3), number(c.J_kg_m2, 1e7),
      sheet.simulatable ? "" : fmt::format("not simulatable: {}", sheet.not_simulatable_because)));
}

}  // namespace text
