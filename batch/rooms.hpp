// SPDX-License-Identifier: Apache-2.0
// The library's rooms by their short names, for code in batch.
#pragma once

namespace sixstep {
namespace analysis {}
namespace base {}
namespace study {}
}  // namespace sixstep

namespace batch {
namespace analysis = sixstep::analysis;
namespace base = sixstep::base;
namespace study = sixstep::study;
}  // namespace batch
