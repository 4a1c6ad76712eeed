# SPDX-License-Identifier: Apache-2.0
"""python -m sixstep: the command line."""
import os
import sys

from .program import program

if __name__ == "__main__":
    os.execv(program(), ["sixstep", *sys.argv[1:]])
