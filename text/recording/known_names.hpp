// SPDX-License-Identifier: Apache-2.0
// Recognises headings that name a column's quantity, as bare_name() writes them.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/study/measure/trace.hpp"
#include "text/rooms.hpp"

namespace text {

bool names_a_time(std::string_view bare);

/// The column's name as a log's heading may have it: "im" for i_m_A.
std::string bare_column(const study::Column& column);

/// Whether the heading names a time, a Hall line or code, a voltage, or a column of a trace.
bool is_known_name(std::string_view bare);

}  // namespace text
