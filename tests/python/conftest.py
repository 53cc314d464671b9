"""The package of the release build, and the program beside it.

    /usr/bin/python3 -m pytest tests/python        # POOLHALL_BUILD=build/release
"""
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("POOLHALL_BUILD", ROOT / "build" / "release")).resolve()
PROGRAM = Path(os.environ.get("POOLHALL_PROGRAM", BUILD / "poolhall"))
sys.path.insert(0, str(BUILD / "python"))


class Server:
    """`poolhall serve` on free ports, with a database of its own."""

    def __init__(self, directory, *arguments, listen="127.0.0.1:0"):
        self.directory = Path(directory)
        self.arguments = [str(a) for a in arguments]
        self.start(listen)

    def start(self, listen):
        ready = self.directory / "ready.json"
        ready.unlink(missing_ok=True)
        self.log = open(self.directory / "server.log", "ab")
        self.process = subprocess.Popen(
            [PROGRAM, "serve", "--listen", listen, "--http", "127.0.0.1:0", "--db",
             self.directory / "server.db", "--ready-file", ready, *self.arguments],
            stdout=self.log, stderr=self.log)
        while not ready.exists() or not ready.read_text().endswith("\n"):
            if self.process.poll() is not None:
                raise RuntimeError((self.directory / "server.log").read_text())
            try:
                self.process.wait(0.02)
            except subprocess.TimeoutExpired:
                pass
        told = json.loads(ready.read_text())
        self.address, self.tls_address = told["agents"], told.get("agents_tls")

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.log.close()

    def stop(self):
        self.process.terminate()
        self.process.wait()
        self.log.close()


def start_interruptible(code):
    """A child that runs `code` and hears Ctrl-C, also where this process was started to ignore it."""
    hears = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    return subprocess.Popen([sys.executable, "-c", hears + code], stdout=subprocess.PIPE, text=True,
                            env={**os.environ, "PYTHONPATH": str(BUILD / "python")})


@pytest.fixture
def server(tmp_path):
    running = Server(tmp_path)
    yield running
    running.stop()


@pytest.fixture(scope="session")
def program():
    return PROGRAM
