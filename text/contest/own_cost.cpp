// SPDX-License-Identifier: Apache-2.0
#include "text/contest/own_cost.hpp"

#include <nlohmann/json.hpp>

#include "text/contest/contest_text.hpp"

namespace text {
namespace {

using CountedJson = nlohmann::json;

base::Problem not_counted(std::string limit) {
  return {.where = {},
          .value = {},
          .limit = std::move(limit),
          .cure = "make this file with tools/own_cost.sh --json"};
}

std::string whole_at(const CountedJson& from, const char* pointer) {
  const CountedJson::json_pointer at(pointer);
  if (!from.contains(at) || !from.at(at).is_number_unsigned()) return {};
  return std::to_string(from.at(at).get<std::uint64_t>());
}

}  // namespace

base::Result<OwnCost> own_cost_of(std::string_view json) {
  const CountedJson all = CountedJson::parse(json, nullptr, false);
  if (!all.is_object() || !all.contains("controller") || !all["controller"].is_string() ||
      !all.contains("cores") || !all["cores"].is_array())
    return not_counted("does not contain the instruction counts of a user's controller");
  for (const CountedJson& row : all["cores"]) {
    if (!row.is_object() || row.value("core", CountedJson{}) != contest_core) continue;
    OwnCost out{all["controller"].get<std::string>(),
                {whole_at(row, "/tick/worst"), whole_at(row, "/flash_bytes")}};
    if (out.cost.tick.empty() || out.cost.flash_bytes.empty()) break;
    return out;
  }
  return not_counted("does not contain the instruction count on the " + std::string(contest_core) +
                     ", which the table shows");
}

}  // namespace text
