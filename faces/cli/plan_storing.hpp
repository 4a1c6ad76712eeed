// SPDX-License-Identifier: Apache-2.0
// The store that the rows of a plan go to, and who ends its runs where it takes no more or somebody interrupts.
#pragma once
#include <stop_token>
#include <thread>

#include "faces/cli/plan_reading.hpp"

namespace cli {

/// As --store, --resume and --force say. `identity` is what must not change between two sittings.
base::Result<files::PlanStore> store_of(const RunArguments& arguments, const ReadPlan& plan,
                                        std::string identity);

/// Carries Ctrl-C, of which a signal handler may only leave a note, and a store that takes nothing more to the runs under way.
class StoreWatch {
 public:
  explicit StoreWatch(const files::PlanStore& store);
  std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  std::jthread watch_;
};

}  // namespace cli
