// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/numbers.hpp"

#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"

namespace sixstep::study {

namespace {

/// So many entries of one list are told of.
constexpr std::size_t most_told = 5;

/// The visitor that holds each number to what it may be.
class Numbers {
 public:
  explicit Numbers(const Scenario& s)
      : modes_(modes_from(s)), reference_unit_(reference_unit(s.control.mode)) {}

  base::Problems found;

  void value(std::string_view key, const double& x, const base::About& about) { look(key, x, about); }
  void value(std::string_view key, const int& x, const base::About& about) { look(key, x, about); }
  void value(std::string_view key, const std::vector<double>& list, const base::About& about) {
    const base::Range range = range_of(about);
    std::size_t told = 0;
    for (std::size_t n = 0; n < list.size() && told < most_told; ++n)
      if (!range.holds(list[n]))
        told += look(std::string(key) + "[" + std::to_string(n) + "]", list[n], about);
  }
  template <class T>
  void value(std::string_view key, const std::optional<T>& x, const base::About& about) {
    if (x) value(key, *x, about);
  }
  template <class Other>
  void value(std::string_view, const Other&, const base::About&) {}
  template <class Enum, class Choices>
  void choice(std::string_view, const Enum&, const Choices&, const base::About&) {}
  void table(std::string_view, design::Sheet&, const base::About&) {}
  template <class Struct>
  void table(std::string_view key, Struct& member, const base::About&) {
    within(std::string(key), member);
  }
  template <class Struct>
  void table(std::string_view key, std::optional<Struct>& member, const base::About&) {
    if (member) within(std::string(key), *member);
  }
  template <class Item>
  void list(std::string_view key, std::vector<Item>& items, const base::About&) {
    const std::string_view at_start = reference_unit_;
    for (std::size_t n = 0; n < items.size(); ++n) {
      if constexpr (std::is_same_v<Item, At>) reference_unit_ = reference_unit(modes_[n]);
      within(std::string(key) + "[" + std::to_string(n) + "]", items[n]);
    }
    reference_unit_ = at_start;
  }

 private:
  /// A reference is in its mode's unit.
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
  template <class Struct>
  void within(const std::string& key, Struct& member) {
    const std::size_t outer = path_.size();
    path_ += key + ".";
    describe(*this, member);
    path_.resize(outer);
  }

  std::string path_;
  std::vector<control::Mode> modes_;  ///< from each event on
  std::string_view reference_unit_;
};

}  // namespace

base::Problems check_numbers(const Scenario& s) {
  Scenario described = s;  // descriptions are written for readers, which fill what they visit
  Numbers numbers(s);
  describe(numbers, described);
  return std::move(numbers.found);
}

}  // namespace sixstep::study
