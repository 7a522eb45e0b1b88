"""A run that is killed goes on where it was, without asking anything twice."""

import os
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest

import plates
from chat_server import ChatServer

PROGRAM = """
import sys
import plates
from pathlib import Path
from cadgraph.config import Config
from cadgraph.labelers.lvlm.setup import make_labeler
config = Config().replace({"lvlm.ask": "all", "lvlm.base_url": sys.argv[1], "lvlm.concurrency": 2, "lvlm.size": 128})
labeler = make_labeler(config, Path(sys.argv[2]))
labels = labeler.label(plates.parts_of(plates.scene_of(14, 1)), plates.NO_CONTACTS, plates.VOCABULARY).answers
print(sum(each is not None for each in labels))
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no kill -9 on Windows")
def test_after_kill_nothing_that_was_answered_is_asked_again(tmp_path):
    server = ChatServer(plates.oracle(plates.parts_of(plates.scene_of(14, 1))), delay=0.08)
    environment = {**os.environ, "OPENAI_API_KEY": "x", "PYTHONPATH": str(Path(__file__).parents[2])}
    with server.running() as address:
        command = [sys.executable, "-c", PROGRAM, address, str(tmp_path)]
        with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE) as first:
            while len(server.answered) < 5:
                assert first.poll() is None
                time.sleep(0.01)
            first.send_signal(signal.SIGKILL)
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["14"]
    times = Counter(server.answered)
    assert len(times) == 14
    # Only what was on its way when it was killed had no answer yet.
    assert sum(times.values()) - 14 <= 2
