#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_tidy.sh [BUILD]: clang-tidy over every source file of the product, with the flags of a configured build.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/dev}
git ls-files -z 'sixstep/*.cpp' 'batch/*.cpp' 'io/*.cpp' 'faces/*.cpp' |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet 2>/dev/null
