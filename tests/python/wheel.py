# SPDX-License-Identifier: Apache-2.0
"""wheel.py SOURCE (ctest --preset long): builds a wheel from a copy of the sources. The wheel has the right tag, and
contains its licences, data and the libraries that some Linux systems lack. It runs in its own environment."""
import os
import pathlib
import platform
import re
import subprocess
import sys
import sysconfig
import tempfile
import unittest
import zipfile

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
POLICY = {"libc.so.6", "libm.so.6", "libdl.so.2", "librt.so.1", "libpthread.so.0", "libstdc++.so.6", "libgcc_s.so.1", "libz.so.1",
          "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}  # the libraries that PEP 600 allows
TEN_LINES = """
import matplotlib
matplotlib.use("Agg")
import sixstep
s = sixstep.shipped("thesis/7.4-speed-thesis-gains")
r = sixstep.run(s)
print(r)
assert r.passed
r.plot("speed", "i_a").savefig("speed.png")
"""


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)
        subprocess.run([sys.executable, "-m", "pip", "wheel", "--quiet", "--no-build-isolation", "--no-deps", "--no-index", "-w", cls.path, "."],
                       cwd=SOURCE, check=True)
        cls.wheel = next(cls.path.glob("*.whl"))
        with zipfile.ZipFile(cls.wheel) as opened:
            opened.extractall(cls.path / "content")
            cls.names = opened.namelist()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_tag_is_that_of_this_python_and_its_c_library(self):
        _, version, python, abi, machine = self.wheel.stem.split("-")
        self.assertEqual((python, abi), (f"cp{sysconfig.get_config_var('py_version_nodot')}",) * 2)
        self.assertEqual(machine, f"manylinux_{platform.libc_ver()[1].replace('.', '_')}_{platform.machine()}")
        self.assertIn(f"VERSION {version}", (SOURCE / "CMakeLists.txt").read_text())

    def test_each_binary_needs_what_every_linux_has_or_what_lies_beside_it(self):
        here = {pathlib.Path(name).name for name in self.names if name.startswith("sixstep/lib/")}
        most = tuple(map(int, platform.libc_ver()[1].split(".")))
        binaries = [self.path / "content" / n for n in self.names if re.search(r"(_core.*\.so|bin/sixstep|lib/[^/]*\.so\.\d+)$", n)]
        self.assertGreater(len(binaries), 3)
        for binary in binaries:
            told = subprocess.run(["readelf", "-dV", binary], check=True, capture_output=True, text=True).stdout
            needed = set(re.findall(r"Shared library: \[(.*)\]", told))
            self.assertLessEqual(needed, POLICY | here, binary)
            asked = [tuple(map(int, v.split("."))) for v in re.findall(r"Name: GLIBC_([\d.]+) ", told)]
            self.assertLessEqual(max(asked), most)
            if needed & here:
                self.assertIn("$ORIGIN", told, binary)

    def test_licences_and_data_are_there(self):
        for name in ("sixstep/LICENSE", "sixstep/data/motors/maxon-251601.toml", "sixstep/py.typed", "sixstep/chart.js"):
            self.assertIn(name, self.names)
        libraries = [n for n in self.names if n.startswith("sixstep/lib/") and ".so." in n and not n.endswith(".licence")]
        for name in libraries:
            self.assertIn(f"{name}.licence", self.names)

    def test_ten_lines_run_in_an_environment_of_its_own(self):
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", self.path / "venv"], check=True)
        python = self.path / "venv/bin/python"
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", self.wheel], check=True)
        subprocess.run([python, "-c", TEN_LINES], cwd=self.path, check=True, env={k: v for k, v in os.environ.items() if k != "PYTHONPATH"})
        self.assertGreater((self.path / "speed.png").stat().st_size, 10_000)
        loaded = subprocess.run([python, "-c", "import sixstep, pathlib; print(pathlib.Path('/proc/self/maps').read_text())"], cwd=self.path,
                                capture_output=True, text=True, check=True).stdout
        self.assertRegex(loaded, r"/sixstep/lib/libfmt\.so")


if __name__ == "__main__":
    unittest.main()
