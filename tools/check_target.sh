#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_target.sh          checks the controller on emulated cores: its bits (tests/target/digests.txt); flash, RAM and library calls of
#                          drives and blocks (data/cores/); programs on an emulated chip; images
# check_target.sh PART..   only these parts: proof, sights (coverage of the walk's inputs, checked when its digests are renewed), bits,
#                          costs and blocks (instructions of a control tick and of a block, data/cores/), sizes, own (users'
#                          controllers, tools/own_cost.sh), loop (sixstep run --on), avr (--on avr), images (to flash)
# check_target.sh --all [PART..]    also checks armhf and aarch64, a million steps on emulated hosts, and every drive's costs (ctest --preset long)
# check_target.sh --renew [PART..]  writes the tables anew, after an intended change
#
# Processors, compilers and flags: tests/target/cores.py. tools/install.sh target installs them.
set -eu
cd "$(dirname "$0")/.."
. tools/parts.sh
tools/configure.sh dev
part "on chips: building" cmake --build build/dev --target sixstep_cli sixstep_avr_board target_record
export PYTHONDONTWRITEBYTECODE=1
how=
case "${1:-}" in --renew | --all) how=$1; shift ;; esac
status=0
for part in ${*:-proof bits sizes own loop avr images}; do
  part "on chips: $part" python3 tests/target/check.py $how "$part" || status=1
done
exit $status
