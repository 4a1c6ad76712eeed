# SPDX-License-Identifier: Apache-2.0
"""The code of docs/howto/use-from-python.md runs from top to bottom, and its results are checked."""
import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest

import numpy as np
from package import SOURCE


class Page(unittest.TestCase):
    def test_its_code_runs_and_gives_what_it_says(self):
        code = re.findall(r"^```python\n(.*?)^```$", (SOURCE / "docs/howto/use-from-python.md").read_text(), re.M | re.S)
        self.assertGreater(len(code), 6)
        names, printed = {}, io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(printed):
            os.symlink(SOURCE / "data", pathlib.Path(folder) / "data")
            home = os.getcwd()
            os.chdir(folder)
            try:
                os.environ["MPLBACKEND"] = "Agg"
                for block in code:
                    exec(compile(block, "use-from-python.md", "exec"), names)
                self.assertGreater((pathlib.Path(folder) / "speed.png").stat().st_size, 5000)
            finally:
                os.chdir(home)
        self.assertIn("must be", printed.getvalue())
        self.assertTrue(names["design"].ok)
        self.assertEqual(len(names["table"]), 6)
        self.assertTrue(0.5e-3 <= names["found"].x <= 3e-3)
        self.assertTrue(names["result"].complete)
        self.assertAlmostEqual(float(names["r"].speed[-1]), 200, delta=20)
        self.assertEqual(names["total"].shape, (64,))
        # The reward is the negative distance. A larger gain gives a smaller distance, until the current limit acts.
        self.assertGreater(names["total"].argmax(), 5)
        self.assertTrue(np.isfinite(names["total"]).all())


if __name__ == "__main__":
    unittest.main()
