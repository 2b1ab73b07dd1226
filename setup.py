"""Builds the extension module by CMake; the rest is in pyproject.toml."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build, target = pathlib.Path(self.build_temp).resolve(), pathlib.Path(self.get_ext_fullpath(ext.name))
        off = [f"-DSIGMAX_{part}=OFF" for part in ("BUILD_APPS", "BUILD_TESTS", "INSTALL")]
        python = [f"-D{name}_EXECUTABLE={sys.executable}" for name in ("Python3", "PYTHON")]
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DSIGMAX_PYTHON=ON", *off, *python]
        subprocess.run(["cmake", "-S", root, "-B", build, *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "sigmax_python", f"-j{os.cpu_count()}"], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(build / "python" / "sigmax" / target.name, target)


version = re.search(r"project\(sigmax VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]
setup(version=version, ext_modules=[Extension("sigmax._sigmax", [])], cmdclass={"build_ext": CMakeBuild})
