// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_reader.hpp"

#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"

namespace sixstep::design {

namespace {

/// The visitor that holds each number to what it may be.
class Numbers {
 public:
  explicit Numbers(SheetReader& reader) : reader_(reader) {}

  void quantity(std::string_view key, const std::optional<base::Quantity>& q, const base::About& about) {
    if (!q) return;
    const base::Range allowed = base::allowed(about);
    if (allowed.holds(q->value)) return;
    reader_.problem(SheetReader::key_of(key, *q), base::written(q->value),
                    limit_of(about.range, allowed, q->value),
                    "give the value as the sheet prints it, or leave the key out");
  }
  template <class Other>
  void value(std::string_view, const Other&, const base::About&) {}
  template <class Enum, class Choices>
  void choice(std::string_view, const Enum&, const Choices&, const base::About&) {}

 private:
  SheetReader& reader_;
};

}  // namespace

void note_implausible(SheetReader& reader) {
  Sheet described = reader.sheet;  // descriptions are written for readers, which fill what they visit
  Numbers numbers(reader);
  describe(numbers, described);
}

void unknown_frame(SheetReader& reader, std::string_view key, const base::Quantity& q,
                   std::span<const FrameMeaning> candidates, const std::string& hint) {
  std::string rule = "must say its frame:";
  if (!q.frame.empty()) rule = "has a frame \"" + q.frame + "\" that is none of its own:";
  std::string words;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    const FrameMeaning& c = candidates[n];
    const std::string frame(c.frame);
    rule.append(n == 0 ? " \"" : "; \"").append(frame).append("\" means ").append(c.means);
    words.append(n == 0 ? "\"" : n + 1 == candidates.size() ? " or \"" : ", \"").append(frame).append("\"");
  }
  reader.problem(SheetReader::key_of(key, q), base::written(q.value), rule, "write frame = " + words + hint);
}

}  // namespace sixstep::design
