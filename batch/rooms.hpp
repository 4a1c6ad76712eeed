// SPDX-License-Identifier: Apache-2.0
// Short names for the library's namespaces, for code in batch.
#pragma once

namespace sixstep {
namespace analysis {}
namespace base {}
namespace design {}
namespace study {}
}  // namespace sixstep

namespace batch {
namespace analysis = sixstep::analysis;
namespace base = sixstep::base;
namespace design = sixstep::design;
namespace study = sixstep::study;
}  // namespace batch
