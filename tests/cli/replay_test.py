#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program runs the file of an exported session. The digest is equal to the digest of the session."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()


class Replay(unittest.TestCase):
    def test_an_exported_session_runs_to_its_digest(self):
        file = SOURCE / "tests/session/exported.toml"
        expected = re.search(r"^# digest ([0-9a-f]+)$", file.read_text(encoding="utf-8"), re.M)[1]
        done = subprocess.run([PROGRAM, "run", file, "--json", "-"], capture_output=True, text=True, check=True)
        self.assertEqual(json.loads(done.stdout)["digest"], expected)


if __name__ == "__main__":
    del sys.argv[1:3]
    unittest.main()
