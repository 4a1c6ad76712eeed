// SPDX-License-Identifier: Apache-2.0
// Uses minizip, which belongs to zlib's sources. Its callbacks allow writing into memory.
#include "files/zip_file.hpp"

#include <minizip/zip.h>
#include <zlib.h>

#include <algorithm>

namespace files {
namespace {

/// The memory into which minizip writes.
struct Memory {
  std::string bytes;
  std::size_t at = 0;
};

Memory& memory_of(voidpf opaque) { return *static_cast<Memory*>(opaque); }

voidpf open_memory(voidpf opaque, const void*, int) { return opaque; }
uLong read_memory(voidpf, voidpf, void*, uLong) { return 0; }
uLong write_memory(voidpf opaque, voidpf, const void* from, uLong size) {
  Memory& memory = memory_of(opaque);
  memory.bytes.resize(std::max(memory.bytes.size(), memory.at + size));
  std::copy_n(static_cast<const char*>(from), size, memory.bytes.data() + memory.at);
  memory.at += size;
  return size;
}
ZPOS64_T tell_memory(voidpf opaque, voidpf) { return memory_of(opaque).at; }
long seek_memory(voidpf opaque, voidpf, ZPOS64_T offset, int origin) {
  Memory& memory = memory_of(opaque);
  memory.at = origin == ZLIB_FILEFUNC_SEEK_SET   ? offset
              : origin == ZLIB_FILEFUNC_SEEK_CUR ? memory.at + offset
                                                 : memory.bytes.size() + offset;
  return 0;
}
int close_memory(voidpf, voidpf) { return 0; }
int error_of_memory(voidpf, voidpf) { return 0; }

bool add(zipFile zip, const ZipEntry& entry) {
  zip_fileinfo about{};
  about.dosDate = (1U << 21) | (1U << 16);  // 1980-01-01, the first date that the format has
  about.external_fa = (entry.executable ? 0100755U : 0100644U) << 16;
  constexpr uLong made_by_unix = 3U << 8;
  const int level = entry.packed ? Z_DEFAULT_COMPRESSION : 0;
  if (zipOpenNewFileInZip4(zip, entry.name.c_str(), &about, nullptr, 0, nullptr, 0, nullptr,
                           entry.packed ? Z_DEFLATED : 0, level, 0, -MAX_WBITS, DEF_MEM_LEVEL,
                           Z_DEFAULT_STRATEGY, nullptr, 0, made_by_unix, 0) != ZIP_OK)
    return false;
  const int written =
      zipWriteInFileInZip(zip, entry.content.data(), static_cast<unsigned>(entry.content.size()));
  return zipCloseFileInZip(zip) == ZIP_OK && written == ZIP_OK;
}

}  // namespace

std::string zipped(const std::vector<ZipEntry>& entries) {
  Memory memory;
  zlib_filefunc64_def functions{.zopen64_file = open_memory,
                                .zread_file = read_memory,
                                .zwrite_file = write_memory,
                                .ztell64_file = tell_memory,
                                .zseek64_file = seek_memory,
                                .zclose_file = close_memory,
                                .zerror_file = error_of_memory,
                                .opaque = &memory};
  zipFile zip = zipOpen2_64("memory", APPEND_STATUS_CREATE, nullptr, &functions);
  if (zip == nullptr) return {};
  const bool whole = std::ranges::all_of(entries, [&](const ZipEntry& entry) { return add(zip, entry); });
  return zipClose(zip, nullptr) == ZIP_OK && whole ? memory.bytes : std::string();
}

}  // namespace files
