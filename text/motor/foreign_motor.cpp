// SPDX-License-Identifier: Apache-2.0
#include "text/motor/foreign_motor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>

#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "text/escape/escape.hpp"
#include "text/keys/bounded.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/keys/template_line.hpp"
#include "text/motor/foreign_keys.hpp"
#include "text/motor/foreign_lines.hpp"
#include "text/motor/foreign_words.hpp"

namespace text {
namespace {

base::Result<ForeignWords> foreign_words(ForeignKind kind, std::string_view text) {
  switch (kind) {
    case ForeignKind::vesc:
      return words_of_xml(text);
    case ForeignKind::odrive:
      return words_of_json(text);
    case ForeignKind::moteus:
      return words_of_lines(text);
    case ForeignKind::simple_foc:
      return words_of_sketch(text);
    default:
      return words_of_matlab(text);
  }
}

class ForeignMotor {
 public:
  ForeignMotor(std::string file, const ForeignTool& tool, ForeignWords words,
               const std::vector<std::string>& answers)
      : file_(std::move(file)), tool_(tool), words_(std::move(words)), answers_(answers) {}

  base::Result<std::string> text(const std::string& name) {
    choose_part();
    add_poles();
    add_keys({"resistance_ohm"}, "resistance_ohm");
    add_inductances();
    add_keys({"flux_linkage_mWb", "torque_constant_Nm_A", "speed_constant_rpm_V", "back_emf_constant_V_krpm"},
             "flux_linkage_mWb");
    if (find("motor.v_per_hz") && !find("motor.Kv"))
      body_ += wrapped_comment(
          "motor.v_per_hz is of a firmware before 0x010a, and is not taken over: give the motor's Kv");
    add_keys({"inertia_kgm2"}, "inertia_kgm2");
    add_keys({"viscous_friction_Nm_s", "nominal_current_A", "max_speed_rpm"}, "");
    check_time_constant();
    for (const std::string& answer : answers_)
      if (std::find(asked_.begin(), asked_.end(), answer.substr(0, answer.find('='))) == asked_.end())
        problems_.push_back(bounded({.where = "answer",
                                     .value = answer,
                                     .limit = fmt::format("names no question about {}", file_),
                                     .cure = "leave this answer out"}));
    if (problems_.empty() && taken_ == 0)
      tell(0,
           fmt::format("contains no known value of a motor: the values of {} are {}", tool_.name,
                       known_words()),
           "name the file that the program saved");
    if (!problems_.empty()) return problems_;
    return head(name) + body_;
  }

 private:
  const ForeignWord* find(std::string_view word) const {
    // If a key is assigned several times, the last assignment counts, as in the other program.
    const ForeignWord* found = nullptr;
    for (const ForeignWord& w : words_)
      if (!word.empty() && w.name == word && (!part_ || w.part == *part_)) found = &w;
    return found;
  }

  void tell(std::size_t line, std::string limit, std::string cure) {
    problems_.push_back(bounded({.where = line == 0 ? file_ : fmt::format("{}:{}:", file_, line),
                                 .value = {},
                                 .limit = std::move(limit),
                                 .cure = std::move(cure)}));
  }

  std::optional<std::string> answer_to(std::string_view question) {
    asked_.emplace_back(question);
    for (const std::string& answer : answers_)
      if (answer.starts_with(question) && answer.substr(question.size()).starts_with('='))
        return answer.substr(question.size() + 1);
    return {};
  }

  /// Selects one motor of a file with several motors.
  void choose_part() {
    std::vector<std::string> parts;
    // A part is a motor if it has poles, resistance or flux. A rated current is no sign, because a bridge may
    // have one too.
    const std::span<const ForeignKey> marks = tool_.keys.first(3);
    for (const ForeignWord& w : words_) {
      const bool of_a_motor =
          std::any_of(marks.begin(), marks.end(), [&w](const ForeignKey& row) { return row.word == w.name; });
      if (of_a_motor && std::find(parts.begin(), parts.end(), w.part) == parts.end()) parts.push_back(w.part);
    }
    if (parts.size() == 1) part_ = parts.front();
    if (parts.size() < 2) return;
    const std::optional<std::string> answer = answer_to("motor");
    part_ = answer.value_or("");
    if (std::find(parts.begin(), parts.end(), *part_) != parts.end()) return;
    tell(0, fmt::format("has {} motors", parts.size()),
         fmt::format("answer motor={}", fmt::join(parts, " or motor=")));
    words_.clear();
  }

  /// The number of a word. Empty if the file lacks the word or has 0, the value of a drive before its
  /// identification.
  std::optional<double> number(const ForeignWord* word) {
    if (word == nullptr) return {};
    const std::optional<double> x = foreign_number(word->value);
    if (x == 0.0) return {};
    const bool formula = !x && tool_.kind == ForeignKind::matlab;
    if (x && *x > 0.0) return x;
    if (formula && word->value.find_first_of("(*+") != std::string::npos) {
      body_ += wrapped_comment(fmt::format("{}: {} is a formula, which is not read: {}", tool_.name,
                                           word->name, bounded(visible(word->value), 100)));
      return {};
    }
    tell(word->line, fmt::format("{} = {} must be a number above 0", word->name, bounded(word->value, 100)),
         "correct this value in the file");
    return {};
  }

