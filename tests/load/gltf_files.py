"""Small glTF files, put together by hand."""

from __future__ import annotations

import base64
import json
import struct

import numpy as np

_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_COMPONENTS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}


class GltfFile:
    """Gathers accessors, meshes and nodes; every method returns the number of what it added."""

    def __init__(self):
        self.data = b""
        self.tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}

    def add(self, name, /, **row):
        rows = self.tree.setdefault(name, [])
        rows.append(row)
        return len(rows) - 1

    def view(self, values, **row):
        self.data += b"\0" * (-len(self.data) % 4)
        start, data = len(self.data), values if isinstance(values, bytes) else values.tobytes()
        self.data += data
        return self.add("bufferViews", buffer=0, byteOffset=start, byteLength=len(data), **row)

    def accessor(self, values, dtype="f4", **row):
        values = np.asarray(values, "<" + dtype)
        values = values.reshape(len(values), -1)
        return self.add("accessors", **{
            "bufferView": self.view(values), "componentType": _COMPONENTS[dtype], "count": len(values),
            "type": _TYPES[values.shape[1]], **row,
        })  # fmt: skip

    def mesh(self, *shapes, name="shape", mode=4, **row):
        """One primitive of each (points, faces) pair."""
        primitives = [
            {
                "attributes": {"POSITION": self.accessor(points)},
                "indices": self.accessor(np.ravel(faces), "u2"),
                "mode": mode,
                **row,
            }
            for points, faces in shapes
        ]
        return self.add("meshes", name=name, primitives=primitives)

    def node(self, at_top=True, **row):
        number = self.add("nodes", **row)
        if at_top:
            self.tree["scenes"][0]["nodes"].append(number)
        return number

    def uses(self, *names, required=False):
        for key in ("extensionsUsed", *(("extensionsRequired",) if required else ())):
            self.tree.setdefault(key, []).extend(names)

    def glb(self, path):
        self.tree["buffers"] = [{"byteLength": len(self.data)}, *self.tree.get("buffers", [])[1:]]
        text = json.dumps(self.tree).encode()
        text += b" " * (-len(text) % 4)
        data = self.data + b"\0" * (-len(self.data) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
        path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks)
        return path

    def gltf(self, path, uri=None):
        """With its buffer as data URI, or in the file that is named."""
        if uri is None:
            uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.tree["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        path.write_text(json.dumps(self.tree))
        return path
