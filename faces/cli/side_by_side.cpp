// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/side_by_side.hpp"

#include <atomic>

#include "batch/for_each.hpp"
#include "faces/cli/progress.hpp"

namespace cli {

analysis::ForEach side_by_side(unsigned jobs, bool quiet, const char* what) {
  return [=](std::size_t count, const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> done{0};
    Progress progress({.seconds = {}, .pieces = count, .of = what}, quiet);
    batch::for_each(count, jobs, [&](std::size_t n) {
      work(n);
      progress.pieces_done(++done);
    });
  };
}

}  // namespace cli