  bool in_range(const ForeignWord& word, std::string_view key, double x) {
    const KeyEntry entry = foreign_entry(key);
    const base::Range range = base::allowed(entry.about);
    const bool whole = entry.type != KeyType::whole_number || x == std::floor(x);
    if (range.holds(x) && whole) return true;
    tell(word.line,
         fmt::format("{} = {} becomes {} = {}, which {}", word.name, bounded(word.value, 100), key,
                     base::six_digits(x),
                     whole ? base::limit_of(entry.about.range, range, x) : "must be a whole number"),
         "correct the number in the file; the program that wrote the file determines its unit");
    return false;
  }

  std::string source(std::string_view what) const {
    const std::string part = part_.value_or("");
    return toml_text(fmt::format("{}: {}{}{}", tool_.name, part, part.empty() ? "" : ".", what));
  }

  std::string quantity(std::string_view key, double x, std::string_view frame, std::string_view what) const {
    return foreign_line(key, x, frame, source(what));
  }

  void add_missing(std::string_view key) { body_ += missing_line(key, file_); }

  void add_poles() {
    for (const ForeignKey& row : tool_.keys) {
      if (row.key != "poles" && row.key != "pole_pairs") continue;
      const ForeignWord* const word = find(row.word);
      const std::optional<double> x = number(word);
      if (!x || !in_range(*word, row.key, *x)) continue;
      const double pairs = row.key == "poles" ? *x / 2 : *x;
      if (pairs != std::floor(pairs)) {
        tell(word->line, fmt::format("{} = {} is an odd number of poles", word->name, ten_digits(*x)),
             "give the number of poles, which is even");
        continue;
      }
      pairs_ = checked_by_encoder(*word, pairs);
      body_ += fmt::format("pole_pairs = {}  # {}: {} = {}\n", ten_digits(pairs_), tool_.name, word->name,
                           ten_digits(*x));
      ++taken_;
    }
    if (pairs_ == 0.0 && problems_.empty()) add_missing("pole_pairs");
  }

  /// A VESC computes with the ratio of its encoder, and uses the poles for displays only.
  double checked_by_encoder(const ForeignWord& poles, double pairs) {
    const std::optional<double> ratio = number(find("foc_encoder_ratio"));
    const ForeignWord* const mode = find("foc_sensor_mode");
    if (!ratio || *ratio == pairs || mode == nullptr || mode->value != "1") return pairs;
    const std::string answer = answer_to("pole_pairs").value_or("");
    const std::string one = ten_digits(pairs), other = ten_digits(*ratio);
    if (answer == one || answer == other) return answer == one ? pairs : *ratio;
    tell(
        poles.line,
        fmt::format(
            "{} gives {} pole pairs and foc_encoder_ratio gives {}, but both are equal for an encoder on the motor's shaft",
            poles.name, one, other),
        fmt::format("answer pole_pairs={} or pole_pairs={}", one, other));
    return pairs;
  }

  void add(const ForeignKey& row, const ForeignWord& word, double x) {
    const double value = x * row.factor;
    if (!in_range(word, row.key, value)) return;
    ++taken_;
    if (row.key == "resistance_ohm") resistance_ohm_ = value;
    if (row.question.empty()) {
      body_ += quantity(row.key, value, row.frame, row.frame == "rms" ? word.name + "/sqrt(2)" : word.name);
      return;
    }
    const std::string answer = answer_to(row.question).value_or("");
    if (answer != row.frame && answer != row.other) {
      tell(word.line,
           fmt::format("{} = {} has two possible meanings: {}", word.name, bounded(word.value, 100), row.why),
           answers_to(row, x));
      return;
    }
    const bool first = answer == row.frame;
    body_ += quantity(row.key, value, answer, word.name) +
             wrapped_comment(fmt::format("answered {}={}; the other meaning is", row.question, answer)) +
             "# " + quantity(row.key, value, first ? row.other : row.frame, word.name);
  }

  void add_keys(std::initializer_list<std::string_view> keys, std::string_view needed) {
    bool found = needed.empty();
    for (const ForeignKey& row : tool_.keys) {
      if (std::find(keys.begin(), keys.end(), row.key) == keys.end()) continue;
      const ForeignWord* const word = find(row.word);
      if (const std::optional<double> x = number(word)) {
        add(row, *word, *x);
        found = true;
      }
    }
    if (!found) add_missing(needed);
  }

  void add_inductance(std::string_view key, const ForeignWord& word, double H, std::string_view what) {
    if (!in_range(word, key, 1e6 * H)) return;
    ++taken_;
    body_ += quantity(key, 1e6 * H, "phase", what);
  }

