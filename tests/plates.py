"""A row of plates and pipes for tests of asking: each shape has a size of its own, by which the truth is known."""

import re

import numpy as np

import shapes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.repeats import find_shapes
from cadgraph.labelers.lvlm.prompt import size_text
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary

BOX = re.compile(r"along its own axes: (.*?)\. Height")
VOCABULARY = default_vocabulary()
NO_CONTACTS = Contacts(np.zeros((0, 2), np.int64), np.zeros(0), np.zeros((0, 2, 3)))


def scene_of(n_shapes=6, repeats=2):
    """Boxes side by side, ``repeats`` of each size."""
    meshes = []
    for shape in range(n_shapes):
        size = (0.2 + 0.013 * shape, 0.1 + 0.007 * shape, 0.05)
        meshes += [shapes.box(size, (0.6 * shape, 0.5 * k, 0)) for k in range(repeats)]
    return Scene.from_meshes(meshes, paths=[f"/plant/mesh_{i}" for i in range(len(meshes))])


def parts_of(scene):
    properties = measure(scene)
    n = scene.n_meshes
    return Parts(
        scene=scene,
        meshes=tuple((i,) for i in range(n)),
        part_of_mesh=np.arange(n),
        properties=properties,
        shape=find_shapes(scene, properties).shape,
        ground=np.zeros(n, bool),
    )


def truth_of(parts):
    """(group, name) of each part: another name for each shape."""
    names = [(group, name) for group, content in VOCABULARY.groups.items() for name in content.names]
    return [names[7 * int(shape) % len(names)] for shape in parts.shape]


def box_of(parts, part):
    return " x ".join(size_text(float(e)) for e in parts.properties.obb_extents[part])


def oracle(parts, confidence=0.9):
    """Answers by the size of the box, as the question states it."""
    truth = truth_of(parts)
    known = {box_of(parts, i): truth[i] for i in range(parts.n_parts)}

    def answer(text):
        group, name = known[BOX.search(text).group(1)]
        return {
            "seen": "a flat plate with sharp edges, lying", "group": group, "name": name, "propose_group": None,
            "propose_name": None, "reason": None, "confidence": confidence,
        }  # fmt: skip

    return answer


class Told:
    """Answers without a server, from a function of the question's text; counts what it was asked."""

    name = "told"
    looks = False
    keeps = True
    again = True

    def __init__(self, answer):
        self.answer = answer
        self.asked = []

    def close(self):
        pass

    def ask(self, question):
        import json

        from cadgraph.labelers.lvlm.reply import Reply

        self.asked.append(question)
        content = self.answer(question.text)
        if isinstance(content, Reply):
            return content
        return Reply(content if isinstance(content, str) else json.dumps(content), None, 1000, 80)
