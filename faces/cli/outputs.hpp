// SPDX-License-Identifier: Apache-2.0
// The outputs of one run in every format that was asked for: opened before it begins, filled while it goes
// on, put in place at its end.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "faces/cli/formats.hpp"
#include "faces/cli/rooms.hpp"

namespace cli {

/// For --out.
base::Problems make_folder(const std::string& out);

struct OutputPaths {
  std::vector<std::string> of_formats = std::vector<std::string>(formats().size());  ///< empty: not wanted
  bool force = false;  ///< over whatever is there

  const std::string& of(std::string_view option) const;
  /// Each that is wanted with its option, standard output left out.
  std::vector<std::pair<std::string, std::string>> files() const;
  /// Standard output is that of a format alone.
  bool prints() const;
  bool any() const { return prints() || !files().empty(); }
};

class Outputs {
 public:
  /// Problems mean that nothing was written and nothing must run.
  base::Problems open(const OutputPaths& paths, const study::Scenario& scenario,
                      const files::TraceOrigin& origin);

  void listen(study::Listeners& listeners) const;

  /// What of the run will not fit into one of them, and what did not, once it is published.
  static std::string foretold(const OutputPaths& paths, const study::Scenario& scenario);
  const std::string& left_out() const { return left_out_; }

  /// One of them can be written no longer: a disk is full, or the reader of a pipe has gone.
  bool failed() const;

  /// A run that was cut short leaves NAME.partial.EXT of each, and nothing on standard output.
  base::Problems publish(const files::RunStory& story, bool whole);

  /// Where the page for people stands in the end; empty where there is none.
  const std::string& page() const { return page_; }

  /// The names under which a cut run's files stand.
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
