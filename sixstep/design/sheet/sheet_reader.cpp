// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/sheet_reader.hpp"

namespace sixstep::design {

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
