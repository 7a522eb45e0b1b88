"""A plant in viser, mesh by mesh as documented: ``python _serve_viser.py PLANT.glb PORT``."""

import sys
import time
from typing import Any

import trimesh
import viser

scene: Any = trimesh.load(sys.argv[1])
server = viser.ViserServer(host="127.0.0.1", port=int(sys.argv[2]), verbose=False)
server.scene.world_axes.visible = False
low, high = scene.bounds
for number, name in enumerate(scene.graph.nodes_geometry):
    matrix, geometry = scene.graph[name]
    mesh = scene.geometry[geometry].copy()
    mesh.apply_transform(matrix)
    server.scene.add_mesh_trimesh(f"/plant/{number}", mesh)


def _look(client: viser.ClientHandle) -> None:
    client.camera.position = (low + high) / 2 + 0.7 * (high - low).max()
    client.camera.look_at = (low + high) / 2


server.on_client_connect(_look)
print("ready", flush=True)
time.sleep(3600)
