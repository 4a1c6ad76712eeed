// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/numbers.hpp"

#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"

namespace sixstep::study {

namespace {

/// Largest number of reported entries of one list.
constexpr std::size_t most_told = 5;

/// Checks each number against its allowed range.
class Numbers final : public base::Visitor {
 public:
  Numbers(const Scenario& s, std::size_t known_events)
      : modes_(modes_from(s)), known_events_(known_events), reference_unit_(reference_unit(s.control.mode)) {}

  base::Problems found;

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About& about) override {
    std::visit([&](const auto* of) { hold(key, *of, about); }, member);
  }
  void hold(std::string_view key, const double& x, const base::About& about) { look(key, x, about); }
  void hold(std::string_view key, const int& x, const base::About& about) { look(key, x, about); }
  void hold(std::string_view key, const std::vector<double>& list, const base::About& about) {
    const base::Range range = range_of(about);
    std::size_t told = 0;
    for (std::size_t n = 0; n < list.size() && told < most_told; ++n)
      if (!range.holds(list[n]))
        told += look(std::string(key) + "[" + std::to_string(n) + "]", list[n], about);
  }
  template <class T>
  void hold(std::string_view key, const std::optional<T>& x, const base::About& about) {
    if (x) hold(key, *x, about);
  }
  template <class Other>
  void hold(std::string_view, const Other&, const base::About&) {}
  /// Skips the sheet, whose limits design/sheet/sheet_reader.hpp checks.
  void visit_table(std::string_view key, base::TableMember& member, const base::About&) override {
    if (member.is_there() && key != sheet_table) within(std::string(key), [&] { member.walk(*this); });
  }
  void visit_list(std::string_view key, base::ListMember& items, const base::About&) override {
    const std::string_view at_start = reference_unit_;
    for (std::size_t n = key == events_list ? known_events_ : 0; n < items.size(); ++n) {
      if (key == events_list) reference_unit_ = reference_unit(modes_[n]);
      within(std::string(key) + "[" + std::to_string(n) + "]", [&] { items.walk(n, *this); });
    }
    reference_unit_ = at_start;
  }

  /// The allowed range of a number. The range of a reference depends on the control mode, which sets the
  /// reference's unit.
  base::Range range_of(const base::About& about) const {
    return about.mode_unit == "*" ? base::allowed(about.range, reference_unit_) : base::allowed(about);
  }
  std::size_t look(std::string_view key, double x, const base::About& about) {
    const base::Range range = range_of(about);
    if (range.holds(x)) return 0;
    found.push_back({path_ + std::string(key), base::written(x), limit_of(about.range, range, x),
                     "it means: " + std::string(about.meaning) +
                         (about.unit.empty() ? "" : ", in " + std::string(about.unit))});
    return 1;
  }
  template <class Walk>
  void within(const std::string& key, const Walk& walk) {
    const std::size_t outer = path_.size();
    path_ += key + ".";
    walk();
    path_.resize(outer);
  }

  std::string path_;
  std::vector<control::Mode> modes_;  ///< the mode after each event
  std::size_t known_events_;
  std::string_view reference_unit_;
};

}  // namespace

base::Problems check_numbers(const Scenario& s, std::size_t known_events) {
  Scenario described = s;  // a copy, because descriptions also serve readers, which write the members
  Numbers numbers(s, known_events);
  describe(numbers, described);
  return std::move(numbers.found);
}

}  // namespace sixstep::study
