"""Builds the wheel: the package and its extension, which CMake makes from the house's own sources.

    python3 -m pip wheel --no-build-isolation --no-deps clients/python

Needs cmake, ninja-build, g++, pybind11-dev, python3-dev, nlohmann-json3-dev, libexpected-dev and
librandom123-dev, and no network. With POOLHALL_BUILD=DIR the extension comes from that build tree
(`build/release`), where it is made if it is not there yet.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent
root = here.parent.parent
version = re.search(r"project\(poolhall VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text())[1]


class CMakeExtension(build_ext):
    def build_extension(self, extension):
        given = os.environ.get("POOLHALL_BUILD")
        tree = Path(given).resolve() if given else Path(self.build_temp).resolve()
        if not given:
            tree.mkdir(parents=True, exist_ok=True)
            subprocess.check_call([
                "cmake", "--preset", "release", "-S", str(root), "-B", str(tree),
                "-DPOOLHALL_PARTS=python", f"-DPython_EXECUTABLE={sys.executable}"], cwd=root)
        subprocess.check_call(["cmake", "--build", str(tree), "--target", "poolhall_python"])
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(tree / "python" / "poolhall" / target.name, target)


setup(
    name="poolhall",
    version=version,
    description="Computational pool: physics, referee, and a client for Poolhall's server",
    license="Apache-2.0",
    python_requires=">=3.9",
    install_requires=["numpy>=1.21"],
    packages=["poolhall"],
    package_data={"poolhall": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("poolhall._core", [])],
    cmdclass={"build_ext": CMakeExtension},
    zip_safe=False,
)
