// SPDX-License-Identifier: Apache-2.0
// Reads the data of a sheet's winding other than R, L and K_t: harmonics, delta, unequal phases, cogging.
#include <cmath>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/design/sheet/sheet_reader.hpp"
#include "sixstep/design/sheet/winding_description.hpp"

namespace sixstep::design {
namespace {

bool is_whole(double x) { return std::floor(x) == x; }

/// Bounds with which the rotations, including the rotations of the sine and a salient rotor, fit in the
/// general kernel (plant/general/constants.hpp).
constexpr std::size_t most_harmonics = 5, most_cogging = 4;

void read_harmonics(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  if (s.harmonic_orders.size() != s.harmonic_sizes.size())
    reader.problem(
        "harmonic_sizes", std::to_string(s.harmonic_sizes.size()) + " values",
        "needs one value for each of the " + std::to_string(s.harmonic_orders.size()) + " harmonic_orders",
        "write harmonic_orders = [3, 5] and harmonic_sizes = [0.12, -0.05]");
  if (s.harmonic_orders.empty()) return;
  if (s.back_emf != BackEmfShape::sine)
    reader.problem("harmonic_orders", "",
                   s.back_emf == BackEmfShape::table ? "apply to a sine only, and back_emf is \"table\""
                                                     : "apply to a sine only, and back_emf is \"trapezoid\"",
                   "write back_emf = \"sine\"");
  if (s.harmonic_orders.size() > most_harmonics)
    reader.problem("harmonic_orders", std::to_string(s.harmonic_orders.size()) + " values",
                   "must be at most " + std::to_string(most_harmonics), "keep the largest");
  for (const double order : s.harmonic_orders)
    if (!is_whole(order) || std::fmod(order, 2.0) != 1.0 || order < 3 || order > highest_order) {
      reader.problem("harmonic_orders", base::written(order), "must be an odd number from 3 to 23",
                     "give odd orders from 3 to 23; equal north and south poles cause no even orders");
      return;
    }
}

/// Reports lists of a table if the shape is not a table.
void read_table_keys(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  if (s.back_emf == BackEmfShape::table) return;  // read_shape_table() checks them
  const char* key = !s.back_emf_file.empty()        ? "back_emf_file"
                    : !s.back_emf_angle_deg.empty() ? "back_emf_angle_deg"
                    : !s.back_emf_shape.empty()     ? "back_emf_shape"
                                                    : nullptr;
  if (key) reader.problem(key, "", "applies to back_emf = \"table\" only", "write back_emf = \"table\"");
}

void read_deviations(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  const auto look = [&](const char* key, const std::vector<double>& values) {
    if (values.empty()) return;
    if (values.size() != 3)
      reader.problem(key, std::to_string(values.size()) + " values",
                     "needs one value for each of the phases a, b, c",
                     std::string("write ") + key + " = [0.05, -0.03, 0]");
    if (s.connection == WindingConnection::delta)
      reader.problem(key, "", "applies to a star's phases only, and connection is \"delta\"",
                     "remove this key");
  };
  look("phase_resistance_deviation", s.phase_resistance_deviation);
  look("phase_back_emf_deviation", s.phase_back_emf_deviation);
}

void read_delta(SheetReader& reader) {
  const Sheet& s = reader.sheet;
  if (s.connection == WindingConnection::star) {
    if (s.mutual_inductance_mH != 0)
      reader.problem(
          "mutual_inductance_mH", base::written(s.mutual_inductance_mH),
          "applies to a delta's branches only; inductance_mH of a star includes the mutual inductance",
          "remove this key");
    return;
  }
  const auto look = [&](const char* key, const std::optional<base::Quantity>& q, const char* cure) {
    if (q && q->frame == "phase")
      reader.wrong(key, *q, "is given for a phase, and a delta needs the value between two terminals", cure);
  };
  constexpr const char* winding_cure =
      "write frame = \"terminal\". If a drive identified the value (VESC, ODrive), write twice the value; if the value is of one branch of the delta, write 2/3 of the value";
  look("resistance_ohm", s.resistance_ohm, winding_cure);
  look("inductance_mH", s.inductance_mH, winding_cure);
  look("back_emf_mV_s", s.back_emf_mV_s,
       "give back_emf_constant_V_krpm with frame = \"line-peak\": a branch of the delta lies between two "
       "terminals, and 1 mV s is 0.10472 V/krpm");
  if (s.d_axis_inductance_mH || s.q_axis_inductance_mH)
    reader.problem("d_axis_inductance_mH", "", "applies to a star's phases only, and connection is \"delta\"",
                   "give inductance_mH between two terminals");
  if (s.saturation_current_A)
    reader.wrong("saturation_current_A", *s.saturation_current_A,
                 "applies to a star's phases only, and connection is \"delta\"", "remove this key");
}

void read_cogging(SheetReader& reader, std::optional<int> pole_pairs) {
  const Sheet& s = reader.sheet;
  const std::string count = std::to_string(s.cogging_orders.size());
  if (s.cogging_mNm.size() != s.cogging_orders.size())
    reader.problem("cogging_mNm", std::to_string(s.cogging_mNm.size()) + " values",
                   "needs one value for each of the " + count + " cogging_orders",
                   "write cogging_orders = [48] and cogging_mNm = [8]");
  if (!s.cogging_phase_deg.empty() && s.cogging_phase_deg.size() != s.cogging_orders.size())
    reader.problem("cogging_phase_deg", std::to_string(s.cogging_phase_deg.size()) + " values",
                   "needs one value for each of the " + count + " cogging_orders",
                   "give one phase for each order, or remove this key: the default is 0");
  if (s.cogging_orders.size() > most_cogging)
    reader.problem("cogging_orders", count + " values", "must be at most " + std::to_string(most_cogging),
                   "keep the largest");
  for (const double order : s.cogging_orders)
    if (s.kind == MotorKind::linear && (!is_whole(order) || std::fmod(order, 2.0) != 0.0)) {
      reader.problem(
          "cogging_orders", base::written(order), "must be an even number of periods per two pole pitches",
          "give an even number: the cogging force repeats at every pole, so that two pole pitches contain an even number of periods");
      return;
    } else if (!is_whole(order) || (pole_pairs && std::fmod(order, 2.0 * *pole_pairs) != 0.0)) {
      reader.problem("cogging_orders", base::written(order),
                     "must be a multiple of the number of poles" +
                         (pole_pairs ? ", " + std::to_string(2 * *pole_pairs) : std::string()),
                     "give the least common multiple of slots and poles, or a multiple of this number");
      return;
    }
}

}  // namespace

bool is_salient(const Sheet& s) {
  return s.d_axis_inductance_mH && s.q_axis_inductance_mH && !s.inductance_mH &&
         s.d_axis_inductance_mH->value != s.q_axis_inductance_mH->value;
}

std::string left_to_a_run(const Sheet& s) {
  std::vector<std::string> parts;
  if (s.back_emf == BackEmfShape::table) parts.push_back("the back-EMF as a table");
  if (!s.harmonic_orders.empty()) parts.push_back("the harmonics of the back-EMF");
  if (s.connection == WindingConnection::delta) parts.push_back("the loop current of the delta");
  if (is_salient(s)) parts.push_back("the saliency of the rotor");
  if (s.saturation_current_A) parts.push_back("the saturation along the magnets");
  if (!s.phase_resistance_deviation.empty() || !s.phase_back_emf_deviation.empty())
    parts.push_back("unequal phases");
  if (!s.cogging_orders.empty()) parts.push_back("cogging");
  std::string text;
  for (std::size_t n = 0; n < parts.size(); ++n)
    text += (n == 0 ? "" : n + 1 == parts.size() ? " and " : ", ") + parts[n];
  return text;
}

void read_details(SheetReader& reader) {
  if (reader.sheet.saturation_current_A) reader.use("saturation_current_A");
  read_harmonics(reader);
  read_table_keys(reader);
  read_deviations(reader);
  read_delta(reader);
  read_cogging(reader, reader.out.pole_pairs);
}

}  // namespace sixstep::design
