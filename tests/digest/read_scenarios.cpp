// SPDX-License-Identifier: Apache-2.0
// read_scenarios FILE..: reads scenarios from texts, as a page in a browser does, and runs them. Prints name,
// digest of the trajectory and number of segments. The readers need sixstep/ and text/, but no file system:
// this program passes the texts.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/run/run.hpp"
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

base::Result<study::Outcome> outcome_of(const std::string& path) {
  std::optional<std::string> text = contents(path);
  if (!text) return base::Problem{.where = path, .limit = "cannot be read"};
  const base::Result<study::Scenario> scenario =
      text::read_scenario_text(path, std::move(*text), {.overrides = {}, .resolve = beside});
  if (!scenario) return scenario.problems();
  return study::run(*scenario);
}

bool print(const std::string& path) {
  const base::Result<study::Outcome> out = outcome_of(path);
  if (!out) {
    for (const base::Problem& p : out.problems()) std::fprintf(stderr, "%s\n", base::to_string(p).c_str());
    return false;
  }
  std::printf("%-56s %s %8lld\n", path.c_str(), base::written_hex(out->digest).c_str(),
              static_cast<long long>(out->segments));
  return true;
}

}  // namespace

int main(int count, char** paths) {
  bool ok = true;
  for (int n = 1; n < count; ++n) ok = print(paths[n]) && ok;
  return ok ? 0 : 1;
}
