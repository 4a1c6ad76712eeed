#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_sanitizers.sh         runs tests under the address and undefined-behaviour sanitizers (build/ci): the tests of files/, and the
#                             fuzzers, which run drawn scenarios and hostile texts through all rooms in every arithmetic
# check_sanitizers.sh --all   runs the tests of all rooms (ctest --preset long)
set -eu
cd "$(dirname "$0")/.."
. tools/parts.sh
rooms=(base series files fuzz)
# Pages, tools and headers under other compilers are not compiled with the sanitizers.
elsewhere='^control\.(alone|inserted|int_of|single)'
case "$*" in
  '') targets=(drawn_scenarios digest_table libm_planted "${rooms[@]/%/_tests}")
      chosen=(-R "^($(IFS='|'; echo "${rooms[*]}"))\.|^digest\.expected") ;;
  --all) targets=(all) chosen=(-E "^(docs|tools|browser)\.|^firmware\.(configs|cortex_m|avr)$|$elsewhere") ;;
  *) echo "usage: tools/check_sanitizers.sh [--all]   (unknown: $*)" >&2; exit 2 ;;
esac
part "sanitizers: configuring" tools/configure.sh ci
part "sanitizers: building" cmake --build build/ci --target "${targets[@]}"
part "sanitizers: tests" ctest --test-dir build/ci --output-on-failure --no-tests=error -LE long -j2 "${chosen[@]}"
