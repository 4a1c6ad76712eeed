// SPDX-License-Identifier: Apache-2.0
// Manages the output files of a plan: they are opened before its first run and published after its last.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "faces/cli/plan_reading.hpp"
#include "files/atomic_file.hpp"
#include "text/results/plan_text.hpp"

namespace cli {

/// Rows and page of a plan, in all requested formats.
class PlanOutputs {
 public:
  /// Opens the files. If it returns problems, nothing was written, and no run must start. `arguments` must
  /// outlive this object.
  base::Problems open(const RunArguments& arguments, const ReadPlan& plan);
  /// Publishes the files; if the plan was interrupted, under partial names.
  base::Problems publish(const text::PlanStory& story, const ReadPlan& plan, bool whole);
  /// The partial names of files, after publish().
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
