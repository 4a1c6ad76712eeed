// SPDX-License-Identifier: Apache-2.0
#include "text/packed_text.hpp"

#include <zlib.h>

namespace text {

std::string unpacked(std::string_view packed, std::size_t size) {
  std::string out(size, '\0');
  uLongf written = size;
  const int wrong = ::uncompress(reinterpret_cast<Bytef*>(out.data()), &written,
                                 reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  // Happens only in a damaged program; the texts are then missing.
  if (wrong != Z_OK || written != size) out.clear();
  return out;
}

}  // namespace text
