import runpy
from pathlib import Path

import pytest

TOOL = Path(__file__).parents[1] / "tools" / "check_wheel.py"


@pytest.mark.slow
@pytest.mark.long
def test_wheels_build_the_demo_and_a_plant_in_an_empty_environment(tmp_path):
    check = runpy.run_path(str(TOOL))
    if not check["index_is_reachable"](tmp_path):
        pytest.skip("no package index can be reached")
    check["try_out"](check["build_wheel"](tmp_path), tmp_path)
    check["try_out_plants"](check["build_plants"](tmp_path), tmp_path)
