// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/job.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/loop/on_core.hpp"
#include "text/escape/escape.hpp"

namespace cli {

std::string Job::name() const { return std::filesystem::path(origin_.scenario).stem().string() + where_; }

void Job::run(const std::function<void(double t_s)>& reached) {
  study::Listeners listeners;
  outputs_.listen(listeners);
  listeners.keep_going = [&](double t_s) {
    reached(t_s);
    interrupted_ = interrupted_ || cli::interrupted();
    broken_ = broken_ || outputs_.failed();
    return !interrupted_ && !broken_;
  };
  base::Result<study::Outcome> result = loop::run(core_, scenario_, listeners);
  if (!result) return fail(result.problems());
  outcome_ = std::move(*result);
  problems_ = outputs_.publish({scenario_, *outcome_, origin_}, !interrupted_ && !broken_);
  reader_gone_ = broken_ && !interrupted_ && problems_.empty();
}

base::Problems Job::told(base::Problems problems) const {
  for (base::Problem& p : problems) p.where = origin_.scenario + ": " + p.where;
  return problems;
}

void Job::fail(const base::Problems& problems) {
  problems_ = told(problems);
  outputs_ = {};
}

base::Problems Job::take_core(const loop::Core* core) {
  core_ = core;
  return core == nullptr ? base::Problems{} : told(loop::stands_against(*core_, scenario_));
}

std::string Job::left_out() const {
  return outputs_.left_out().empty() ? "" : fmt::format("{}: {}\n", name(), outputs_.left_out());
}

std::string Job::foretold() const {
  return foretold_.empty() ? "" : fmt::format("{}: {}\n", name(), foretold_);
}

std::string Job::cut_short() const {
  if (!(interrupted_ || broken_) || reader_gone_ || !outcome_) return "";
  std::string text =
      fmt::format("{}: {} at {:.6g} s of {:.6g} s", name(), interrupted_ ? "interrupted" : "stopped",
                  outcome_->simulated_s, scenario_.duration_s);
  if (!outputs_.partial_files().empty())
    text += fmt::format("; the finished part is in {}", fmt::join(outputs_.partial_files(), ", "));
  return text::visible(text) + "\n";
}

Exit Job::exit_code() const {
  if (interrupted_) return exit_of_interrupt();
  if (!problems_.empty() || !outcome_) return Exit::bad_input;
  return reader_gone_ ? Exit::reader_gone : exit_of(*outcome_);
}

}  // namespace cli
