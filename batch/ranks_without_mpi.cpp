// SPDX-License-Identifier: Apache-2.0
#include "batch/ranks.hpp"

namespace batch {

base::Result<Cluster> join_ranks() {
  const Started s = started();
  if (s.size <= 1) return Cluster{};
  return base::Problem{
      "mpirun:", "",
      "started " + std::to_string(s.size) +
          " processes, but this build has no MPI, so that each process would make all runs",
      "build with MPI (cmake --preset mpi && cmake --build build/mpi), or start one process"};
}

void part() {}

}  // namespace batch
