#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# sbatch plan.sh PLAN.toml: all runs of a plan on the nodes of a job, into PLAN.sqlite and PLAN.csv beside where it was submitted.
# Short of its time, or preempted, the job ends with what is finished in the store and puts itself into the queue again; by hand it
# goes on with the same command.
#SBATCH --job-name=sixstep
#SBATCH --nodes=4
#SBATCH --ntasks-per-node=1
#SBATCH --cpus-per-task=32
#SBATCH --time=04:00:00
#SBATCH --signal=TERM@120
#SBATCH --requeue
#SBATCH --open-mode=append
set -eu
plan=${1:?usage: sbatch plan.sh PLAN.toml}
name=$(basename "$plan" .toml)
code=0
# One process a node with a thread a core: the first node's has a store, a table and 3 others to speak with, and not 127.
srun --mpi=pmix --kill-on-bad-exit=1 sixstep run "$plan" --jobs "${SLURM_CPUS_PER_TASK:-1}" \
  --store "$name.sqlite" --resume --csv "$name.csv" --force || code=$?
if [ "$code" = 143 ]; then scontrol requeue "$SLURM_JOB_ID"; fi
exit "$code"
