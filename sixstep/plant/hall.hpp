// SPDX-License-Identifier: Apache-2.0
// Codes of Hall probes that are 120 or 60 electrical degrees apart; each probe is high over half a turn. The
// controller decodes the codes with another table, so that an error in this table cannot cancel in a run.
#pragma once
#include <cstdint>

namespace sixstep::plant {

/// H1 H2 H3 as bits 2, 1, 0 in sector 0..5 (model.md 3). H1 is high over sectors 5, 0, 1; H2 over 1, 2, 3; H3
/// over 3, 4, 5.
constexpr std::uint8_t hall_code(int sector) {
  const bool h1 = sector == 5 || sector == 0 || sector == 1;
  const bool h2 = sector >= 1 && sector <= 3;
  const bool h3 = sector >= 3;
  return static_cast<std::uint8_t>(h1 << 2 | h2 << 1 | static_cast<int>(h3));
}

/// Code of probes 60 degrees apart: each probe lags the previous probe by a sector. H1 is high over sectors
/// 5, 0, 1; H2 over 0, 1, 2; H3 over 1, 2, 3.
constexpr std::uint8_t hall_code_60(int sector) {
  const bool h1 = sector == 5 || sector == 0 || sector == 1;
  const bool h2 = sector >= 0 && sector <= 2;
  const bool h3 = sector >= 1 && sector <= 3;
  return static_cast<std::uint8_t>(h1 << 2 | h2 << 1 | static_cast<int>(h3));
}

}  // namespace sixstep::plant
