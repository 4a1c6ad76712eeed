// SPDX-License-Identifier: Apache-2.0
// Compares a board's scenario with the scenario designed for it, key by key of the descriptions.
#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "sixstep/analysis/verify/carried_over.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"

namespace sixstep::analysis {
namespace {

std::string as_text(double x) { return base::written(x); }
std::string as_text(int x) { return std::to_string(x); }
std::string as_text(bool x) { return x ? "true" : "false"; }
std::string as_text(const std::string& x) { return x; }
template <class T>
std::string as_text(const std::vector<T>& list) {
  std::string out;
  for (const T& x : list) out += as_text(x) + " ";
  return out;
}
template <class T>
std::string as_text(const std::optional<T>& x) {
  return x ? as_text(*x) : "";
}

/// The value of each key as text, except lists of tables, which contain a scenario's events and requirements,
/// and the sheet, which belongs to the motor.
class KeyTexts final : public base::Visitor {
 public:
  std::map<std::string, std::string> of;

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About&) override {
    std::visit([&](const auto* x) { of[path_ + std::string(key)] = as_text(*x); }, member);
  }
  void visit_word(std::string_view key, base::WordMember& member, const base::About&) override {
    of[path_ + std::string(key)] = member.word();
  }
  void visit_table(std::string_view key, base::TableMember& member, const base::About&) override {
    if (!member.is_there() || key == study::sheet_table) return;
    const std::size_t outer = path_.size();
    path_ += std::string(key) + ".";
    member.walk(*this);
    path_.resize(outer);
  }
  std::string path_;
};

/// True if a key is part of the design: a run's name, length, reference and record, the gains, and the
/// settings of the spec.
bool is_the_designs(std::string_view key) {
  constexpr std::string_view tables[] = {"reference.", "record.", "initial.", "sensors.hall_break."};
  constexpr std::string_view keys[] = {"title",
                                       "notes",
                                       "not_usable",
                                       "extends",
                                       "motor",
                                       "duration_s",
                                       "control.mode",
                                       "control.drive",
                                       "control.smooth_chopping.on",
                                       "control.position.gain_rad_s_per_deg",
                                       "control.current.limit_A",
                                       "sensors.speed_edges",
                                       "protection.off_at_s",
                                       "load.locked",
                                       "load.torque_Nm",
                                       "load.inertia_kg_m2"};
  constexpr std::string_view gains[] = {".settle_s", ".damping", ".d1",       ".d0",
                                        ".kp",       ".ki",      ".ki_per_s", ".torque_limit_Nm"};
  const auto is_gain = [key](std::string_view gain) { return key.ends_with(gain); };
  return std::any_of(std::begin(tables), std::end(tables),
                     [key](std::string_view table) { return key.starts_with(table); }) ||
         std::find(std::begin(keys), std::end(keys), key) != std::end(keys) ||
         (key.starts_with("control.") && std::any_of(std::begin(gains), std::end(gains), is_gain));
}

std::map<std::string, std::string> texts_of(study::Scenario& s) {
  KeyTexts texts;
  describe(texts, s);
  return std::move(texts.of);
}

std::string in(const std::map<std::string, std::string>& all, const std::string& key) {
  const auto found = all.find(key);
  return found == all.end() ? std::string() : found->second;
}

/// The names of the scenario's requirements: "require (mean speed, greatest current)".
std::string named(const study::Scenario& s) {
  std::string out;
  for (const study::Requirement& r : s.require)
    out += (out.empty() ? "" : ", ") + study::figure_name(s, r.measure);
  return "require (" + out + ")";
}

}  // namespace

std::string left_out(study::Scenario board, study::Scenario written) {
  study::Scenario usual;
  const auto given = texts_of(board), plain = texts_of(usual), designed = texts_of(written);
  std::string out;
  for (const auto& [key, text] : given)
    if (!is_the_designs(key) && text != in(plain, key) && in(designed, key) == in(plain, key))
      out += (out.empty() ? "" : ", ") + key;
  return out;
}

std::string replaced(const study::Scenario& board, const study::Scenario& written) {
  std::string out;
  const auto add = [&out](const std::string& what) { out += (out.empty() ? "" : ", ") + what; };
  const auto unit = [](const study::Scenario& s) {
    return s.reference.unit.value_or(std::string(study::reference_unit(s.control.mode)));
  };
  const double before = study::largest_reference(board), now = study::largest_reference(written);
  if (unit(board) != unit(written))
    add("reference");
  else if (before != now)
    add("reference (at most " + base::six_digits(before) + ", now " + base::six_digits(now) + " " +
        unit(board) + ")");
  if (board.load.torque_Nm != written.load.torque_Nm)
    add("load.torque_Nm (" + base::six_digits(board.load.torque_Nm) + ", now " +
        base::six_digits(written.load.torque_Nm) + ")");
  if (board.load.locked != written.load.locked) add("load.locked");
  if (!board.require.empty()) add(named(board));
  if (!board.at.empty()) add("at");
  if (!board.spread.empty()) add("spread");
  return out;
}

}  // namespace sixstep::analysis
