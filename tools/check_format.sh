#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# check_format.sh [--fix]: checks every C++ file of the project against .clang-format. Untracked files count too.
set -eu
cd "$(dirname "$0")/.."
files() { git ls-files -z --cached --others --exclude-standard -- '*.cpp' '*.hpp' | while IFS= read -r -d '' f; do [ ! -f "$f" ] || printf '%s\0' "$f"; done; }
if [ "${1:-}" = --fix ]; then
  files | xargs -0 -r clang-format -i
  exit
fi
if ! files | xargs -0 -r -n 25 -P 2 clang-format --dry-run --Werror --ferror-limit=2; then
  echo "format: tools/check_format.sh --fix mends the files above" >&2
  exit 1
fi
