"""docs/tutorial.md: every file of it is typed in as it stands there, and plays."""
import re
import subprocess
import sys

import pytest

from conftest import BUILD, ROOT

PAGE = (ROOT / "docs" / "tutorial.md").read_text()
#: name: text, from the blocks whose first line names a file.
FILES = {name: block for block, name in re.findall(
    r"^```\w+\n((?:#|//) ([\w.]+\.\w+)\n.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)}


@pytest.fixture
def typed_in(tmp_path):
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def run(*arguments, cwd, **environment):
    done = subprocess.run([str(a) for a in arguments], cwd=cwd, text=True, capture_output=True,
                          env={"PATH": "/usr/bin:/bin", "PYTHONPATH": str(BUILD / "python"),
                               **environment}, timeout=280)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_has_the_files_that_it_speaks_of():
    assert set(FILES) == {"first.py", "plays.py", "pots.py", "pots.cpp", "CMakeLists.txt"}


def test_the_first_shot_is_told(typed_in):
    told = run(sys.executable, "first.py", cwd=typed_in)
    assert told.startswith("first ball struck: 3 after") and "0.0000 s cue_strike [0]" in told
    assert re.search(r"goes down in \d+ of 1000 shots", told)


def test_the_bot_that_plays_plays_a_game(typed_in, server):
    told = run(sys.executable, "plays.py", server.address, cwd=typed_in)
    assert "GameEnd(" in told and "opponent='house:random'" in told and "timeout" not in told


def test_the_bot_that_pots_plays_a_game(typed_in, server):
    told = run(sys.executable, "pots.py", server.address, cwd=typed_in)
    assert told.splitlines()[-1].split()[0] in ("won", "not") and "timeout" not in told
    assert "bad_" not in told and "invalid_params" not in told  # nothing was refused


def test_the_bot_in_cpp_plays_a_game_against_the_installed_package(typed_in, server):
    run("cmake", "--install", BUILD, "--component", "development", "--prefix", typed_in / "usr",
        cwd=typed_in)
    run("cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=",
        f"-DCMAKE_PREFIX_PATH={typed_in / 'usr'}", cwd=typed_in)
    run("cmake", "--build", "build", cwd=typed_in)
    told = run("build/pots", server.address.split(":")[1], cwd=typed_in)
    assert re.search(r"^(won|not won, )\w+$", told, re.MULTILINE) and "all games are played" in told


def test_the_physics_page_s_pictures_are_the_program_s(tmp_path, program):
    folder = ROOT / "docs" / "physics"
    run(sys.executable, folder / "pictures.py", "--program", program, "--into", tmp_path,
        cwd=tmp_path)
    made = sorted(path.name for path in tmp_path.glob("*.svg"))
    assert made == sorted(path.name for path in folder.glob("*.svg"))
    for name in made:
        assert (tmp_path / name).read_text() == (folder / name).read_text(), name
    page = (ROOT / "docs" / "physics.md").read_text()
    assert all(f"physics/{name}" in page for name in made)
