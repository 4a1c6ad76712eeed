# SPDX-License-Identifier: Apache-2.0
"""Every public name has a docstring with an example, and the test executes the example. The declared types pass mypy
--strict."""
import doctest
import importlib
import inspect
import os
import pathlib
import pkgutil
import shutil
import subprocess
import unittest

import sixstep
from package import SOURCE

FACE = SOURCE / "faces" / "python" / "sixstep"
# Names without a short example: errors, a measurement that only a controller receives, and studies of many seconds (run_test.py
# tests these).
WITHOUT = {"Interrupted", "Measured", "ProgramError", "__version__", "compare", "wiring"}


class Docstrings(unittest.TestCase):
    def test_every_public_name_is_described(self):
        for name in sixstep.__all__:
            told = getattr(sixstep, name)
            if name != "__version__":
                self.assertTrue(inspect.getdoc(told), name)
            if name not in WITHOUT:
                self.assertIn(">>>", inspect.getdoc(told), name)

    def test_every_public_method_is_described(self):
        for name in sixstep.__all__:
            told = getattr(sixstep, name)
            if inspect.isclass(told) and told.__module__.startswith("sixstep") and not issubclass(told, tuple):
                for method, function in vars(told).items():
                    if not method.startswith("_") and (inspect.isfunction(function) or isinstance(function, (property, staticmethod))):
                        self.assertTrue(inspect.getdoc(function), f"{name}.{method}")

    def test_examples_do_what_they_say(self):
        tried = 0
        for module in [sixstep, *[importlib.import_module(f"sixstep.{m.name}") for m in pkgutil.iter_modules(sixstep.__path__)
                                  if m.name not in ("__main__", "_core")]]:
            result = doctest.testmod(module, optionflags=doctest.ELLIPSIS)
            self.assertEqual(result.failed, 0, module.__name__)
            tried += result.attempted
        self.assertGreater(tried, 30)

    @unittest.skipUnless(shutil.which("mypy") or pathlib.Path("/usr/bin/mypy").exists(), "mypy is missing")
    def test_declared_types_hold(self):
        mypy = "/usr/bin/mypy" if pathlib.Path("/usr/bin/mypy").exists() else "mypy"
        made = subprocess.run([mypy, "--config-file", SOURCE / "pyproject.toml", "--cache-dir", os.devnull, FACE], capture_output=True, text=True,
                              cwd=FACE.parent, env={**os.environ, "MYPYPATH": str(FACE.parent)}, check=False)
        self.assertEqual(made.returncode, 0, made.stdout)


if __name__ == "__main__":
    unittest.main()
