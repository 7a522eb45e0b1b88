"""A plant in rerun, mesh by mesh as documented: ``python _serve_rerun.py PLANT.glb PORT DATA_PORT``."""

import sys
import time
from typing import Any

import rerun
import trimesh

scene: Any = trimesh.load(sys.argv[1])
rerun.init("plant")
address = rerun.serve_grpc(grpc_port=int(sys.argv[3]))
rerun.serve_web_viewer(web_port=int(sys.argv[2]), open_browser=False, connect_to=address)
for number, name in enumerate(scene.graph.nodes_geometry):
    matrix, geometry = scene.graph[name]
    mesh = scene.geometry[geometry].copy()
    mesh.apply_transform(matrix)
    drawn = rerun.Mesh3D(
        vertex_positions=mesh.vertices, triangle_indices=mesh.faces, vertex_normals=mesh.vertex_normals
    )
    rerun.log(f"plant/{number}", drawn, static=True)
print("ready", flush=True)
time.sleep(3600)
