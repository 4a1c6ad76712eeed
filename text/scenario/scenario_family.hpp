// SPDX-License-Identifier: Apache-2.0
// Reads a scenario file together with the files that it extends as one document.
#pragma once
#include <string>

#include "sixstep/base/result.hpp"
#include "text/sources.hpp"
#include "text/toml/document.hpp"

namespace text {

/// Reads the document. `extends` names one file or a list, each relative to the file that names it; these
/// files may extend further files. Problems: files that extend each other in a circle, more than 64 files.
base::Result<Document> read_family(const std::string& name, std::string text, const Resolve& resolve);

}  // namespace text
