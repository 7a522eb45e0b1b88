"""A STEP file of nested assemblies, put together by hand."""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["nested_assembly"]


def nested_assembly(levels: int, wide: int) -> str:
    """A file whose lowest product, a triangle, is placed ``wide ** levels`` times.

    Args:
        levels: how many assemblies are in each other.
        wide: how often each holds the next.
    """
    lines: list[str] = []

    def add(text: str) -> str:
        lines.append(f"#{len(lines) + 1}={text};")
        return f"#{len(lines)}"

    application = add("APPLICATION_CONTEXT('automotive design')")
    add(f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{application})")
    product_context = add(f"PRODUCT_CONTEXT('',{application},'mechanical')")
    definition_context = add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')")
    length = add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))")
    angle = add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
    solid = add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
    close = add(f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-7),{length},'distance_accuracy_value','')")
    context = add(
        f"(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({close}))"
        f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid}))REPRESENTATION_CONTEXT('',''))"
    )
    origin, up, side = (
        add("CARTESIAN_POINT('',(0.,0.,0.))"),
        add("DIRECTION('',(0.,0.,1.))"),
        add("DIRECTION('',(1.,0.,0.))"),
    )
    place = add(f"AXIS2_PLACEMENT_3D('',{origin},{up},{side})")

    def product(name: str, representation: str) -> tuple[str, str]:
        whole = add(f"PRODUCT('{name}','{name}','',({product_context}))")
        formation = add(f"PRODUCT_DEFINITION_FORMATION('','',{whole})")
        definition = add(f"PRODUCT_DEFINITION('design','',{formation},{definition_context})")
        shape = add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
        add(f"SHAPE_DEFINITION_REPRESENTATION({shape},{representation})")
        return definition, representation

    below = product(f"P{levels}", add(f"ADVANCED_BREP_SHAPE_REPRESENTATION('',({place},{_block(add)}),{context})"))
    for level in reversed(range(levels)):
        here = product(f"P{level}", add(f"SHAPE_REPRESENTATION('',({place}),{context})"))
        for number in range(wide):
            used = add(f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{number}','u{number}','',{here[0]},{below[0]},$)")
            shape = add(f"PRODUCT_DEFINITION_SHAPE('','',{used})")
            turned = add(f"ITEM_DEFINED_TRANSFORMATION('','',{place},{place})")
            relation = add(
                f"(REPRESENTATION_RELATIONSHIP('','',{below[1]},{here[1]})"
                f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({turned})SHAPE_REPRESENTATION_RELATIONSHIP())"
            )
            add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{shape})")
        below = here
    head = (
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
    )
    return head + "\n".join(lines) + "\nENDSEC;\nEND-ISO-10303-21;\n"


def _block(add: Callable[[str], str]) -> str:
    """A sphere of radius 1, the shortest solid there is."""
    origin, up, side = (
        add("CARTESIAN_POINT('',(0.,0.,0.))"),
        add("DIRECTION('',(0.,0.,1.))"),
        add("DIRECTION('',(1.,0.,0.))"),
    )
    middle = add(f"AXIS2_PLACEMENT_3D('',{origin},{up},{side})")
    surface = add(f"SPHERICAL_SURFACE('',{middle},1.)")
    low = add("CARTESIAN_POINT('',(0.,0.,-1.))")
    pole = add(f"VERTEX_POINT('',{low})")
    loop = add(f"VERTEX_LOOP('',{pole})")
    bound = add(f"FACE_BOUND('',{loop},.T.)")
    face = add(f"ADVANCED_FACE('',({bound}),{surface},.T.)")
    shell = add(f"CLOSED_SHELL('',({face}))")
    return add(f"MANIFOLD_SOLID_BREP('',{shell})")
