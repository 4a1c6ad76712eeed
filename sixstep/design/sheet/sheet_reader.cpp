// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_reader.hpp"

#include "sixstep/base/linear.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"

namespace sixstep::design {

namespace {

/// Visitor that checks each number against its range.
class Numbers final : public base::Visitor {
 public:
  explicit Numbers(SheetReader& reader) : reader_(reader) {}

 private:
  void visit_quantity(std::string_view key, const base::QuantityMember& member,
                      const base::About& about) override {
    const base::Quantity* const q = quantity_in(member);
    if (!q) return;
    const base::Range allowed = base::allowed(about);
    if (allowed.holds(q->value)) return;
    reader_.wrong(key, *q, limit_of(about.range, allowed, q->value),
                  "give the value that the sheet prints, or remove this key");
  }

  SheetReader& reader_;
};

/// Visitor that converts a value to another spelling of its key.
class Spelled final : public base::Visitor {
 public:
  Spelled(std::string_view key, std::string_view spelling) : key_(key), spelling_(spelling) {}

  std::optional<base::Spelling> found;

 private:
  void visit_quantity(std::string_view key, const base::QuantityMember&, const base::About& about) override {
    if (key != key_) return;
    for (const base::Spelling& s : about.also)
      if (s.key == spelling_) found = s;
  }
  std::string_view key_, spelling_;
};

}  // namespace

std::string SheetReader::value_of(std::string_view key, const base::Quantity& q) const {
  if (q.key.empty()) return base::written(q.value);
  Spelled spelled(key, q.key);
  Sheet described = sheet;
  describe(spelled, described);
  if (!spelled.found) return base::written(q.value);
  const double x = base::as_spelled(q.value, *spelled.found);
  return spelled.found->factor == 1.0 ? base::written(x) : base::rounded(x, 12);
}

void note_implausible(SheetReader& reader) {
  Sheet described = reader.sheet;  // a copy, because a description needs a sheet that can be written to
  Numbers numbers(reader);
  describe(numbers, described);
}

void unknown_frame(SheetReader& reader, std::string_view key, const base::Quantity& q,
                   std::span<const FrameMeaning> candidates, const std::string& hint) {
  std::string rule = "must say its frame:";
  if (!q.frame.empty()) rule = "has a frame \"" + q.frame + "\" that this key does not have:";
  std::string words;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    const FrameMeaning& c = candidates[n];
    const std::string frame(c.frame);
    rule.append(n == 0 ? " \"" : "; \"").append(frame).append("\" means ").append(c.means);
    words.append(n == 0 ? "\"" : n + 1 == candidates.size() ? " or \"" : ", \"").append(frame).append("\"");
  }
  reader.wrong(key, q, rule, "write frame = " + words + hint);
}

}  // namespace sixstep::design
