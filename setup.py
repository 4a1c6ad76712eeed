# SPDX-License-Identifier: Apache-2.0
"""Builds the Python package: CMake makes the extension and the program, setuptools the wheel."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).parent.resolve()
FACE = HERE / "faces" / "python" / "sixstep"
BUILD = HERE / "build" / "python"


class CMakeBuild(build_ext):
    def run(self):
        subprocess.run(["cmake", "--preset", "python", f"-DPython3_EXECUTABLE={sys.executable}"], cwd=HERE, check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["cmake", "--build", str(BUILD), "--target", "sixstep_python", "sixstep_cli"], check=True)
        package = pathlib.Path(self.build_lib) / "sixstep"
        package.mkdir(parents=True, exist_ok=True)
        built = BUILD / "python" / "sixstep"
        for file in [*built.glob("_core*.so"), *FACE.glob("*.py"), *FACE.glob("*.pyi"), FACE / "py.typed"]:
            shutil.copy(file, package / file.name)
        (package / "bin").mkdir(exist_ok=True)
        shutil.copy(BUILD / "sixstep", package / "bin" / "sixstep")
        own = package / "include" / "sixstep" / "control" / "own"
        shutil.copytree(HERE / "sixstep" / "control" / "own", own, dirs_exist_ok=True)
        shutil.copytree(HERE / "data" / "motors", package / "data" / "motors", dirs_exist_ok=True)
        shutil.copytree(HERE / "data" / "scenarios", package / "data" / "scenarios", dirs_exist_ok=True)
        shutil.copy(HERE / "LICENSE", package / "LICENSE")

    def get_outputs(self):
        return [str(path) for path in (pathlib.Path(self.build_lib) / "sixstep").rglob("*") if path.is_file()]


version = re.search(r"project\(sixstep VERSION (\S+)", (HERE / "CMakeLists.txt").read_text())[1]
os.chdir(HERE)
setup(version=version, packages=[], ext_modules=[Extension("sixstep._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
