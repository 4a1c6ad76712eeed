#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# own_cost.sh SOURCE [SCENARIO]   costs of a user's controller on emulated Cortex-M, RISC-V and ATmega2560 cores: instructions of a step and
#                                 of a Hall interrupt, flash and RAM (docs/howto/write-a-controller.md)
# own_cost.sh --help              further options; needs the compilers of tools/install.sh target
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
if [ ! -f "$root/tests/target/own_cost.py" ]; then
    echo "tools/own_cost.sh needs a checkout: $root has no tests/target; clone the sources, then run tools/install.sh target there" >&2
    exit 2
fi
case " $* " in *" --program "* | *" --help "*) ;; *) "$root/run" --version >/dev/null ;; esac
export PYTHONDONTWRITEBYTECODE=1
exec python3 "$root/tests/target/own_cost.py" "$@"
