// SPDX-License-Identifier: Apache-2.0
// Joins the cluster that mpirun or srun starts. Uses MPI if the build contains it (SIXSTEP_MPI). Without MPI,
// a process that was started together with other processes reports a Problem. A process can initialise MPI
// only once, so each function is called only once.
#pragma once
#include <string>

#include "batch/cluster.hpp"
#include "batch/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace batch {

/// Rank and size from the launcher's environment: OMPI_COMM_WORLD_*, PMI_*, or PMIX_RANK with Slurm's count.
struct Started {
  unsigned rank = 0, size = 1;
};
Started started();

/// Joins the cluster. If only one process was started, returns a cluster of one, without MPI.
base::Result<Cluster> join_ranks();

/// The last call of a process: waits until all processes have called it. Without this call, mpirun considers
/// the process lost and ends the other processes.
void part();

}  // namespace batch
