// SPDX-License-Identifier: Apache-2.0
// Manages the outputs of one run in every requested format: opened before it begins, filled during it,
// published at its end.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "faces/cli/formats.hpp"
#include "faces/cli/rooms.hpp"

namespace cli {

/// Makes the folder of --out.
base::Problems make_folder(const std::string& out);

struct OutputPaths {
  std::vector<std::string> of_formats = std::vector<std::string>(formats().size());  ///< empty: not wanted
  bool force = false;                                                                ///< replace any file

  const std::string& of(std::string_view option) const;
  /// Each wanted output with its option, without standard output.
  std::vector<std::pair<std::string, std::string>> files() const;
  /// Whether a format is printed to standard output, which then has nothing else.
  bool prints() const;
  bool any() const { return prints() || !files().empty(); }
};

class Outputs {
 public:
  /// Problems: nothing was written, and the run must not start.
  base::Problems open(const OutputPaths& paths, const study::Scenario& scenario,
                      const files::TraceOrigin& origin);

  void listen(study::Listeners& listeners) const;

  /// The parts of the run that will not fit into an output, and, after publish(), those that did not.
  static std::string foretold(const OutputPaths& paths, const study::Scenario& scenario);
  const std::string& left_out() const { return left_out_; }

  /// An output cannot be written any more: the disk is full, or the reader closed a pipe.
  bool failed() const;

  /// Publishes the outputs. An interrupted run leaves NAME.partial.EXT of each, and prints nothing to
  /// standard output.
  base::Problems publish(const files::RunStory& story, bool whole);

  /// The final path of the HTML page; empty: none.
  const std::string& page() const { return page_; }

  /// Names of an interrupted run's files.
  const std::vector<std::string>& partial_files() const { return partial_files_; }

 private:
  struct Open {
    std::string_view option;
    std::string path;
    files::Sink sink;
  };

  std::vector<Open> open_;
  std::string page_, left_out_;
  std::vector<std::string> partial_files_;
};

}  // namespace cli
