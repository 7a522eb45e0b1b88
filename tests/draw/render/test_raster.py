import numpy as np

import shapes
from cadgraph.draw.render.camera import frame
from cadgraph.draw.render.caster import Caster
from cadgraph.draw.render.raster import Facets, Favour, favour, see
from cadgraph.draw.render.surface import Viewport
from cadgraph.model.scene import Scene

SCENE = Scene.from_meshes([
    shapes.sphere(0.2), shapes.box((0.5, 0.05, 0.5), (0.2, 0.3, 0)), shapes.box((4, 4, 0.1), (0, 0, -0.4)),
    shapes.cylinder(0.05, 0.6),
])  # fmt: skip


def seen(camera, side=1, scene=SCENE, skip=()):
    left_out = np.zeros(scene.n_meshes, bool)
    left_out[list(skip)] = True
    return see(Viewport.whole(camera), Facets.of(scene), side, left_out, Favour())[0]


def test_the_same_faces_as_rays_meet():
    camera = frame(SCENE.mesh(0)[0], (0.3, -1, 0.4), (80, 60), margin=0.1)
    found = seen(camera)
    rows, columns = np.divmod(np.arange(80 * 60), 80)
    caster = Caster(SCENE)
    origins, towards = camera.rays(columns + 0.5, rows + 0.5)
    hits = caster.first(caster.local(origins), towards.astype(np.float32))
    assert (hits.face == found.face).mean() > 0.998
    both = (hits.face == found.face) & (found.face >= 0)
    np.testing.assert_allclose((hits.distance * (towards @ camera.forward))[both], found.depth[both], rtol=1e-4)


def test_what_reaches_behind_the_eye_is_drawn():
    eye_inside = frame(np.array([[0, 0, -0.30], [0.02, 0.02, -0.3]]), (1, 0, 0.2), (32, 32))
    assert (seen(eye_inside).face >= 0).mean() > 0.5


def test_no_cracks_between_triangles():
    camera = frame(shapes.sphere(0.2)[0], (0.31, -0.7, 0.2), (200, 200), margin=-0.3)
    inside = seen(camera, 2, Scene.from_meshes([shapes.sphere(0.2)])).face.reshape(400, 400)[150:250, 150:250]
    assert (inside >= 0).all()


def test_what_is_skipped_is_not_there():
    camera = frame(SCENE.mesh(0)[0], (0.3, -1, 0.4), (80, 60), margin=0.1)
    face = seen(camera, skip=[0, 3]).face
    assert not np.isin(Facets.of(SCENE).mesh_of_face[face[face >= 0]], [0, 3]).any()


def test_meshes_count_as_nearer_by_some_thousandths_of_their_size():
    assert favour(shapes.box((2, 0.2, 0.2))[0]) == 0.004 * 0.2
    assert favour(shapes.box((0.01, 0.01, 0.01))[0]) == 2.5e-4
    assert favour(shapes.box((9, 9, 9))[0]) == 2e-3
