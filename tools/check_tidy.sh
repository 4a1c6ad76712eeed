#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_tidy.sh [BUILD]             runs clang-tidy on the whole product, with the batches and flags of a configured build. A header is
#                                   read once for many sources, which takes a fifth of the time
# check_tidy.sh [BUILD] --analyzer  checks each source alone, with the slow checks: the path-sensitive analyzer, and checks that rarely
#                                   find an error. Sanitizers and fuzzers usually find these errors first (ctest --preset long)
set -eu
cd "$(dirname "$0")/.."
build=build/dev alone=
for word in "$@"; do
  case $word in
    --analyzer) alone=yes ;;
    *) build=$word ;;
  esac
done
dear=(clang-analyzer-\* bugprone-{reserved-identifier,stringview-nullptr,assert-side-effect,multiple-statement-macro}
  bugprone-suspicious-semicolon performance-unnecessary-value-param)
checks=--checks=$(IFS=,; echo "${dear[*]/#/-}")
# A batch includes several sources, and a name of one source may hide a name of another source.
in_batches=("$checks,-bugprone-suspicious-include" --extra-arg=-Wno-shadow)
# Some of the flags are only for GCC, and clang would warn of each.
tidy() { clang-tidy --quiet --extra-arg=-Wno-unused-command-line-argument "$@" 2>/dev/null; }
export -f tidy

if [ -n "$alone" ]; then
  checks=--checks=
  python3 tools/compile_commands.py "$build" "$build/sources"
  git ls-files -z 'sixstep/*.cpp' 'batch/*.cpp' 'text/*.cpp' 'files/*.cpp' 'report/*.cpp' 'faces/*.cpp' ':!faces/firmware' ':!faces/loop/core' \
    ':!batch/ranks_with_mpi.cpp' | xargs -0 -n 1 -P "$(nproc)" bash -c 'tidy -p "$0" --checks= "$1"' "$build/sources"
else
  # Sources of the product, without tests, benchmarks and users' controllers.
  python3 -c 'import json, sys; print("\n".join(sorted({entry["file"] for entry in json.load(sys.stdin)})))' <"$build/compile_commands.json" |
    grep -vE "^$PWD/data/|/(tests|benchmarks)/" | tr '\n' '\0' |
    xargs -0 -n 1 -P "$(nproc)" bash -c 'tidy -p "$0" "$1" "$2" "$3"' "$build" "${in_batches[@]}"
fi
# MPI is in a separate build, which may be missing.
[ ! -f build/mpi/compile_commands.json ] || tidy -p build/mpi "$checks" batch/ranks_with_mpi.cpp
# Firmware is in no build for this machine. Each example is checked with the flags of its chip, and the program of a core in the loop
# with the drive of an example.
firmware() {
  tidy "$checks" "$1" -- "${@:2}" -std=c++20 -ffreestanding -nostdinc++ -I. -Ifaces/firmware/bare
}
arm=(--target=thumbv7em-none-eabihf -mcpu=cortex-m4) avr=(--target=avr -mmcu=atmega2560 -DSIXSTEP_ANY_COMPILER)
firmware faces/firmware/example/cortex_m/main.cpp "${arm[@]}" -Ifaces/firmware/example/cortex_m
firmware faces/firmware/example/avr/main.cpp "${avr[@]}" -Ifaces/firmware/example/avr
firmware faces/loop/core/main.cpp "${arm[@]}" -Ifaces/firmware/example/cortex_m -DSIXSTEP_PRODUCT_DRIVE
