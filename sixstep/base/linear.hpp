// SPDX-License-Identifier: Apache-2.0
// Words and units of linear motors. A linear motor has the equations of a rotary motor (model.md 7). Speed v
// replaces w, mass m replaces J, force F replaces T, and pi/(pole pitch) replaces the pole pairs p. The
// library computes with the rotary motor's symbols, where 1 rad means 1 m; files and results use metres. Only
// this file contains the table of corresponding words and units.
#pragma once
#include <string>
#include <string_view>
#include <utility>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/describe.hpp"

namespace sixstep::base {

/// A unit of rotary motors, the unit that replaces it for linear motors, and the number of linear units in
/// one rotary unit.
struct LinearUnit {
  std::string_view turning, linear;
  double factor = 1.0;
};

inline constexpr LinearUnit linear_units[] = {
    {"rad", "m"},
    {"rad/s", "m/s"},
    {"rad/s2", "m/s2"},
    {"rad/s3", "m/s3"},
    {"deg", "mm", 1e3 * pi / 180},
    {"rpm", "m/s", pi / 30},
    {"N m", "N"},
    {"Nm", "N"},
    {"mNm", "N", 1e-3},
    {"Nm/A", "N/A"},
    {"N m/A", "N/A"},
    {"mNm/A", "N/A", 1e-3},
    {"kg m2", "kg"},
    {"g cm2", "kg", 1e-7},
    {"g cm²", "kg", 1e-7},
    {"N m s", "N s/m"},
    {"Nm s", "N s/m"},
    {"V s", "V s/m"},
    {"mV s", "V s/m", 1e-3},
    {"rad/s/deg", "m/s/mm", 0.18 / pi},
    {"rad/s per deg", "m/s per mm", 0.18 / pi},
    {"rpm/mNm", "m/s/N", 1e3 * pi / 30},
};

/// The row of a rotary unit; a unit that both kinds of motor share maps to itself.
constexpr LinearUnit in_linear(std::string_view unit) {
  for (const LinearUnit& row : linear_units)
    if (row.turning == unit) return row;
  return {unit, unit, 1.0};
}

/// A word or a unit in a text about a rotary motor, and its replacement for a linear motor.
struct LinearWord {
  std::string_view turning, linear;
};

inline constexpr LinearWord linear_word_table[] = {
    {"gear and elastic shaft", "elastic coupling"},
    {"just turning", "just moving"},
    {"turn the rotor", "move the slide"},
    {"rad/s or deg", "m/s or mm"},
    {"in deg, counted over turns", "in mm"},
    {"per degree of position error", "per mm of position error"},
    {"back-EMF per 1000 rpm", "back-EMF per speed"},
    {"rotor and shaft", "slide"},
    {"Rotor inertia J", "Mass m"},
    {"K<sub>t</sub>", "K<sub>f</sub>"},
    {"moment of inertia", "mass"},
    {"inertia", "mass"},
    {"Inertia", "Mass"},
    {"J doubled", "mass doubled"},
    {"torque", "force"},
    {"Torque", "Force"},
    {"angle", "position"},
    {"shaft", "slide"},
    {"Shaft", "Slide"},
    {"rotor", "slide"},
    {"Rotor", "Slide"},
    {"K_t", "K_f"},
    {"K\u209c", "K_f"},
};

/// Units in prose and in keys. A unit is replaced only if no letter precedes or follows it.
inline constexpr LinearWord linear_unit_words[] = {
    {"rad/s", "m/s"}, {"rad_s", "m_s"},  {"kg m2", "kg"}, {"kg_m2", "kg"},  {"N m/A", "N/A"}, {"Nm/A", "N/A"},
    {"Nm_A", "N_A"},  {"Nm_s", "N_s_m"}, {"Nm", "N"},     {"V_s", "V_s_m"}, {"N m", "N"},
};

namespace linear_text {

constexpr bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

inline void replace(std::string& text, const LinearWord& word, bool whole) {
  for (std::size_t at = text.find(word.turning); at != text.npos; at = text.find(word.turning, at)) {
    const std::size_t end = at + word.turning.size();
    const bool within = (at > 0 && letter(text[at - 1])) || (end < text.size() && letter(text[end]));
    if (whole && within) {
      at = end;
      continue;
    }
    text.replace(at, word.turning.size(), word.linear);
    at += word.linear.size();
  }
}

}  // namespace linear_text

/// Replaces a rotary motor's words in a text or a name by a linear motor's words. Torque becomes force,
/// inertia becomes mass, angle becomes position. Numbers are not converted: a text with a number in degrees,
/// turns or thousandths needs its own version for linear motors.
inline std::string linear_words(std::string text) {
  for (const LinearWord& word : linear_word_table) linear_text::replace(text, word, false);
  for (const LinearWord& unit : linear_unit_words) linear_text::replace(text, unit, true);
  return text;
}

/// Chooses the words and units of results: unchanged for a rotary motor, converted for a linear motor.
struct Motion {
  bool linear = false;

  constexpr LinearUnit unit(std::string_view turning) const {
    return linear ? in_linear(turning) : LinearUnit{turning, turning, 1.0};
  }
  std::string words(std::string text) const { return linear ? linear_words(std::move(text)) : text; }
};

/// Converts a number that is written with another spelling to the key's unit; as_spelled() converts back.
inline double in_own_unit(double written, const Spelling& s) {
  return times_ten_to(written, s.ten) * s.factor;
}
inline double as_spelled(double own, const Spelling& s) { return times_ten_to(own / s.factor, -s.ten); }

/// The spelling that a linear motor's file uses; null if the key is the same for both kinds of motor.
inline const Spelling* linear_spelling(const About& about) {
  for (const Spelling& s : about.also)
    if (s.linear) return &s;
  return nullptr;
}

/// The word for a value in files of this kind of motor; empty if no choice has this value.
template <class Choices, class Enum>
constexpr std::string_view word_in(const Motion& motion, const Choices& choices, Enum value) {
  const std::string_view turning = word(choices, value);
  for (const auto& choice : choices)
    if (motion.linear && !choice.turning.empty() && choice.turning == turning) return choice.word;
  return turning;
}

}  // namespace sixstep::base