  void add_inductances() {
    const ForeignAxes& axes = tool_.axes;
    const ForeignWord *d = find(axes.d), *q = find(axes.q), *mean = find(axes.mean);
    std::optional<double> Ld = number(d), Lq = number(q);
    const std::optional<double> L = number(mean);
    if (!Ld) d = q, Ld = Lq;
    if (!Lq) q = d, Lq = Ld;
    inductance_H_ = L ? L : Ld;
    // SimpleFOC's own constructor takes one inductance for both axes.
    if (!L && d != nullptr && d == q && tool_.kind != ForeignKind::simple_foc)
      body_ += wrapped_comment(fmt::format("{} has only {}: taken for both axes", visible(file_), d->name));
    if (L) {
      add_mean(*mean, *L, find(axes.difference));
    } else if (Ld && *Ld == *Lq) {
      add_inductance("inductance_uH", *d, *Ld, d->name);
    } else if (Ld) {
      add_inductance("d_axis_inductance_uH", *d, *Ld, d->name);
      add_inductance("q_axis_inductance_uH", *q, *Lq, q->name);
    } else {
      add_missing("inductance_uH");
    }
  }

  /// The difference is L_q - L_d.
  void add_mean(const ForeignWord& mean, double L, const ForeignWord* difference) {
    const double half = difference ? foreign_number(difference->value).value_or(NAN) / 2 : 0.0;
    if (!(std::fabs(half) < L))
      return tell(difference->line,
                  fmt::format("{} = {} must be below twice {}", difference->name,
                              bounded(difference->value, 100), mean.name),
                  "correct this value in the file");
    if (half == 0.0) return add_inductance("inductance_uH", mean, L, mean.name);
    add_inductance("d_axis_inductance_uH", mean, L - half,
                   fmt::format("{} - {}/2", mean.name, difference->name));
    add_inductance("q_axis_inductance_uH", mean, L + half,
                   fmt::format("{} + {}/2", mean.name, difference->name));
  }

  /// Detects numbers in a wrong unit, such as milliohms or microhenries, by the winding's time constant L/R.
  void check_time_constant() {
    if (!resistance_ohm_ || !inductance_H_ || !problems_.empty()) return;
    const double tau_s = *inductance_H_ / *resistance_ohm_;
    constexpr double least_s = 1e-6, most_s = 1.0;
    if (tau_s >= least_s && tau_s <= most_s) return;
    tell(
        0,
        fmt::format(
            "has {} ohm and {} H, which give a time constant L/R of {} s, and no motor has this time constant",
            base::six_digits(*resistance_ohm_), base::six_digits(*inductance_H_), base::three_digits(tau_s)),
        "correct the wrong value in the file: resistance in ohm, inductance in H");
  }

  std::string known_words() const {
    std::string out;
    for (const ForeignKey& row : tool_.keys) out += fmt::format("{}{}", out.empty() ? "" : ", ", row.word);
    return out;
  }

  std::string head(const std::string& name) const {
    std::string text = wrapped_comment(fmt::format(
        "A motor, taken over from {}, {}. Replace each nan by a number; sixstep help KEY explains a "
        "key, and sixstep motor check FILE reports values that contradict each other.",
        visible(file_), foreign_name(tool_.kind)));
    text += fmt::format("name = {}\n", toml_text(name));
    const ForeignWord* const type = find("motor_type");
    if (tool_.kind == ForeignKind::vesc && type && type->value != "2")
      text += wrapped_comment(
          "motor_type is not 2 (field-oriented), so that foc_motor_* may be the firmware's defaults and not this motor's");
    const ForeignWord* const torque = find("torque_constant");
    if (torque && foreign_number(torque->value) == 0.04)
      text += wrapped_comment(
          "torque_constant = 0.04 is the firmware's default: replace this value if the motor has another torque constant");
    return text +
           wrapped_comment("shape of the back-EMF over the electrical angle, sine or trapezoid: " +
                           std::string(tool_.name) + " computes with a sine") +
           "back_emf = \"sine\"\n";
  }

  std::string file_;
  const ForeignTool& tool_;
  ForeignWords words_;
  const std::vector<std::string>& answers_;
  std::vector<std::string> asked_;
  std::optional<std::string> part_;
  std::optional<double> resistance_ohm_, inductance_H_;
  double pairs_ = 0.0;
  std::size_t taken_ = 0;
  std::string body_;
  base::Problems problems_;
};

}  // namespace

base::Result<std::string> motor_of_foreign_file(const std::string& file, std::string_view text,
                                                const std::string& name,
                                                const std::vector<std::string>& answers) {
  const ForeignKind kind = foreign_kind(text);
  if (kind == ForeignKind::none)
    return bounded(
        {.where = file,
         .value = {},
         .limit = "is not a known parameter file",
         .cure = "give a VESC motor configuration (XML), an ODrive or moteus configuration, a SimpleFOC "
                 "sketch with its BLDCMotor, or MATLAB's struct of a motor"});
  base::Result<ForeignWords> words = foreign_words(kind, text);
  if (!words) {
    base::Problem damaged = words.problems().front();
    damaged.where = file;
    return bounded(std::move(damaged));
  }
  return ForeignMotor(file, foreign_tool(kind), std::move(*words), answers).text(name);
}

}  // namespace text
