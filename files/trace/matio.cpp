// SPDX-License-Identifier: Apache-2.0
#include "files/trace/matio.hpp"

#include <dlfcn.h>

namespace files {
namespace {

base::Problem not_loaded() {
  const char* reason = ::dlerror();
  return {.limit = std::string("cannot be written, for want of the library for MAT files: ") +
                   (reason ? reason : "it is another one"),
          .cure = "install it (Debian's libmatio11), or take --csv"};
}

template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  return function != nullptr;
}

}  // namespace

base::Result<Matio> load_matio(const std::string& name) {
  void* library = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) return not_loaded();
  Matio m;
  const bool whole =
      find(library, "Mat_CreateVer", m.CreateVer) && find(library, "Mat_Close", m.Close) &&
      find(library, "Mat_VarCreate", m.VarCreate) &&
      find(library, "Mat_VarCreateStruct", m.VarCreateStruct) && find(library, "Mat_VarFree", m.VarFree) &&
      find(library, "Mat_VarSetStructFieldByName", m.VarSetStructFieldByName) &&
      find(library, "Mat_VarWrite", m.VarWrite) && find(library, "Mat_VarWriteAppend", m.VarWriteAppend);
  if (!whole) return not_loaded();
  return m;
}

const base::Result<Matio>& matio() {
  static const base::Result<Matio> loaded = load_matio(SIXSTEP_MATIO);
  return loaded;
}

}  // namespace files
