// SPDX-License-Identifier: Apache-2.0
#include "files/controller_file.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "files/controller_guard.hpp"
#include "files/text_file.hpp"
#include "sixstep/study/check/own.hpp"

namespace files {
namespace {

constexpr const char* symbol = "sixstep_own_controller";
constexpr std::string_view elf_magic =
    "\x7f"
    "ELF";

base::Problem unloaded(const std::string& path, std::string why) {
  if (why.starts_with(path + ": ")) why.erase(0, path.size() + 2);
  return {
      .where = path,
      .limit = "cannot be loaded: " + why,
      .cure =
          "compile the controller with -shared -fPIC for this machine (docs/howto/write-a-controller.md)"};
}

/// Loads a shared object. Loading already runs the object's code: the constructors of its libraries.
base::Result<text::NamedText> loaded_from(const std::string& path, const std::string& whole) {
  void* const object = dlopen(whole.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) {
    const char* const why = dlerror();
    return unloaded(whole, why ? why : "the system gives no reason");
  }
  using Own = const sixstep_controller* (*)();
  const auto own = reinterpret_cast<Own>(dlsym(object, symbol));
  if (own == nullptr) return unloaded(whole, std::string("it has no function ") + symbol);
  const sixstep_controller* const controller = own();
  if (controller == nullptr) return unloaded(whole, std::string(symbol) + " returned a null pointer");
  if (base::Problems wrong = sixstep::study::check_controller(*controller); !wrong.empty()) {
    base::Problem& first = wrong.front();
    return base::Problem{.where = path, .limit = "has a controller whose " + to_string(first), .cure = {}};
  }
  const base::Result<const sixstep_controller*> guarded = guarded_controller(path, *controller);
  if (!guarded) return guarded.problems();
  return text::NamedText{path, {}, *guarded};
}

/// The command that compiles the source, with the options of the Python package's compiled().
std::string compile_command(const std::string& source) {
  const std::filesystem::path path(source);
  const bool cpp = path.extension() == ".cpp" || path.extension() == ".cc" || path.extension() == ".cxx";
  return std::string(cpp ? "c++ -std=c++20" : "cc") + " -O2 -ffp-contract=off -shared -fPIC -IFOLDER " +
         path.filename().string() + " -o " + path.stem().string() + ".so";
}

}  // namespace

base::Result<text::NamedText> load_controller(const std::string& path) {
  const base::Result<std::string> bytes = read_regular_text(path);
  if (!bytes) {
    base::Problem problem = bytes.problems().front();
    problem.where = path;
    return problem;
  }
  if (!bytes->starts_with(elf_magic))
    return base::Problem{.where = path,
                         .limit = "is not a compiled library; the file may be the source",
                         .cure = "compile the source, and name the compiled file: " + compile_command(path) +
                                 ", where FOLDER has sixstep/control/own/own_controller.h"};
  // An absolute path contains a slash. The loader would search a name without a slash among the system's
  // libraries.
  std::error_code ignored;
  const std::string whole = std::filesystem::absolute(path, ignored).string();
  base::Result<text::NamedText> loaded = base::Problem{};
  in_controller(path, [&] { loaded = loaded_from(path, whole); });
  return loaded;
}

}  // namespace files
