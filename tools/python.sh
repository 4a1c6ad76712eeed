#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# python.sh [VENV]   installs what is missing, builds the Python package and installs it into a virtual environment
#                    (without VENV: build/venv), which also has Debian's numpy, pandas and matplotlib
set -eu
cd "$(dirname "$0")/.."
case "$*" in
  -*|*' '*) echo "usage: tools/python.sh [VENV]" >&2; exit 2 ;;
esac
venv=${1:-build/venv}
tools/install.sh run python
[ -x "$venv/bin/python" ] || /usr/bin/python3 -m venv --system-site-packages "$venv"
"$venv/bin/python" -m pip install --quiet --no-build-isolation --no-deps --no-index --force-reinstall .
echo "sixstep $("$venv/bin/python" -c 'import sixstep; print(sixstep.__version__)') is in $venv: $venv/bin/python"
