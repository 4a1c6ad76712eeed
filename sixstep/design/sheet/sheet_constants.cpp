// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/design/sheet/parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sixstep/design/sheet/sheet_reader.hpp"

namespace sixstep::design {
namespace {

using base::Quantity;

/// Value per phase of the equivalent star: half of a value between two terminals.
double per_phase(double value, std::string_view frame) { return frame == "phase" ? value : value / 2.0; }

std::string from_frame(std::string_view key, const Quantity& q) {
  return SheetReader::key_of(key, q) + (q.frame == "phase" ? ", phase: as it is" : ", terminal: halved");
}

/// True if a value computed from `with` equals the printed value up to both roundings and 2 %.
bool fits(double computed, const Quantity& with, const Quantity& printed) {
  constexpr double besides = 0.02;
  return std::abs(computed / printed.value - 1.0) <= relative_doubt(with) + relative_doubt(printed) + besides;
}

/// Text for the frame of `with` that agrees with another printed value: "fits \"terminal\"", or "fits
/// neither".
std::string fitting_frame(const std::array<double, 2>& terminal_phase, const Quantity& with,
                          const Quantity& printed) {
  if (fits(terminal_phase[0], with, printed)) return "fits \"terminal\"";
  if (fits(terminal_phase[1], with, printed)) return "fits \"phase\"";
  return "fits neither";
}

void read_resistance(SheetReader& reader) {
  const std::optional<Quantity>& q = reader.sheet.resistance_ohm;
  if (!q)
    return reader.missing("resistance_ohm",
                          "give the winding's resistance with its frame, or measure it "
                          "between two terminals with a milliohm meter");
  const std::optional<double> R = SheetReader::positive(*q);
  if (!R) return;
  if (q->frame == "terminal" || q->frame == "phase") {
    reader.out.R_ohm = Constant{per_phase(*R, q->frame), from_frame("resistance_ohm", *q)};
    return reader.use("resistance_ohm");
  }
  const auto means = [&](double R_s) {
    std::string text = "R_s = " + rounded(R_s) + " ohm";
    if (const std::optional<double> U = reader.out.nominal_voltage_V)
      text += ", stall current " + rounded(*U / (2.0 * R_s), 3) + " A";
    return text;
  };
  std::string hint;
  if (reader.sheet.stall_current_A && reader.out.nominal_voltage_V) {
    const Quantity& stall = *reader.sheet.stall_current_A;
    const double per_terminal = *reader.out.nominal_voltage_V / *R;
    hint = "; the printed stall current, " + rounded(stall.value) + " A, " +
           fitting_frame({per_terminal, per_terminal / 2.0}, *q, stall);
    if (fits(2.0 * per_terminal, *q, stall)) hint += ", which is U divided by half of the resistance";
  }
  const std::array<FrameMeaning, 2> candidates = {{{"terminal", means(*R / 2.0)}, {"phase", means(*R)}}};
  unknown_frame(reader, "resistance_ohm", *q, candidates, hint);
}

/// This model has no saliency: if L_d and L_q differ, it uses their mean.
void read_axes(SheetReader& reader) {
  const std::optional<Quantity>&d = reader.sheet.d_axis_inductance_mH, &q = reader.sheet.q_axis_inductance_mH;
  if (!d || !q)
    return reader.wrong(d ? "d_axis_inductance_mH" : "q_axis_inductance_mH", d ? *d : *q,
                        std::string("needs ") + (d ? "q" : "d") + "_axis_inductance_mH as well",
                        "give both axis inductances, or only inductance_mH");
  const std::optional<double> L_d = SheetReader::positive(*d, -3), L_q = SheetReader::positive(*q, -3);
  if (!L_d || !L_q) return;
  if (*L_d != *L_q) {
    reader.out.L_H = Constant{(*L_d + *L_q) / 2.0, "L_d and L_q, phase: their mean; a run uses both"};
  } else {
    reader.out.L_H = Constant{*L_d, "L_d = L_q, phase: as it is"};
  }
  reader.use("d_axis_inductance_mH");
  reader.use("q_axis_inductance_mH");
}

void read_inductance(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  const std::optional<Quantity>& q = s.inductance_mH;
  if (q && (s.d_axis_inductance_mH || s.q_axis_inductance_mH))
    return reader.wrong("inductance_mH", *q, "is given twice: L_d and L_q are also given",
                        "remove inductance_mH, or both axis inductances");
  if (s.d_axis_inductance_mH || s.q_axis_inductance_mH) return read_axes(reader);
  if (!q)
    return reader.missing(
        "inductance_mH",
        "give the winding's inductance with its frame; if the sheet gives no inductance, measure the inductance between two terminals with an LCR meter at 1 kHz");
  const std::optional<double> L = SheetReader::positive(*q, -3);
  if (!L) return;
  if (q->frame == "terminal" || q->frame == "phase") {
    reader.out.L_H = Constant{per_phase(*L, q->frame), from_frame("inductance_mH", *q)};
    return reader.use("inductance_mH");
  }
  const auto means = [&](double L_s) {
    std::string text = "L_s = " + rounded(L_s * 1e3) + " mH";
    if (reader.out.R_ohm)
      text += ", time constant L/R = " + rounded(L_s / reader.out.R_ohm->value * 1e3, 3) + " ms";
    return text;
  };
  const std::array<FrameMeaning, 2> candidates = {{{"terminal", means(*L / 2.0)}, {"phase", means(*L)}}};
  std::string hint;
  if (reader.sheet.electrical_time_constant_ms && reader.out.R_ohm) {
    const Quantity& printed = *reader.sheet.electrical_time_constant_ms;
    const double ms = *L / reader.out.R_ohm->value * 1e3;
    hint = "; the printed electrical time constant, " + rounded(printed.value) + " ms, " +
           fitting_frame({ms / 2.0, ms}, *q, printed);
  }
  unknown_frame(reader, "inductance_mH", *q, candidates, hint);
}

/// Reads the nominal current's frame. The current is not part of the model; the comparison with the nominal
/// torque requires its frame.
void read_nominal_current(SheetReader& reader) {
  const std::optional<Quantity>& q = reader.sheet.nominal_current_A;
  const SheetConstants& c = reader.out;
  if (!q || !SheetReader::positive(*q) || q->frame == "terminal" || q->frame == "rms") return;
  const auto torque = [&](double K) {
    return c.K_e_V_s ? ", a nominal torque of " + rounded(K * q->value * 1e3) + " mNm" : std::string();
  };
  const std::string amperes = rounded(q->value) + " A";
  const std::array<FrameMeaning, 2> candidates = {
      {{"terminal", amperes + " of direct current in at one terminal and out at another" +
                        torque(c.K_t_Nm_A ? c.K_t_Nm_A->value : 0.0)},
       {"rms", "a sine of " + amperes + " rms in each phase, " + rounded(std::sqrt(2.0) * q->value) +
                   " A peak" + torque(c.K_e_V_s ? torque_per_rms_A(c.K_e_V_s->value, c.shape) : 0.0)}}};
  unknown_frame(reader, "nominal_current_A", *q, candidates);
}

/// Reads the shape. If its values are wrong, the error is reported and the factors of a valid shape are
/// returned, so that the other values can be read.
ShapeFactors read_shape(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  const bool flat = base::strictly_between(0.0, 180.0).holds(s.flat_deg);
  if (!flat)
    reader.problem("flat_deg", base::written(s.flat_deg), "must lie between 0 and 180",
                   "give the flat top's width in electrical degrees, usually 120");
  if (s.back_emf == BackEmfShape::table)
    return read_shape_table(reader).value_or(shape_factors(BackEmfShape::sine, 120.0));
  if (!s.harmonic_orders.empty() && s.harmonic_orders.size() == s.harmonic_sizes.size())
    return harmonic_factors(s.harmonic_orders, s.harmonic_sizes);
  return shape_factors(s.back_emf, flat ? s.flat_deg : 120.0);
}

void read_trust(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  if (!s.simulatable && s.not_simulatable_because.empty())
    reader.problem("simulatable", "false", "gives no reason", "give the reason in not_simulatable_because");
  if (s.simulatable && !s.not_simulatable_because.empty())
    reader.problem("not_simulatable_because", "\"" + s.not_simulatable_because + "\"",
                   "contradicts simulatable = true",
                   "write simulatable = false, or remove not_simulatable_because");
}

}  // namespace

double relative_doubt(const Quantity& q) {
  if (!(q.value > 0.0)) return 0.0;
  double digit = q.last_digit.value_or(base::last_digit_of(q.value));
  // 1690 may be a number of three digits with a zero as place holder. 780 has three digits only with its
  // zero.
  const auto whole = [&](double unit) { return std::floor(q.value / unit) * unit == q.value; };
  while (digit >= 1.0 && digit * 1e3 <= q.value && whole(digit * 10.0)) digit *= 10.0;
  return 0.5 * digit / q.value;
}

SheetConstants sheet_constants(const Sheet& sheet) {
  SheetConstants out;
  out.used.reserve(12);
  SheetReader reader{sheet, out};
  read_trust(reader);
  note_implausible(reader);
  out.shape = read_shape(reader);
  const std::size_t told = out.problems.size();
  out.pole_pitch_m = read_pole_pitch(reader);
  out.pole_pairs = read_pole_pairs(reader);
  const bool turns = sheet.kind == MotorKind::rotary;
  if (turns && !out.pole_pairs && out.problems.size() == told)
    reader.missing("pole_pairs", "give pole_pairs, poles or the winding's code as \"12N14P\"");
  read_details(reader);
  if (sheet.nominal_voltage_V) out.nominal_voltage_V = SheetReader::positive(*sheet.nominal_voltage_V);
  read_resistance(reader);
  read_inductance(reader);
  read_torque_constant(reader);
  read_inertia(reader);
  read_friction(reader);
  read_nominal_current(reader);
  return out;
}

Sheet in_standard_keys(Sheet s) {
  const bool all_there = s.inductance_mH && (s.torque_constant_mNm_A || s.back_emf_mV_s) &&
                         s.viscous_friction_Nm_s && s.inertia_gcm2 && !s.with_brake;
  if (all_there) return s;
  const SheetConstants c = sheet_constants(s);
  const auto fill = [](std::optional<Quantity>& key, const std::optional<Constant>& constant, double value,
                       const char* frame) {
    if (key || !constant) return;
    key.emplace();
    key->value = value;
    key->frame = frame;
    key->source = "from " + constant->from;
    key->kind = base::Trust::derived;
  };
  const bool salient = is_salient(s);
  if (c.L_H && !salient) fill(s.inductance_mH, c.L_H, c.L_H->value * 1e3, "phase");
  if (c.L_H && !salient) s.d_axis_inductance_mH = s.q_axis_inductance_mH = std::nullopt;
  if (c.K_t_Nm_A && !s.back_emf_mV_s)
    fill(s.torque_constant_mNm_A, c.K_t_Nm_A, c.K_t_Nm_A->value * 1e3, "terminal");
  if (c.J_kg_m2 && s.with_brake && s.inertia_with_brake_gcm2) {
    s.inertia_gcm2 = s.inertia_with_brake_gcm2;
    s.inertia_gcm2->key.clear();
    s.inertia_with_brake_gcm2.reset();
    s.with_brake = false;
  }
  if (c.J_kg_m2) fill(s.inertia_gcm2, c.J_kg_m2, c.J_kg_m2->value * 1e7, "");
  if (!s.viscous_friction_Nm_s) {  // the iron's part stays in its own keys
    const Friction& f = c.friction;
    const Constant B{f.B_Nm_s - f.iron.B_Nm_s, f.from};
    fill(s.viscous_friction_Nm_s, B, B.value, "");
    if (f.coulomb_Nm > f.iron.coulomb_Nm && !s.coulomb_friction_mNm)
      fill(s.coulomb_friction_mNm, B, (f.coulomb_Nm - f.iron.coulomb_Nm) * 1e3, "");
  }
  return s;
}

}  // namespace sixstep::design
