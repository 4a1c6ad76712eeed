// SPDX-License-Identifier: Apache-2.0
// Finds the Hall lines and the voltages in a recording of a motor on a bench.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_record.hpp"
#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "text/recording/recording.hpp"

namespace text {

/// Columns that the user names, in addition to the headings or in place of them.
struct BenchColumns {
  std::vector<std::string> hall;  ///< headings of H1, H2 and H3, or of one column of codes
  std::vector<std::string>
      voltages;  ///< headings of u_ab and u_bc, with u_ca or without, or of u_a, u_b, u_c
  std::optional<analysis::EmfBetween> between;
  std::optional<double> interval_s;  ///< interval of the rows, if no column is a time
};

/// The log of Hall lines. A line has the values 0 and 1, or two voltages; with voltages, the threshold is in
/// their middle, with hysteresis. `notes` lists the unused columns and the assumptions.
base::Result<analysis::HallLog> hall_log_of(const Recording& recording, const BenchColumns& columns,
                                            Notes& notes);

/// The record of one to three voltages of one kind.
base::Result<analysis::EmfRecord> emf_record_of(const Recording& recording, const BenchColumns& columns,
                                                Notes& notes);

}  // namespace text
