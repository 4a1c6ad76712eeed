// SPDX-License-Identifier: Apache-2.0
// The cluster that mpirun or srun starts. MPI where the build has it (SIXSTEP_MPI); without it a process that is one of several
// says so. MPI is a process's, not an object's: all of this happens once.
#pragma once
#include <string>

#include "batch/cluster.hpp"
#include "batch/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace batch {

/// What the launcher's environment says: OMPI_COMM_WORLD_*, PMI_*, or PMIX_RANK with Slurm's count.
struct Started {
  unsigned rank = 0, size = 1;
};
Started started();

/// Alone where one process was started, and then nothing of MPI is touched.
base::Result<Cluster> join_ranks();

/// The last thing that a process of several does: waits until all have come so far. Without it mpirun takes the process for lost,
/// and ends the others.
void part();

}  // namespace batch
