// SPDX-License-Identifier: Apache-2.0
// A plugin for QEMU 7.2 that counts the executed instructions from one address to another:
//
//   -plugin FILE,told=OUT,NAME=FROM-UNTIL,..,next=A
//
// FROM, UNTIL and A are hexadecimal addresses; NAME is the name of a row of counts. At address A the plugin
// prints the rows and clears them: once per block of a walk.
//
// Debian has no header of the plugin interface (version 1). The called functions are declared here according
// to QEMU's documentation of the interface.
#include <cstdlib>
#include <cstring>
#include <deque>
#include <string>

#include "tests/target/cost/counts.hpp"

extern "C" {
struct qemu_plugin_tb;
struct qemu_plugin_insn;
using Id = std::uint64_t;
__attribute__((visibility("default"))) extern const int qemu_plugin_version = 1;
void qemu_plugin_register_vcpu_tb_trans_cb(Id, void (*)(Id, qemu_plugin_tb*));
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb*);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb*, std::size_t);
std::uint64_t qemu_plugin_insn_vaddr(const qemu_plugin_insn*);
void qemu_plugin_register_vcpu_insn_exec_cb(qemu_plugin_insn*, void (*)(unsigned, void*), int flags, void*);
void qemu_plugin_register_vcpu_insn_exec_inline(qemu_plugin_insn*, int operation, void*, std::uint64_t);
void qemu_plugin_register_atexit_cb(Id, void (*)(Id, void*), void*);
}

namespace {

struct Marked {
  std::string name;
  std::uint64_t first = 0, after = 0, began = 0;
  bool runs = false;
  target::Counts counts{};
};
// These objects are never destroyed: QEMU calls the plugin for the last time after the destructors of static
// objects.
auto& marked = *new std::deque<Marked>;
auto& told = *new std::string;
std::uint64_t executed = 0, next = ~std::uint64_t{0};

void begins(unsigned, void* which) {
  auto* m = static_cast<Marked*>(which);
  m->began = executed;
  m->runs = true;
}
void ends(unsigned, void* which) {
  auto* m = static_cast<Marked*>(which);
  if (m->runs) m->counts.add(executed - m->began);
  m->runs = false;
}
void tell_and_go_on(unsigned, void*) {
  std::FILE* file = std::fopen(told.c_str(), "a");
  if (!file) return;
  for (Marked& m : marked) {
    m.counts.tell(file, m.name.c_str());
    m.counts = {};
  }
  std::fputs("next\n", file);
  std::fclose(file);
}

/// The callback of an instruction precedes the counting of this instruction. The count therefore includes the
/// first instruction and excludes the instruction at UNTIL.
void translated(Id, qemu_plugin_tb* block) {
  for (std::size_t n = 0; n < qemu_plugin_tb_n_insns(block); ++n) {
    qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(block, n);
    const std::uint64_t at = qemu_plugin_insn_vaddr(instruction);
    if (at == next) qemu_plugin_register_vcpu_insn_exec_cb(instruction, tell_and_go_on, 0, nullptr);
    for (Marked& m : marked) {
      if (at == m.first) qemu_plugin_register_vcpu_insn_exec_cb(instruction, begins, 0, &m);
      if (at == m.after) qemu_plugin_register_vcpu_insn_exec_cb(instruction, ends, 0, &m);
    }
    qemu_plugin_register_vcpu_insn_exec_inline(instruction, 0, &executed, 1);  // adds 1
  }
}

void at_exit(Id, void*) { tell_and_go_on(0, nullptr); }

std::uint64_t address(const std::string& hexadecimal) {
  return std::strtoull(hexadecimal.c_str(), nullptr, 16) & ~std::uint64_t{1};
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int qemu_plugin_install(Id id, const void*, int argc,
                                                                          char** argv) {
  for (int n = 0; n < argc; ++n) {
    const std::string word = argv[n];
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return 1;
    const std::string key = word.substr(0, equals), value = word.substr(equals + 1);
    if (key == "told") {
      told = value;
    } else if (key == "next") {
      next = address(value);
    } else {
      const std::size_t dash = value.find('-');
      if (dash == std::string::npos) return 1;
      marked.push_back({key, address(value.substr(0, dash)), address(value.substr(dash + 1))});
    }
  }
  std::remove(told.c_str());
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, at_exit, nullptr);
  return 0;
}
