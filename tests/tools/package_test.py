#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""package_test.py BUILD: cpack makes the Debian packages of a build, and lintian reports nothing about them."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else ROOT / "build/release"
VERSION = re.search(r"(?m)^project\(sixstep VERSION (\S+) ", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


def said(*words):
    return subprocess.run(words, capture_output=True, text=True, check=True, timeout=600).stdout


@unittest.skipUnless(shutil.which("dpkg-shlibdeps") and shutil.which("lintian"), "tools/install.sh release")
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        said("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", folder.name)
        cls.files = {file.name.partition("_")[0]: file for file in pathlib.Path(folder.name).glob("*.deb")}

    def field(self, package, name):
        return said("dpkg-deb", "-f", self.files[package], name).strip()

    def test_names_and_what_they_depend_on(self):
        architecture = said("dpkg", "--print-architecture").strip()
        self.assertEqual(self.files["sixstep"].name, f"sixstep_{VERSION}_{architecture}.deb")
        for package in self.files:
            self.assertEqual(self.field(package, "Version"), VERSION)
            if package != "libsixstep-dev":
                self.assertIn("libstdc++6", self.field(package, "Depends"))
        self.assertNotIn("simavr", self.field("sixstep", "Depends"))
        if "sixstep-avr-board" in self.files:
            self.assertRegex(self.field("sixstep-avr-board", "Depends"), rf"sixstep \(= {re.escape(VERSION)}\).*libsimavr")

    def test_the_library_is_found_by_its_soname(self):
        if "libsixstep1" not in self.files:
            self.skipTest("built without libsixstep: cmake --preset release -DSIXSTEP_C=ON")
        control = said("sh", "-c", f"dpkg-deb --ctrl-tarfile '{self.files['libsixstep1']}' | tar xO ./shlibs ./triggers")
        self.assertIn(f"libsixstep 1 libsixstep1 (= {VERSION})", control)
        self.assertIn("ldconfig", control)
        self.assertIn(f"libsixstep1 (= {VERSION})", self.field("libsixstep-dev", "Depends"))

    def test_all_belongs_to_root_and_may_be_read(self):
        for file in self.files.values():
            for line in said("dpkg-deb", "-c", file).splitlines():
                self.assertRegex(line, r"^(?:drwxr-xr-x|-rw[x-]r-[x-]r-[x-]|lrwxrwxrwx) root/root ")
                self.assertRegex(line, r" \./(?:usr/|$)")

    def test_lintian_is_silent(self):
        done = subprocess.run(["lintian", *self.files.values()], capture_output=True, text=True, check=False, timeout=600)
        self.assertEqual((done.returncode, done.stdout), (0, ""))


if __name__ == "__main__":
    unittest.main()
