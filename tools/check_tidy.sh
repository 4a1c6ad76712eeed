#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_tidy.sh [BUILD]             clang-tidy over every source file of the product, with the flags of a configured build
# check_tidy.sh [BUILD] --recent    of those that the last 40 commits changed, and for each header that they changed one that
#                                   includes it, the 80 that changed last: the others are what they were when they were looked at
# check_tidy.sh [BUILD] --analyzer  with the path-sensitive analyzer too, whose finds the sanitizers and the fuzzers meet first,
#                                   and the checks that take longest for what they find (ctest --preset long)
set -eu
cd "$(dirname "$0")/.."
build=build/dev recent=
dear=(clang-analyzer-\* bugprone-{reserved-identifier,stringview-nullptr,assert-side-effect,multiple-statement-macro}
  bugprone-suspicious-semicolon performance-unnecessary-value-param)
checks=--checks=$(IFS=,; echo "${dear[*]/#/-}")
for word in "$@"; do
  case $word in
    --analyzer) checks=--checks= ;;
    --recent) recent=40 ;;
    *) build=$word ;;
  esac
done
sources=('sixstep/*.cpp' 'batch/*.cpp' 'text/*.cpp' 'files/*.cpp' 'report/*.cpp' 'faces/*.cpp' ':!faces/firmware' ':!faces/loop/core'
  ':!batch/ranks_with_mpi.cpp')
# A line each, what changed last first; all of them where the history is shorter.
looked_at() {
  if [ -z "$recent" ] || ! git rev-parse -q --verify "HEAD~$recent" >/dev/null; then
    git ls-files "${sources[@]}"
    return
  fi
  git log -n "$recent" --format= --name-only --diff-filter=d -- "${sources[@]}" '*.hpp' | awk '!seen[$0]++' | while read -r file; do
    case $file in
      *.cpp) [ ! -e "$file" ] || echo "$file" ;;
      *) git ls-files -z "${sources[@]}" | xargs -0 grep -lF "#include \"$file\"" | sed 1q ;;
    esac
  done | awk '!seen[$0]++ && ++n <= 80'
}
python3 tools/compile_commands.py "$build" "$build/sources"
looked_at | tr '\n' '\0' | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$build/sources" --quiet "$checks" 2>/dev/null
# MPI is in a build of its own, which need not be there.
[ ! -f build/mpi/compile_commands.json ] || clang-tidy -p build/mpi --quiet "$checks" batch/ranks_with_mpi.cpp 2>/dev/null
# Firmware is in no build for this machine: each example with the flags of its chip, and what a core in the loop runs, with the drive of
# an example.
firmware() {
  clang-tidy --quiet "$checks" "$1" -- "${@:2}" -std=c++20 -ffreestanding -nostdinc++ -I. -Ifaces/firmware/bare 2>/dev/null
}
arm=(--target=thumbv7em-none-eabihf -mcpu=cortex-m4) avr=(--target=avr -mmcu=atmega2560 -DSIXSTEP_ANY_COMPILER)
firmware faces/firmware/example/cortex_m/main.cpp "${arm[@]}" -Ifaces/firmware/example/cortex_m
firmware faces/firmware/example/avr/main.cpp "${avr[@]}" -Ifaces/firmware/example/avr
firmware faces/loop/core/main.cpp "${arm[@]}" -Ifaces/firmware/example/cortex_m -DSIXSTEP_PRODUCT_DRIVE
