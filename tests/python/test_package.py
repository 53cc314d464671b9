"""The package as a whole: its stubs, its words, and the wheel."""
import ast
import inspect
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import poolhall
from poolhall import _core

from conftest import BUILD, ROOT

PACKAGE = ROOT / "clients" / "python" / "poolhall"


def stub_names(nodes):
    names = {}
    for node in nodes:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            names[node.target.id] = node
    return names


def public(thing):
    return {name for name in vars(thing) if not name.startswith("__")}


def test_the_stubs_have_the_names_that_the_extension_has():
    stub = stub_names(ast.parse((PACKAGE / "_core.pyi").read_text()).body)
    there = {name for name in public(_core)} | {"__version__"}
    assert {n for n in stub if not (n.startswith("_") and n[1].isupper())} == there
    for name in ("Table", "Simulation", "GameState"):
        assert set(stub_names(stub[name].body)) - {"__init__"} == public(getattr(_core, name))


def test_the_stubs_have_the_parameters_that_the_functions_have():
    stub = stub_names(ast.parse((PACKAGE / "_core.pyi").read_text()).body)
    for name, node in stub.items():
        if isinstance(node, ast.FunctionDef) and not name.startswith("_"):
            told = [a.arg for a in node.args.args + node.args.kwonlyargs]
            line = getattr(_core, name).__doc__.splitlines()[0]
            assert [a for a in told if f"{a}:" in line] == told, line


def test_everything_public_is_documented():
    for name in poolhall.__all__:
        thing = getattr(poolhall, name)
        if callable(thing) or inspect.ismodule(thing):
            assert thing.__doc__, name
    for thing in (_core.Simulation, poolhall.Outcomes, poolhall.env.PoolEnv, poolhall.Client):
        assert thing.__doc__
    assert set(poolhall.__all__) <= set(dir(poolhall))


def test_the_error_codes_are_the_wire_s():
    page = (ROOT / "protocol" / "README.md").read_text()
    for number, name, _, meaning in _core.error_registry:
        assert f"| {number} | `{name}` |" in page and meaning in page


def test_the_wheel_installs_and_plays(tmp_path):
    environment = {**os.environ, "POOLHALL_BUILD": str(BUILD), "PIP_NO_INDEX": "1",
                   "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PYTHONPATH": ""}

    def run(*arguments):
        done = subprocess.run([sys.executable, *map(str, arguments)], env=environment, text=True,
                              capture_output=True, cwd=tmp_path)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    source = tmp_path / "clients" / "python"
    source.mkdir(parents=True)
    for name in ("setup.py", "pyproject.toml", "poolhall"):
        (source / name).symlink_to(ROOT / "clients" / "python" / name)
    run("-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "-w", tmp_path / "wheels", source)
    wheel, = (tmp_path / "wheels").glob("poolhall-*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert {"poolhall/py.typed", "poolhall/_core.pyi", "poolhall/client.py"} <= set(names)
    run("-m", "pip", "install", "--no-deps", "--target", tmp_path / "site", wheel)
    environment["PYTHONPATH"] = str(tmp_path / "site")
    told = run("-c", "import poolhall, poolhall.env, poolhall.client; b = poolhall.new_game().balls;"
               "b[0] = 0.5, 0.4; print(poolhall.__file__);"
               "print(poolhall.simulate(b, poolhall.Shot(0, 3, 10, 87, 9)).ending)")
    where, ending = told.splitlines()
    assert Path(where).is_relative_to(tmp_path) and ending == "at_rest"


def test_an_example_uses_the_standard_library_alone():
    tree = ast.parse((ROOT / "clients" / "python" / "example_bot.py").read_text())
    imported = {a.name.split(".")[0] for n in ast.walk(tree) if isinstance(n, ast.Import)
                for a in n.names}
    assert imported <= set(sys.stdlib_module_names)
