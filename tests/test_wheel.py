import runpy
from pathlib import Path

import pytest

TOOL = Path(__file__).parents[1] / "tools" / "check_wheel.py"


@pytest.mark.slow
@pytest.mark.long
def test_a_wheel_of_the_product_alone_builds_the_demo_in_an_empty_environment(tmp_path):
    check = runpy.run_path(str(TOOL))
    if not check["index_is_reachable"](tmp_path):
        pytest.skip("no package index can be reached")
    check["try_out"](check["build_wheel"](tmp_path), tmp_path)
