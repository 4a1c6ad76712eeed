// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "batch/ranks.hpp"

namespace batch {
namespace {

unsigned named(const char* name, unsigned otherwise) {
  const char* text = std::getenv(name);
  unsigned x = otherwise;
  if (text != nullptr) std::from_chars(text, text + std::strlen(text), x);
  return x;
}

}  // namespace

Started started() {
  if (const unsigned size = named("OMPI_COMM_WORLD_SIZE", 0)) return {named("OMPI_COMM_WORLD_RANK", 0), size};
  if (const unsigned size = named("PMI_SIZE", 0)) return {named("PMI_RANK", 0), size};
  // Slurm's count of tasks alone does not indicate a cluster, because it is also set for the script of a job.
  if (std::getenv("PMIX_RANK") != nullptr) return {named("PMIX_RANK", 0), named("SLURM_STEP_NUM_TASKS", 1)};
  return {};
}

}  // namespace batch
