# SPDX-License-Identifier: Apache-2.0
"""Builds the Python package: CMake makes the extension and the program, setuptools the wheel."""
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from wheel.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).parent.resolve()
FACE = HERE / "faces" / "python" / "sixstep"
BUILD = HERE / "build" / "python"
# Libraries of every Linux (PEP 600); all others go into the wheel, with their licences.
EVERYWHERE = re.compile(r"(lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s|z)|ld-linux.*)\.so\.\d+")


def bundled(binaries, folder):
    """Copies the libraries that the binaries need beyond those into the folder; the binaries look there first (preset python)."""
    for binary in binaries:
        listed = subprocess.run(["ldd", binary], check=True, capture_output=True, text=True).stdout
        for name, path in re.findall(r"(\S+) => (/\S+)", listed):
            if EVERYWHERE.fullmatch(name) or (folder / name).exists():
                continue
            folder.mkdir(exist_ok=True)
            shutil.copy(path, folder / name)
            owner = subprocess.run(["dpkg", "-S", os.path.realpath(path)], check=True, capture_output=True, text=True).stdout.partition(":")[0]
            shutil.copy(f"/usr/share/doc/{owner}/copyright", folder / f"{name}.licence")


class Wheel(bdist_wheel):
    def get_tag(self):
        """That of the C library that it was built with, which a machine needs at least."""
        python, abi, _ = super().get_tag()
        return python, abi, f"manylinux_{platform.libc_ver()[1].replace('.', '_')}_{platform.machine()}"


class CMakeBuild(build_ext):
    def run(self):
        subprocess.run(["cmake", "--preset", "python", f"-DPython3_EXECUTABLE={sys.executable}"], cwd=HERE, check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["cmake", "--build", str(BUILD), "--target", "sixstep_python", "sixstep_cli"], check=True)
        package = pathlib.Path(self.build_lib) / "sixstep"
        package.mkdir(parents=True, exist_ok=True)
        built = BUILD / "python" / "sixstep"
        for file in [*built.glob("_core*.so"), *FACE.glob("*.py"), *FACE.glob("*.js"), *FACE.glob("*.pyi"), FACE / "py.typed"]:
            shutil.copy(file, package / file.name)
        (package / "bin").mkdir(exist_ok=True)
        shutil.copy(BUILD / "sixstep", package / "bin" / "sixstep")
        bundled([*package.glob("_core*.so"), package / "bin" / "sixstep"], package / "lib")
        shutil.copytree(HERE / "sixstep" / "control", package / "include" / "sixstep" / "control", dirs_exist_ok=True)
        shutil.copytree(HERE / "data" / "motors", package / "data" / "motors", dirs_exist_ok=True)
        shutil.copytree(HERE / "data" / "scenarios", package / "data" / "scenarios", dirs_exist_ok=True)
        shutil.copy(HERE / "LICENSE", package / "LICENSE")

    def get_outputs(self):
        return [str(path) for path in (pathlib.Path(self.build_lib) / "sixstep").rglob("*") if path.is_file()]


version = re.search(r"project\(sixstep VERSION (\S+)", (HERE / "CMakeLists.txt").read_text())[1]
os.chdir(HERE)
setup(version=version, packages=[], ext_modules=[Extension("sixstep._core", sources=[])], cmdclass={"build_ext": CMakeBuild, "bdist_wheel": Wheel})
