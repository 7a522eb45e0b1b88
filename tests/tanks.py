"""Two tanks of two boxes each, and a third of one, for tests of what a file says of units."""

from dataclasses import replace

import shapes
from cadgraph.config import Config
from cadgraph.model.facts import Fact
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.scene import Scene
from cadgraph.pipeline import build

PATHS = ("/area/T1/shell", "/area/T1/leg", "/area/T2/shell", "/area/T2/leg", "/area/T3")


def tanks(*facts):
    meshes = []
    for k in range(2):
        meshes += [shapes.box((2, 2, 2), (5.0 * k, 0, 2)), shapes.box((0.5, 0.5, 1), (5.0 * k, 0, 0.5))]
    scene = Scene.from_meshes([*meshes, shapes.box((2, 2, 2), (10.0, 0, 2))], PATHS)
    return replace(scene, facts=tuple(Fact(*fact) for fact in facts))


def built(scene, use=True, **settings):
    names = {"shell": "shell", "leg": "tank leg", "T3": "tank"}
    labels = [GivenLabel(path, "Tank", names[path.rsplit("/", 1)[-1]]) for path in scene.paths]
    changes = {"label.labeler": "none", "label.use_metadata": use, "ground.find": "none", **settings}
    return build(scene, Config().replace(changes), labels=labels)
