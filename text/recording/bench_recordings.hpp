// SPDX-License-Identifier: Apache-2.0
// Which columns of a recording are Hall lines and which voltages of what.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/identification/emf/emf_record.hpp"
#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "text/recording/recording.hpp"

namespace text {

/// What the headings do not say, or say otherwise.
struct BenchColumns {
  std::vector<std::string> hall;  ///< headings of H1, H2 and H3, or of one column of codes
  std::vector<std::string>
      voltages;  ///< headings of u_ab and u_bc, with u_ca or without, or of u_a, u_b, u_c
  std::optional<analysis::EmfBetween> between;
  std::optional<double> interval_s;  ///< of the rows, where none is a time
};

/// Lines at 0 and 1, or at two voltages: then the middle between them, with some way to go before it counts. `notes` gets what was not used
/// of the recording, and what was taken for what.
base::Result<analysis::HallLog> hall_log_of(const Recording& recording, const BenchColumns& columns,
                                            Notes& notes);

/// One to three voltages of one kind.
base::Result<analysis::EmfRecord> emf_record_of(const Recording& recording, const BenchColumns& columns,
                                                Notes& notes);

}  // namespace text
