// SPDX-License-Identifier: Apache-2.0
// Reads the lines of instruments above the rows of a recording, except headings.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace text {

/// The time between rows, if the file states it outside of its rows.
struct RowClock {
  double interval_s = 0.0, start_s = 0.0;
  std::string said;  ///< the statement in the file, for messages: "Samplerate: 20 kHz"
};

/// Reads a line such as "Samplerate: 20 kHz", "Sample Interval,4e-06,s" or "Delta_X       1E-4"; empty for
/// other lines. `separator`: the separator of the rows' cells.
std::optional<RowClock> clock_in(std::string_view line, char separator);

/// Reads Rigol's two lines above the rows: names, "X,CH1,Start,Increment", and values,
/// "Sequence,VOLT,-2.5e-2,1e-4". Empty if there is no start or no increment.
std::optional<RowClock> clock_below(const std::vector<std::string_view>& names,
                                    const std::vector<std::string_view>& values);

/// The names D0, D1, D2 from "; Channels (3/8): D0, D1, D2". With this line sigrok names the channels of its
/// column "logic". Empty for other lines.
std::vector<std::string> channels_in(std::string_view line);

}  // namespace text
