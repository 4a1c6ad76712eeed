// SPDX-License-Identifier: Apache-2.0
#include "batch/nlopt_calls.hpp"

#include <dlfcn.h>

#include <cstring>
#include <optional>

namespace batch {

namespace {

std::optional<NloptCalls> loaded() {
  void* const library = dlopen("libnlopt.so.0", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) return {};
  NloptCalls calls;
  bool whole = true;
  const auto find = [&](auto& function, const char* name) {
    void* const address = dlsym(library, name);
    whole = whole && address != nullptr;
    std::memcpy(&function, &address,
                sizeof address);  // C++ has no cast from an object's to a function's address
  };
#define SIXSTEP_NLOPT_FIND(name) find(calls.name, "nlopt_" #name);
  SIXSTEP_NLOPT_CALLS(SIXSTEP_NLOPT_FIND)
#undef SIXSTEP_NLOPT_FIND
  return whole ? std::optional(calls) : std::nullopt;
}

}  // namespace

const NloptCalls* nlopt_calls() {
  static const std::optional<NloptCalls> calls = loaded();
  return calls ? &*calls : nullptr;
}

}  // namespace batch
