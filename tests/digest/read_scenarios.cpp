// SPDX-License-Identifier: Apache-2.0
// read_scenarios [--in-steps] FILE..: reads scenarios from their texts, as a page in a browser does, and runs
// them. It prints name, digest of the trajectory and number of segments. The code of sixstep/ and the readers
// of text/ need no file system: this program passes the texts. With --in-steps, each scenario is also run as
// a session in steps of 1 ms, 37 us, 10 us and random steps. All digests must be equal.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sixstep/base/random.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/session/session.hpp"
#include "text/scenario/scenario_file.hpp"
#include "text/sources.hpp"

namespace {

using namespace sixstep;

std::optional<std::string> contents(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return {};
  std::string text;
  char block[4096];
  while (const std::size_t got = std::fread(block, 1, sizeof block, file.get())) text.append(block, got);
  return text;
}

base::Result<text::NamedText> beside(const text::Naming& naming) {
  const std::string path = text::beside(naming.from, naming.name);
  if (std::optional<std::string> text = contents(path)) return text::NamedText{path, std::move(*text)};
  return base::Problem{.where = path};
}

base::Result<study::Scenario> read(const std::string& path) {
  std::optional<std::string> text = contents(path);
  if (!text) return base::Problem{.where = path, .limit = "cannot be read"};
  return text::read_scenario_text(path, std::move(*text), {.overrides = {}, .resolve = beside});
}

/// Runs the scenario as a session and reads it after each step. With step_s = 0, the steps are random, from
/// 0.1 to 300 us.
base::Result<study::Outcome> in_steps(const study::Scenario& scenario, double step_s) {
  base::Result<study::Session> session = study::Session::open(scenario);
  if (!session) return session.problems();
  double at_s = 0.0;
  for (std::uint64_t n = 0; session->advance(at_s); ++n)
    at_s += step_s > 0 ? step_s : 1e-7 + 3e-4 * base::uniform({39, 0, n});
  return session->close();
}

bool report(const base::Problems& problems) {
  for (const base::Problem& p : problems) std::fprintf(stderr, "%s\n", base::to_string(p).c_str());
  return false;
}

bool print(const std::string& path, bool also_in_steps) {
  const base::Result<study::Scenario> scenario = read(path);
  if (!scenario) return report(scenario.problems());
  const base::Result<study::Outcome> out = study::run(*scenario);
  if (!out) return report(out.problems());
  if (also_in_steps)
    for (const double step_s : {1e-3, 37e-6, 10e-6, 0.0}) {
      const base::Result<study::Outcome> stepped = in_steps(*scenario, step_s);
      if (!stepped) return report(stepped.problems());
      if (stepped->digest != out->digest)
        return report({{path, base::written(step_s), "steps of this length have another digest", ""}});
    }
  std::printf("%-56s %s %8lld\n", path.c_str(), base::written_hex(out->digest).c_str(),
              static_cast<long long>(out->segments));
  return true;
}

}  // namespace

int main(int count, char** paths) {
  const bool also_in_steps = count > 1 && std::string_view(paths[1]) == "--in-steps";
  bool ok = true;
  for (int n = also_in_steps ? 2 : 1; n < count; ++n) ok = print(paths[n], also_in_steps) && ok;
  return ok ? 0 : 1;
}
