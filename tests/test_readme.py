"""What README and guide print is run as it stands, on the demo."""

import re
import shlex
import shutil
import signal
import subprocess
import sys
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import pytest

from cadgraph import SceneGraph
from cadgraph.cli import main
from cadgraph.export.dexpi import write_dexpi

ROOT = Path(__file__).parents[1]
README, GUIDE = ROOT / "README.md", ROOT / "docs" / "guide.md"
SMALL = [word for name in ("samples=1", "width=320", "height=200") for word in ("--set", f"report.{name}")]
# The paper's experiments take minutes on the plant that they are printed for, and pictures seconds.
SHORTENED = {"reproduce": ["--quick"], "build": SMALL, "demo": SMALL}


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, and its lines."""

    language: str
    lines: tuple[str, ...]

    def commands(self):
        """Each command without its comment, and the output that is printed under it, None where none is."""
        if not any(line.startswith("$ ") for line in self.lines):
            return [(re.split(r" {2,}#", line)[0], None) for line in self.lines if line]
        pieces = "\n".join(self.lines).removeprefix("$ ").split("\n$ ")
        return [tuple(piece.split("\n", 1)) if "\n" in piece else (piece, None) for piece in pieces]


def blocks(path):
    found = re.findall(r"^```(\w*)\n(.*?)^```$", path.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    return [Block(language, tuple(text.splitlines())) for language, text in found]


def inline(path):
    """Commands in the text."""
    text = re.sub(r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    return [" ".join(words.split()) for words in re.findall(r"`(cadgraph [^`]+)`", text)]


@pytest.fixture
def folder(demo, tmp_path, monkeypatch):
    """A folder with the demo's results, and the scenes and files that stand for a reader's own."""
    shutil.copytree(demo / "demo", tmp_path / "demo")
    shutil.copy(demo / "demo" / "plant.usdc", tmp_path / "plant.usd")
    part = SceneGraph.load(demo / "demo").unit("V-008").parts[0]
    mesh = SceneGraph.load(demo / "demo").part(part).meshes[0]
    (tmp_path / "labels.csv").write_text(f"mesh,group,name\n{mesh},Valve assembly,valve\n")
    write_dexpi(SceneGraph.load(demo / "demo"), tmp_path / "plan.xml")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(command):
    """What a printed command says; where it is sent to a file the file has it."""
    line, _, file = command.partition(" > ")
    words = shlex.split(line)
    assert words[0] == "cadgraph", f"what does {command!r} need to be tried?"
    if words[1] == "view":
        return view(words[2:])
    said = StringIO()
    with redirect_stdout(said), pytest.raises(SystemExit) as end:
        main([*words[1:], *SHORTENED.get(words[1], ())])
    assert not end.value.code, command
    if file:
        Path(file).write_text(said.getvalue())
    return said.getvalue()


def view(words):
    """What the viewer says until it is ready; it serves until it is stopped."""
    line = [sys.executable, "-m", "cadgraph", "view", *words, "--no-browser"]
    with subprocess.Popen(line, stdout=subprocess.PIPE, text=True) as server:
        said = []
        for text in server.stdout:
            said.append(text)
            if text.startswith("ready"):
                break
        server.send_signal(signal.SIGINT)
        said.append(server.stdout.read())
    assert server.returncode == 0, "".join(said)
    assert said[0].startswith("http://127.0.0.1:")
    return "".join(said)


def run_all(chosen):
    for block in chosen:
        for command, printed in block.commands():
            if command.startswith("make "):
                assert re.search(rf"^{command.split()[1]}:", (ROOT / "Makefile").read_text(), re.MULTILINE), command
                continue
            said = run(command)
            if printed is not None:
                assert said.rstrip() == printed.rstrip(), command


def test_the_commands_of_the_readme_work_on_the_demo(folder):
    shell = [block for block in blocks(README) if not block.language]
    asked = {command.split()[1] for block in shell for command, _ in block.commands()}
    assert {"demo", "test", "lines", "trace", "isolate", "diagram", "explain", "export"} <= asked
    run_all(shell)
    assert (folder / "plant.svg").is_file()
    assert (folder / "demo" / "dexpi.xml").is_file()


@pytest.mark.parametrize("path", [README, pytest.param(GUIDE, marks=pytest.mark.slow)], ids=["README", "guide"])
def test_the_python_of_both_runs(path, folder, capsys):
    names = {}
    for block in blocks(path):
        if block.language == "python":
            exec(compile("\n".join(block.lines), path.name, "exec"), names)
    assert SceneGraph.load(folder / "out").units("pump")
    if path == README:
        assert "V-008 check valve" in capsys.readouterr().out


@pytest.mark.slow
def test_the_commands_in_the_text_of_the_readme_work(folder):
    commands = inline(README)
    assert "cadgraph build plant.usd -o out" in commands
    for command in commands:
        run(command)


@pytest.mark.slow
@pytest.mark.long
def test_the_commands_of_the_guide_work(folder):
    run_all(block for block in blocks(GUIDE) if not block.language)
