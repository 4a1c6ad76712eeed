// SPDX-License-Identifier: Apache-2.0
// Reads the torque constant in all its printed forms, and computes the peak back-EMF K_e of a phase from each
// form. For a sine the factors are in the table of constants of model.md 1; for a trapezoid they follow from
// its shape.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/design/sheet/sheet_reader.hpp"
#include "sixstep/design/sheet/winding_description.hpp"

namespace sixstep::design {
namespace {

using base::Quantity;

struct Constants {
  double K_e_V_s = 0.0;
  double K_t_Nm_A = 0.0;
};

constexpr int milli = -3;

/// One printed form: its possible frames (if there is only one, the file may omit it), and its conversion.
struct Way {
  std::string_view key;
  const std::optional<Quantity> Sheet::*member;
  std::array<std::string_view, 5> frames;  // unused elements are empty, at the end
  Constants (*read)(double value, std::string_view frame, const ShapeFactors& f, double pole_pairs);
};

Constants by_K_t(double K_t, const ShapeFactors& f) { return {K_t / f.sector_mean, K_t}; }
Constants by_K_e(double K_e, const ShapeFactors& f) { return {K_e, K_e * f.sector_mean}; }

/// Torque constants in N m/A. A q-axis current of peak I causes the torque (3/2) K_e1 I, with the
/// fundamental's peak K_e1; rms is peak/sqrt 2.
Constants by_torque(double value, std::string_view frame, const ShapeFactors& f, double) {
  if (frame == "terminal") return by_K_t(value, f);
  const double peak = frame == "rms" ? value / std::sqrt(2.0) : value;
  return by_K_e(2.0 * peak / (3.0 * f.fundamental), f);
}

/// Back-EMF constants in V/krpm; 1000 rpm are 104.72 rad/s. Six-step: the mean voltage of the driven pair
/// over a sector. In V s it equals K_t in N m/A.
Constants by_volts(double value, std::string_view frame, const ShapeFactors& f, double) {
  const double V_s = value / (1000.0 * base::pi / 30.0);
  if (frame == "six-step") return by_K_t(V_s, f);
  const double factor = frame == "line-peak"   ? f.line_peak
                        : frame == "line-rms"  ? f.line_rms
                        : frame == "phase-rms" ? f.phase_rms
                                               : f.phase_peak;
  return by_K_e(V_s / factor, f);
}

/// Speed constants in rpm/V. Six-step: the mean voltage of the driven pair, K_t = 9.5493/KV. Line-peak: the
/// peak voltage between terminals.
Constants by_speed(double value, std::string_view frame, const ShapeFactors& f, double) {
  const double V_s = 30.0 / base::pi / value;
  return frame == "six-step" ? by_K_t(V_s, f) : by_K_e(V_s / f.line_peak, f);
}

constexpr Way ways[] = {
    {"torque_constant_mNm_A",
     &Sheet::torque_constant_mNm_A,
     {"terminal"},
     [](double v, std::string_view, const ShapeFactors& f, double) {
       return by_K_t(base::times_ten_to(v, milli), f);
     }},
    {"back_emf_mV_s",
     &Sheet::back_emf_mV_s,
     {"phase"},
     [](double v, std::string_view, const ShapeFactors& f, double) {
       return by_K_e(base::times_ten_to(v, milli), f);
     }},
    {"torque_constant_Nm_A", &Sheet::torque_constant_Nm_A, {"terminal", "peak", "rms"}, by_torque},
    {"back_emf_constant_V_krpm",
     &Sheet::back_emf_constant_V_krpm,
     {"line-peak", "line-rms", "phase-peak", "phase-rms", "six-step"},
     by_volts},
    {"flux_linkage_mWb",
     &Sheet::flux_linkage_mWb,
     {"phase"},
     [](double v, std::string_view, const ShapeFactors& f, double p) {
       return by_K_e(p * base::times_ten_to(v, milli) / f.fundamental, f);
     }},
    {"speed_constant_rpm_V", &Sheet::speed_constant_rpm_V, {"six-step", "line-peak"}, by_speed},
};

/// The frame of a value; empty if it is missing or wrong, which is reported.
std::optional<std::string_view> frame_of(SheetReader& reader, const Way& way, const Quantity& q,
                                         double pole_pairs) {
  if (way.frames[1].empty()) {
    if (q.frame.empty() || q.frame == way.frames[0]) return way.frames[0];
    reader.problem(SheetReader::key_of(way.key, q), "frame \"" + q.frame + "\"",
                   "must be \"" + std::string(way.frames[0]) + "\", the only frame of this key",
                   "convert the value and write frame = \"" + std::string(way.frames[0]) + "\"");
    return {};
  }
  if (!q.frame.empty() && std::find(way.frames.begin(), way.frames.end(), q.frame) != way.frames.end())
    return q.frame;
  std::vector<FrameMeaning> candidates;
  for (const std::string_view frame : way.frames)
    if (!frame.empty()) {
      const Constants c = way.read(q.value, frame, reader.out.shape, pole_pairs);
      candidates.push_back({frame, "a terminal torque constant of " + rounded(c.K_t_Nm_A * 1e3) + " mNm/A"});
    }
  unknown_frame(reader, way.key, q, candidates);
  return {};
}

struct Read {
  std::string_view key;
  Constants constants;
  double doubt = 0.0;
  std::string from;
};

/// K_t = 2 B l r N (thesis 1.1): N turns in series have 2 N conductors; the force B l i acts on each at the
/// radius r.
void read_geometry(SheetReader& reader, std::vector<Read>& reads) {
  const Sheet& s = reader.sheet;
  const std::pair<std::string_view, const std::optional<Quantity>*> parts[] = {
      {"flux_density_T", &s.flux_density_T},
      {"active_length_mm", &s.active_length_mm},
      {"air_gap_radius_mm", &s.air_gap_radius_mm}};
  double product = 2.0, doubt = 0.0;
  std::size_t given = s.turns_in_series ? 1 : 0;
  std::string absent = s.turns_in_series ? "" : "turns_in_series";
  for (const auto& [key, q] : parts) {
    if (!*q) {
      absent += (absent.empty() ? "" : ", ") + std::string(key);
      continue;
    }
    ++given;
    const std::optional<double> value = SheetReader::positive(**q, key == "flux_density_T" ? 0 : milli);
    if (!value) return;
    product *= *value;
    doubt += relative_doubt(**q);
  }
  if (given == 0) return;
  if (given < 4)
    return reader.problem(s.flux_density_T     ? "flux_density_T"
                          : s.turns_in_series  ? "turns_in_series"
                          : s.active_length_mm ? "active_length_mm"
                                               : "air_gap_radius_mm",
                          "", "needs " + absent + " beside it",
                          "give all four values of K_t = 2 B l r N, or none");
  if (*s.turns_in_series < 1 || *s.turns_in_series > most_turns)
    return reader.problem(
        "turns_in_series", std::to_string(*s.turns_in_series),
        *s.turns_in_series < 1 ? "must be at least 1" : "must be at most " + std::to_string(most_turns),
        "give turns_in_series, the turns between two terminals");
  reads.push_back({"flux_density_T", by_K_t(product * *s.turns_in_series, reader.out.shape), doubt,
                   "K_t = 2 B l r N of the geometry"});
}

std::vector<Read> read_all(SheetReader& reader) {
  std::vector<Read> reads;
  for (const Way& way : ways) {
    const std::optional<Quantity>& q = reader.sheet.*way.member;
    if (!q || !SheetReader::positive(*q)) continue;
    const bool by_flux = way.key == "flux_linkage_mWb";
    const std::optional<double> pairs = reader.out.electrical_per_mechanical();
    if (by_flux && !pairs) continue;
    const double p = pairs.value_or(1.0);
    const std::optional<std::string_view> frame = frame_of(reader, way, *q, p);
    if (!frame) continue;
    reads.push_back({way.key, way.read(q->value, *frame, reader.out.shape, p), relative_doubt(*q),
                     SheetReader::key_of(way.key, *q) + ", " + std::string(*frame)});
  }
  read_geometry(reader, reads);
  return reads;
}

}  // namespace

void read_torque_constant(SheetReader& reader) {
  const std::size_t told = reader.out.problems.size();
  std::vector<Read> reads = read_all(reader);
  if (reads.empty()) {
    if (reader.out.problems.size() == told)
      reader.missing(
          "torque_constant_mNm_A",
          "give torque_constant_mNm_A (torque per ampere through the driven pair), or the constant that the sheet prints instead: torque_constant_Nm_A, back_emf_constant_V_krpm, flux_linkage_mWb, "
          "speed_constant_rpm_V (KV) or back_emf_mV_s (a phase's peak)");
    return;
  }
  const Read& first = reads.front();
  Constants c = first.constants;
  std::size_t used = 1;
  // The torque constant between terminals and the back-EMF of a phase are the same fact, and both are used
  // unchanged: they must agree.
  if (first.key == "torque_constant_mNm_A" && reads.size() > 1 && reads[1].key == "back_emf_mV_s") {
    const double implied = c.K_e_V_s;
    c.K_e_V_s = reads[1].constants.K_e_V_s;
    if (std::abs(c.K_e_V_s - implied) > 1e-6 * implied)
      reader.wrong("back_emf_mV_s", *reader.sheet.back_emf_mV_s,
                   "contradicts torque_constant_mNm_A, which means " + base::six_digits(implied * 1e3),
                   "remove one of the two keys");
    reader.use("back_emf_mV_s");
    used = 2;
  }
  reader.use(first.key);
  reader.out.K_e_V_s = Constant{c.K_e_V_s, first.from};
  reader.out.K_t_Nm_A = Constant{c.K_t_Nm_A, first.from};
  reader.out.K_e_relative_doubt = first.doubt;
  for (std::size_t n = used; n < reads.size(); ++n)
    reader.out.other_ways.push_back({std::string(reads[n].key), reads[n].constants.K_e_V_s, reads[n].doubt});
}

}  // namespace sixstep::design
