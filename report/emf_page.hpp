// SPDX-License-Identifier: Apache-2.0
// Writes a measured back-EMF as one HTML file: the recording with its fit, the residual, harmonics and shape.
#pragma once
#include <string>

#include "text/results/emf_text.hpp"

namespace report {

struct EmfPage {
  const text::MeasuredEmf& measured;
  const sixstep::analysis::EmfRecord& record;
  std::string command;  ///< the command that writes this page again
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_emf(const EmfPage& page);

}  // namespace report
