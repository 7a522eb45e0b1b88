import contextlib
import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# The same examples on every machine, so that a run says something about the change and not about luck, and without
# deadlines, as a machine may be busy. HYPOTHESIS_PROFILE=explore looks for new ones.
_PATIENT = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("fixed", derandomize=True, database=None, **_PATIENT)
settings.register_profile("explore", derandomize=False, **_PATIENT)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))


# Begun last, each of these would leave the other processors idle at the end; the longest first.
_LONG = (
    "test_wheel.py",
    "test_golden.py",
    "test_any_plant.py",
    "test_readme.py",
    "test_families.py",
    "test_correcting.py",
    "test_course.py",
    "test_formats_agree.py",
    "test_architecture.py",
    "test_docs.py",
)


def pytest_collection_modifyitems(items):
    ranks = {name: rank for rank, name in enumerate(_LONG)}
    items.sort(key=lambda item: ranks.get(item.path.name, len(ranks)))


def pytest_addoption(parser):
    parser.addoption("--renew-golden", action="store_true", help="write the records in tests/golden anew")


@pytest.fixture(scope="session")
def demo(tmp_path_factory):
    """A folder in which ``cadgraph demo`` was run, small pictures, and what it printed in ``said.txt``; for reading."""
    from cadgraph.cli import main

    folder = tmp_path_factory.mktemp("demo")
    with (
        contextlib.chdir(folder),
        Path("said.txt").open("w") as said,
        contextlib.redirect_stdout(said),
        pytest.raises(SystemExit) as end,
    ):
        main(["demo", "--set", "report.samples=1", "--set", "report.width=320", "--set", "report.height=200"])
    assert not end.value.code
    return folder
