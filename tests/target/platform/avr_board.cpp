// SPDX-License-Identifier: Apache-2.0
// avr_board FIRMWARE.elf                                           prints the firmware's output
// avr_board FIRMWARE.elf RECORDS REQUEST TICK HALL                 also counts the cycles of the entries at these
//                                                                  addresses, and of INT0 and INT1 in a second run
// avr_board FIRMWARE.elf NEXT ENDS BEGINS..                        counts the cycles from each of these addresses to ENDS,
//                                                                  block after block: NEXT is reached between two
//
// An ATmega2560 in simavr. A write to GPIOR0 prints a character, 255 in GPIOR1 ends the run, and a write to
// GPIOR2 requests records. This is a separate program, because libsimavr is GPL-3 and no other part of the
// project links it.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/target/cost/counts.hpp"

extern "C" {
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_io.h>
}

namespace {

// From the request to the first instruction of the vector, the hardware needs five cycles (data sheet, Reset
// and Interrupt Handling). simavr does not count these cycles.
constexpr std::uint64_t interrupt_response = 5;

struct Board {
  avr_t* avr = nullptr;
  bool done = false;
  std::FILE* records = nullptr;
  std::uint16_t request = 0;  ///< address of the firmware's refill_request
};

/// A call, from its first instruction to its return. At the return, the stack pointer is again above the
/// return address.
struct Watched {
  const char* name;
  std::uint32_t at = 0;
  std::uint64_t more = 0, began = 0;
  std::uint16_t stack = 0;
  bool runs = false;
  target::Counts counts{};
};

std::uint16_t word(const avr_t* avr, std::uint16_t at) {
  return static_cast<std::uint16_t>(avr->data[at] | avr->data[at + 1] << 8);
}

void refill(avr_t* avr, avr_io_addr_t, std::uint8_t, void* board) {
  const Board& b = *static_cast<Board*>(board);
  const std::uint16_t to = word(avr, b.request),
                      wanted = word(avr, static_cast<std::uint16_t>(b.request + 2));
  const std::size_t came = b.records ? std::fread(avr->data + to, 1, wanted, b.records) : 0;
  avr->data[b.request + 2] = static_cast<std::uint8_t>(came);
  avr->data[b.request + 3] = static_cast<std::uint8_t>(came >> 8);
}

bool power_up(Board& board, const char* file, bool interrupts) {
  elf_firmware_t firmware{};
  if (elf_read_firmware(file, &firmware) != 0) return false;
  board.avr = avr_make_mcu_by_name("atmega2560");
  avr_init(board.avr);
  board.avr->log = 0;
  firmware.frequency = 16000000;
  avr_load_firmware(board.avr, &firmware);
  board.avr->data[0x4A] = interrupts ? 1 : 0;
  avr_register_io_write(
      board.avr, 0x3E, [](avr_t*, avr_io_addr_t, std::uint8_t c, void*) { std::putchar(c); }, nullptr);
  avr_register_io_write(
      board.avr, 0x4A,
      [](avr_t*, avr_io_addr_t, std::uint8_t, void* to) { static_cast<Board*>(to)->done = true; }, &board);
  avr_register_io_write(board.avr, 0x4B, refill, &board);
  return true;
}

void watch(Watched& w, const avr_t* avr) {
  const std::uint16_t stack = word(avr, R_SPL);
  if (w.runs && stack == w.stack + 3) {
    w.counts.add(avr->cycle - w.began + w.more);
    w.runs = false;
  }
  if (!w.runs && avr->pc == w.at) {
    w.began = avr->cycle;
    w.stack = stack;
    w.runs = true;
  }
}

int go(Board& board, Watched (&watched)[2]) {
  while (!board.done) {
    const int state = avr_run(board.avr);
    if (state == cpu_Crashed || state == cpu_Done) {
      std::fprintf(stderr, "crashed at %x\n", static_cast<unsigned>(board.avr->pc));
      return 3;
    }
    for (Watched& w : watched)
      if (w.at != 0) watch(w, board.avr);
  }
  return 0;
}

/// Counts the cycles of the calls of each block, from the mark of the block to the common end mark
/// (walk/counted.hpp).
int go_by_blocks(Board& board, std::uint32_t next, std::uint32_t ends, std::vector<Watched>& blocks) {
  while (!board.done) {
    const int state = avr_run(board.avr);
    if (state == cpu_Crashed || state == cpu_Done) return 3;
    const std::uint32_t at = board.avr->pc;
    for (Watched& w : blocks) {
      if (at == w.at) w.began = board.avr->cycle;
      if (at == ends && w.runs) w.counts.add(board.avr->cycle - w.began);
      w.runs = at == w.at || (w.runs && at != ends);
    }
    if (at != next) continue;
    for (Watched& w : blocks) {
      w.counts.tell(stdout, w.name);
      w.counts = {};
    }
    std::puts("next");
  }
  return 0;
}

std::uint32_t address(const char* hexadecimal) {
  return static_cast<std::uint32_t>(std::strtoul(hexadecimal, nullptr, 16)) & 0x7fffffu;
}

int count_blocks(int argc, char** argv) {
  static const char* const names[] = {"slot0", "slot1", "slot2"};
  Board board;
  if (!power_up(board, argv[1], false)) return 2;
  std::vector<Watched> blocks;
  for (int n = 4; n < argc; ++n) blocks.push_back({names[n - 4], address(argv[n])});
  return go_by_blocks(board, address(argv[2]), address(argv[3]), blocks);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 7) return count_blocks(argc, argv);
  if (argc != 2 && argc != 6) return 2;
  for (const bool interrupts : {false, true}) {
    Board board;
    if (!power_up(board, argv[1], interrupts)) return 2;
    Watched watched[2] = {{interrupts ? "tick_interrupt" : "tick"}, {interrupts ? "hall_interrupt" : "hall"}};
    if (argc == 6) {
      board.records = std::fopen(argv[2], "rb");
      board.request = static_cast<std::uint16_t>(address(argv[3]));
      for (int k = 0; k < 2; ++k) {
        watched[k].at = interrupts ? 4u * (k + 1u) : address(argv[4 + k]);
        watched[k].more = interrupts ? interrupt_response : 0;
      }
    }
    if (const int trouble = go(board, watched); trouble != 0) return trouble;
    for (Watched& w : watched) w.counts.tell(stdout, w.name);
    if (argc == 2) break;
  }
  return 0;
}
