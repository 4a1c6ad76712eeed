// SPDX-License-Identifier: Apache-2.0
// Manages the outputs of one run in every requested format: they are opened before the run, filled during it,
// and published at its end.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "faces/cli/formats.hpp"
#include "faces/cli/rooms.hpp"

namespace cli {

/// Creates the folder of --out.
base::Problems make_folder(const std::string& out);

struct OutputPaths {
  /// path per format; empty: not requested
  std::vector<std::string> of_formats = std::vector<std::string>(formats().size());
  bool force = false;  ///< true: replace any existing file

  const std::string& of(std::string_view option) const;
  /// Each requested output file with its option; without standard output.
  std::vector<std::pair<std::string, std::string>> files() const;
  /// Whether one format is printed to standard output. Then nothing else is printed there.
  bool prints() const;
  bool any() const { return prints() || !files().empty(); }
};

class Outputs {
 public:
  /// Opens the outputs. If it returns problems, nothing was written, and the run must not start.
  base::Problems open(const OutputPaths& paths, const study::Scenario& scenario,
                      const files::TraceOrigin& origin);

  void listen(study::Listeners& listeners) const;

  /// foretold(): parts of the run that will not fit an output. left_out(): after publish(), parts that did
  /// not fit.
  static std::string foretold(const OutputPaths& paths, const study::Scenario& scenario);
  const std::string& left_out() const { return left_out_; }

  /// Whether writing an output failed, because the disk is full or the reader closed a pipe.
  bool failed() const;

  /// Publishes the outputs. After an interrupted run, each output is NAME.partial.EXT, and nothing is printed
  /// to standard output.
  base::Problems publish(const files::RunStory& story, bool whole);

  /// The final path of the HTML page; empty if there is none.
  const std::string& page() const { return page_; }

  /// Partial names of an interrupted run's files.
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
