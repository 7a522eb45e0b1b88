"""When labels from outside are taken for doubtful."""

from types import SimpleNamespace

import numpy as np
import pytest

from cadgraph.model.labels import Label
from cadgraph.stages.relate.role import find_roles
from piping import PIPE, TANK, VALVE

OTHERS = [(TANK, "shell"), (TANK, "nozzle"), (VALVE, "lever"), (VALVE, "yoke"), (VALVE, "gland"), (TANK, "skirt"),
          (VALVE, "gearbox"), (TANK, "manway")]  # fmt: skip


@pytest.mark.parametrize(("strays", "sure", "doubtful"), [(5, 0.95, False), (7, 0.95, True), (7, 0.8, False)])
def test_labels_are_doubtful_where_many_contradict_what_the_labeler_is_sure_of(strays, sure, doubtful):
    n = 100
    said = [Label(*OTHERS[k] if k < strays else (PIPE, "pipe"), 1.0, "author") for k in range(n)]
    guessed = [Label(PIPE, "pipe", sure, "geometry")] * n
    roles = find_roles(SimpleNamespace(shape=np.arange(n)), said, guessed)
    assert roles.doubtful is doubtful
    assert bool(roles.doubted) is doubtful
