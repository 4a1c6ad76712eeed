// SPDX-License-Identifier: Apache-2.0
// What a plan's runs leave in files: opened before the first of them, put in place after the last.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "faces/cli/plan_reading.hpp"
#include "files/atomic_file.hpp"
#include "text/results/plan_text.hpp"

namespace cli {

/// Rows and page of a plan, in the formats that it has.
class PlanOutputs {
 public:
  /// Problems mean that nothing was written and nothing must run. The arguments stay where they are.
  base::Problems open(const RunArguments& arguments, const ReadPlan& plan);
  /// Of a plan that was cut short under partial names.
  base::Problems publish(const text::PlanStory& story, const ReadPlan& plan, bool whole);
  /// Those names, after publish().
  const std::vector<std::string>& partial_files() const { return partial_files_; }

 private:
  struct Open {
    std::string_view option;
    files::AtomicFile file;
  };
  std::string page(const text::PlanStory& story, const ReadPlan& plan, base::Problems& problems) const;

  const RunArguments* arguments_ = nullptr;
  std::vector<Open> open_;
  std::vector<std::string> partial_files_;
  bool prints_json_ = false;
};

}  // namespace cli
