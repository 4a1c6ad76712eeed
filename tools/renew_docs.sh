#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# tools/renew_docs.sh [PROGRAM] [--screenshots]   renews the program's output in the documents: the page of all keys,
# the gallery with its pictures, the tables of the cores, the example's headers, and the printed blocks of every page. With --screenshots also the photographed pages, which
# need Chromium (tools/install.sh test). Look at `git diff` afterwards: only intended changes may appear.
set -eu
cd "$(dirname "$0")/.."
program=build/release/sixstep
if [ $# -gt 0 ] && [ "$1" != --screenshots ]; then
  program=$1
  shift
fi
tools/scenario_reference.py "$program"
tools/core_tables.py
for header in faces/firmware/example/*/drive_config.hpp; do
  arguments=$(sed -n 's|^//   sixstep ||p' "$header")
  eval "$program $arguments" >/dev/null
  sed -i '1i // SPDX-License-Identifier: Apache-2.0' "$header"
done
tools/gallery.py "$program"
tools/position_table.py "$program" --renew
"$program" motor wiring maxon-251601 --svg docs/images/wiring.svg --quiet --force
tests/docs/pages_test.py "$program" --renew
if [ "${1:-}" = --screenshots ]; then
  node tools/picture.mjs "$program"
fi
