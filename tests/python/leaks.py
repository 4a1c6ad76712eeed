# SPDX-License-Identifier: Apache-2.0
"""leaks.py (ctest --preset long): a hundred runs, sessions, controllers and environments under valgrind. The
extension loses no memory and accesses no memory of others."""
import os
import re
import subprocess
import sys
import tempfile

WORK = """
import sixstep
s = sixstep.Scenario(motor="maxon-251601", duration_s=3e-4, control={"mode": "current"}, reference={"value": 2, "unit": "A"})
for n in range(100):
    r = sixstep.run(s, events=n % 2 == 0)
    r.i_a, r.summary, r.digest
    if n % 5 == 0:
        session = sixstep.Session(s)
        session.advance(1e-4)
        session.copy().close()
        session.close()
        sixstep.run(s, lambda m, setpoint: 0.1)
    if n % 20 == 0:
        env = sixstep.Env(s, drives=2, workers=2)
        env.reset()
        env.step([[0.1], [0.2]])
        try:
            sixstep.Scenario("motor = 1")
        except sixstep.ScenarioError:
            pass
"""

with tempfile.NamedTemporaryFile("r") as log:
    words = ["valgrind", "--leak-check=full", "--show-leak-kinds=definite", "--num-callers=40", f"--log-file={log.name}", sys.executable, "-c", WORK]
    subprocess.run(words, check=True, env={**os.environ, "PYTHONMALLOC": "malloc"})
    told = re.sub(r"(?m)^==\d+== ?", "", log.read())
# valgrind reports false errors for Python's own memory. Only reports with a function of the extension count.
blocks = [block for block in told.split("\n\n") if "_core." in block and re.search("definitely lost|Invalid (read|write)|uninitialised", block)]
for block in blocks:
    print(block, "\n")
sys.exit(1 if blocks or "ERROR SUMMARY" not in told else 0)
