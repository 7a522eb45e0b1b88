"""Small STEP files as text (AP214): boxes, assemblies of them, colours."""

from __future__ import annotations

import itertools

_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
_HEADER = (
    "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','2020-01-01',(''),(''),'','','');\n"
    "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n"
)


class StepFile:
    """Gathers numbered lines; every method returns the reference (``#12``) of what it added."""

    def __init__(self, unit=".MILLI."):
        self.lines = []
        length = self.add(f"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT({unit},.METRE.) )")
        angle = self.add("( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.) )")
        solid = self.add("( NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT() )")
        noise = self.add(f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),{length},'a','b')")
        self.context = self.add(
            "( GEOMETRIC_REPRESENTATION_CONTEXT(3) "
            f"GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({noise})) "
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid})) REPRESENTATION_CONTEXT('a','b') )"
        )
        self.application = self.add("APPLICATION_CONTEXT('automotive design')")
        self.add(f"APPLICATION_PROTOCOL_DEFINITION('x','automotive_design',2000,{self.application})")
        self.origin = self.placement((0, 0, 0))

    def add(self, text):
        self.lines.append(text)
        return f"#{len(self.lines)}"

    def vector(self, kind, xyz):
        return self.add(f"{kind}('',({','.join(f'{float(x):.9f}' for x in xyz)}))")

    def placement(self, at, z=(0, 0, 1), x=(1, 0, 0)):
        point = self.vector("CARTESIAN_POINT", at)
        axis, side = self.vector("DIRECTION", z), self.vector("DIRECTION", x)
        return self.add(f"AXIS2_PLACEMENT_3D('',{point},{axis},{side})")

    def box(self, low, high, rings=_FACES):
        """A solid; with fewer rings an open one."""
        corners = list(itertools.product(*zip(low, high, strict=True)))
        points = [self.vector("CARTESIAN_POINT", c) for c in corners]
        vertices = [self.add(f"VERTEX_POINT('',{p})") for p in points]
        edges = {}
        faces = [self._face(ring, corners, points, vertices, edges) for ring in rings]
        shell = self.add(f"CLOSED_SHELL('',({','.join(faces)}))")
        return self.add(f"MANIFOLD_SOLID_BREP('',{shell})")

    def _face(self, ring, corners, points, vertices, edges):
        uses = []
        for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
            i, j = min(a, b), max(a, b)
            if (i, j) not in edges:
                along = [q - p for p, q in zip(corners[i], corners[j], strict=True)]
                direction = self.vector("DIRECTION", [x / max(map(abs, along)) for x in along])
                vector = self.add(f"VECTOR('',{direction},1.)")
                line = self.add(f"LINE('',{points[i]},{vector})")
                edges[i, j] = self.add(f"EDGE_CURVE('',{vertices[i]},{vertices[j]},{line},.T.)")
            uses.append(self.add(f"ORIENTED_EDGE('',*,*,{edges[i, j]},{'.T.' if a == i else '.F.'})"))
        loop = self.add(f"EDGE_LOOP('',({','.join(uses)}))")
        bound = self.add(f"FACE_OUTER_BOUND('',{loop},.T.)")
        u, v = ([corners[ring[k]][d] - corners[ring[0]][d] for d in range(3)] for k in (1, 3))
        normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        z = [n / max(map(abs, normal)) for n in normal]
        x = [n / max(map(abs, u)) for n in u]
        plane = self.add(f"PLANE('',{self.placement(corners[ring[0]], z, x)})")
        return self.add(f"ADVANCED_FACE('',({bound}),{plane},.T.)")

    def color(self, item, rgb):
        color = self.add(f"COLOUR_RGB('',{','.join(map(str, rgb))})")
        fill_color = self.add(f"FILL_AREA_STYLE_COLOUR('',{color})")
        fill = self.add(f"FILL_AREA_STYLE('',({fill_color}))")
        area = self.add(f"SURFACE_STYLE_FILL_AREA({fill})")
        side = self.add(f"SURFACE_SIDE_STYLE('',({area}))")
        usage = self.add(f"SURFACE_STYLE_USAGE(.BOTH.,{side})")
        style = self.add(f"PRESENTATION_STYLE_ASSIGNMENT(({usage}))")
        styled = self.add(f"STYLED_ITEM('color',({style}),{item})")
        self.add(f"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',({styled}),{self.context})")

    def product(self, name, items=(), places=()):
        frames = [self.placement(at) for at in places]
        kind = "ADVANCED_BREP_SHAPE_REPRESENTATION" if items else "SHAPE_REPRESENTATION"
        shape = self.add(f"{kind}('',({','.join([self.origin, *frames, *items])}),{self.context})")
        context = self.add(f"PRODUCT_CONTEXT('',{self.application},'mechanical')")
        product = self.add(f"PRODUCT('{name}','{name}','',({context}))")
        formation = self.add(f"PRODUCT_DEFINITION_FORMATION('','',{product})")
        design = self.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{self.application},'design')")
        definition = self.add(f"PRODUCT_DEFINITION('design','',{formation},{design})")
        form = self.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
        self.add(f"SHAPE_DEFINITION_REPRESENTATION({form},{shape})")
        return definition, shape, frames

    def use(self, parent, child, place, name=""):
        """Puts a product into another, at one of its places."""
        moved = self.add(f"ITEM_DEFINED_TRANSFORMATION('','',{self.origin},{parent[2][place]})")
        relation = self.add(
            f"( REPRESENTATION_RELATIONSHIP('','',{child[1]},{parent[1]}) "
            f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({moved}) SHAPE_REPRESENTATION_RELATIONSHIP() )"
        )
        usage = self.add(f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{name}','{name}','',{parent[0]},{child[0]},$)")
        shape = self.add(f"PRODUCT_DEFINITION_SHAPE('Placement','',{usage})")
        self.add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{shape})")

    def write(self, path):
        body = "\n".join(f"#{i} = {line};" for i, line in enumerate(self.lines, start=1))
        path.write_text(f"{_HEADER}{body}\nENDSEC;\nEND-ISO-10303-21;\n")
        return path
