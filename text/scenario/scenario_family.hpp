// SPDX-License-Identifier: Apache-2.0
// A scenario file together with those it extends, as one document.
#pragma once
#include <string>

#include "sixstep/base/result.hpp"
#include "text/sources.hpp"
#include "text/toml/document.hpp"

namespace text {

/// `extends` names one file or a list, each relative to the file that names it, and these may extend others
/// in turn. A file in a circle of such names is a Problem, and so is a family of more than 64 files.
base::Result<Document> read_family(const std::string& name, std::string text, const Resolve& resolve);

}  // namespace text
