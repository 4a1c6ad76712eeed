// SPDX-License-Identifier: Apache-2.0
#include <mpi.h>

#include <chrono>
#include <list>
#include <memory>
#include <thread>
#include <utility>

#include "batch/ranks.hpp"

namespace batch {
namespace {

/// Stores outgoing messages: MPI reads the bytes of a message until the message has been sent.
class Outbox {
 public:
  void send(unsigned to, std::string bytes) {
    sweep();
    Letter& letter = letters_.emplace_back(Letter{std::move(bytes), MPI_REQUEST_NULL});
    MPI_Isend(letter.bytes.data(), static_cast<int>(letter.bytes.size()), MPI_BYTE, static_cast<int>(to), 0,
              MPI_COMM_WORLD, &letter.request);
  }
  /// Removes the messages that have been sent. Returns whether none is left.
  bool sweep() {
    for (auto letter = letters_.begin(); letter != letters_.end();) {
      int gone = 0;
      MPI_Test(&letter->request, &gone, MPI_STATUS_IGNORE);
      letter = gone != 0 ? letters_.erase(letter) : std::next(letter);
    }
    return letters_.empty();
  }

 private:
  struct Letter {
    std::string bytes;
    MPI_Request request;
  };
  std::list<Letter> letters_;  // a list, because the messages must not move in memory
};

Outbox& outbox() {
  static Outbox letters;
  return letters;
}

std::optional<Mail> receive() {
  outbox().sweep();
  int there = 0;
  MPI_Message message;
  MPI_Status status;
  MPI_Improbe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &there, &message, &status);
  if (there == 0) return {};
  int length = 0;
  MPI_Get_count(&status, MPI_BYTE, &length);
  Mail mail{static_cast<unsigned>(status.MPI_SOURCE), std::string(static_cast<std::size_t>(length), '\0')};
  MPI_Mrecv(mail.bytes.data(), length, MPI_BYTE, &message, MPI_STATUS_IGNORE);
  return mail;
}

}  // namespace

base::Result<Cluster> join_ranks() {
  if (started().size <= 1) return Cluster{};
  // The provided level of thread support is ignored, because only one thread calls MPI.
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return Cluster{.rank = static_cast<unsigned>(rank),
                 .size = static_cast<unsigned>(size),
                 .send = [](unsigned to, std::string bytes) { outbox().send(to, std::move(bytes)); },
                 .receive = receive};
}

void part() {
  int joined = 0;
  MPI_Initialized(&joined);
  if (joined == 0) return;
  while (!outbox().sweep()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  MPI_Finalize();
}

}  // namespace batch
