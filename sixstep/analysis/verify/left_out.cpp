// SPDX-License-Identifier: Apache-2.0
// Lists the keys of a board's scenario that the scenario designed for it does not have, key by key of the
// descriptions.
#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "sixstep/analysis/verify/carried_over.hpp"
#include "sixstep/base/written.hpp"
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

/// Each key's value as text, without lists of tables, which are a scenario's course and judgement, and without the
/// sheet, which is the motor's.
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

/// Whether a key belongs to the design: a run's name, length, reference and record, the gains, and what the spec
/// chooses.
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

}  // namespace

std::string left_out(study::Scenario board, study::Scenario written) {
  study::Scenario usual;
  const auto given = texts_of(board), plain = texts_of(usual), designed = texts_of(written);
  const auto in = [](const std::map<std::string, std::string>& all, const std::string& key) {
    const auto found = all.find(key);
    return found == all.end() ? std::string() : found->second;
  };
  std::string out;
  for (const auto& [key, text] : given)
    if (!is_the_designs(key) && text != in(plain, key) && in(designed, key) == in(plain, key))
      out += (out.empty() ? "" : ", ") + key;
  return out;
}

}  // namespace sixstep::analysis
