// SPDX-License-Identifier: Apache-2.0
#include "sixstep/base/visitor.hpp"

namespace sixstep::base {

std::string_view WordMember::word() const {
  return chosen() < size() ? at(chosen()).word : std::string_view();
}

std::string_view WordMember::linear_word() const {
  const std::string_view turning = word();
  for (std::size_t n = 0; n < size(); ++n)
    if (const Word other = at(n); !turning.empty() && other.turning == turning) return other.word;
  return turning;
}

Quantity* quantity_in(const QuantityMember& member) {
  if (Quantity* const* always = std::get_if<Quantity*>(&member)) return *always;
  std::optional<Quantity>& maybe = *std::get<std::optional<Quantity>*>(member);
  return maybe ? &*maybe : nullptr;
}

}  // namespace sixstep::base
