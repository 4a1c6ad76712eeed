#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/configure.sh searches a missing part again, once after each change of the installed packages."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools/configure.sh"


class Configure(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        (self.path / "tools").mkdir()
        shutil.copy(SCRIPT, self.path / "tools/configure.sh")
        (self.path / "bin").mkdir()
        (self.path / "bin/cmake").write_text("#!/bin/sh\necho configured >>calls\n")
        (self.path / "bin/cmake").chmod(0o755)
        self.build = self.path / "build/dev"
        self.build.mkdir(parents=True)
        (self.build / "build.ninja").write_text("")

    def tearDown(self):
        self.folder.cleanup()

    def calls(self, cache):
        (self.build / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={self.path}\n{cache}\n")
        subprocess.run([self.path / "tools/configure.sh", "dev"], check=True, capture_output=True,
                       env={**os.environ, "PATH": f"{self.path}/bin:{os.environ['PATH']}"})
        calls = self.path / "calls"
        return len(calls.read_text().splitlines()) if calls.exists() else 0

    def test_what_was_missing_is_looked_for_once(self):
        found, missing = "SIMAVR_LIBRARY:FILEPATH=/usr/lib/libsimavr.a", "SIMAVR_LIBRARY:FILEPATH=SIMAVR_LIBRARY-NOTFOUND"
        self.assertEqual(self.calls(found), 0)
        self.assertEqual(self.calls(missing), 1)
        if not os.path.exists("/var/lib/dpkg/status"):
            self.skipTest("no list of what is installed: it looks each time")
        self.assertEqual(self.calls(missing), 1, "nothing was installed since")
        past = time.time() - 1e9
        os.utime(self.build / "looked-for-parts", (past, past))
        self.assertEqual(self.calls(missing), 2)
        (self.build / "build.ninja").unlink()
        self.assertEqual(self.calls(found), 3)


if __name__ == "__main__":
    unittest.main()
