# ruff: noqa: E501 - lines of files, as they are written
"""Small sound files by hand, each with as many features of its format as fit on a page."""

from __future__ import annotations

__all__ = ["TEXTS"]

_USD_FEATURES = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 0.01
    upAxis = "Y"
    subLayers = []
)
def Xform "World" (
    variants = { string size = "large" }
    prepend variantSets = "size"
)
{
    double3 xformOp:translate = (1, 2, 3)
    float3 xformOp:rotateXYZ = (0, 90, 0)
    float3 xformOp:scale = (1, -1, 1)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ", "xformOp:scale"]
    variantSet "size" = {
        "large" {
            def Sphere "Ball" {
            double radius = 20
        }
        }
        "small" {
            def Sphere "Ball" {
            double radius = 2
        }
        }
    }
    def Mesh "Box" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {
        int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
        int[] faceVertexIndices = [0, 1, 3, 2, 2, 3, 5, 4, 4, 5, 7, 6, 6, 7, 1, 0, 1, 7, 5, 3, 6, 0, 2, 4]
        point3f[] points = [(-5, -5, 5), (5, -5, 5), (-5, 5, 5), (5, 5, 5), (-5, 5, -5), (5, 5, -5), (-5, -5, -5), (5, -5, -5)]
        uniform token subdivisionScheme = "catmullClark"
        int[] holeIndices = [1]
        color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0)] ( interpolation = "constant" )
        int[] primvars:displayColor:indices = [1]
        rel material:binding = </World/Looks/Red>
        def GeomSubset "part" ( prepend apiSchemas = ["MaterialBindingAPI"] )
        {
            uniform token elementType = "face"
            uniform token familyName = "materialBind"
            int[] indices = [0, 1, 2]
            rel material:binding = </World/Looks/Red>
        }
    }
    def Mesh "Moving"
    {
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points.timeSamples = { 0: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], 1: [(0, 0, 0), (2, 0, 0), (0, 2, 0)] }
        uniform token orientation = "leftHanded"
        token visibility = "inherited"
        uniform token purpose = "render"
    }
    def Cylinder "Pipe"
    {
        double height = 100
        double radius = 5
        uniform token axis = "X"
    }
    def Cone "Cone"
    {
        double height = 10
        double radius = 5
    }
    def Capsule "Capsule"
    {
        double height = 10
        double radius = 5
    }
    def Cube "Cube"
    {
        double size = 10
    }
    def Plane "Plane"
    {
        double width = 10
        double length = 5
    }
    def BasisCurves "Curve"
    {
        int[] curveVertexCounts = [2]
        point3f[] points = [(0, 0, 0), (1, 1, 1)]
    }
    def Scope "Hidden"
    {
        token visibility = "invisible"
        def Cube "In"
    {
    }
    }
    def PointInstancer "Bolts"
    {
        rel prototypes = [</World/Bolts/One>, </World/Bolts/Two>]
        int[] protoIndices = [0, 1, 0]
        point3f[] positions = [(0, 0, 0), (10, 0, 0), (20, 0, 0)]
        quath[] orientations = [(1, 0, 0, 0), (1, 0, 0, 0), (0, 1, 0, 0)]
        float3[] scales = [(1, 1, 1), (2, 2, 2), (1, 1, -1)]
        int64[] ids = [1, 2, 3]
        int64[] invisibleIds = [2]
        def Cube "One"
        {
            double size = 2
        }
        def Sphere "Two"
        {
            double radius = 1
        }
    }
    def Xform "Copy" ( instanceable = true
        prepend references = </Proto> )
    {
        double3 xformOp:translate = (50, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Xform "Again" ( instanceable = true
        prepend references = </Proto> )
    {
    }
    def Xform "Lost" ( prepend payload = @missing.usda@</A> )
    {
    }
    def Scope "Looks"
    {
        def Material "Red"
        {
            token outputs:surface.connect = </World/Looks/Red/Shader.outputs:surface>
            def Shader "Shader"
            {
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor = (1, 0, 0)
                token outputs:surface
            }
        }
    }
}
class Xform "Proto"
{
    def Cube "Body"
{
    double size = 4
}
over "Nothing"
{
}
}
"""

_DAE = """<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong><diffuse><color>1 0 0 1</color></diffuse></phong>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="part"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 100 0 0 0 100 0 0 0 100</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2" material="s"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>
<polylist count="2"><input semantic="VERTEX" source="#v" offset="0"/><vcount>3 3</vcount><p>0 3 1 1 3 2</p></polylist>
</mesh></geometry></library_geometries>
<library_nodes><node id="n"><instance_geometry url="#g"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s"><node id="a" name="A"><translate>1 2 3</translate><rotate>0 0 1 90</rotate>
<scale>1 1 -1</scale><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry>
<node id="b"><matrix>1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_node url="#n"/></node></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""

_PLY = """ply
format ascii 1.0
comment small
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 4
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 255 0 0
0 1 0 255 0 0
0 0 1 255 0 0
3 0 2 1
3 0 1 3
3 1 2 3
3 0 3 2
"""

_3MF = """<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources><basematerials id="5"><base name="red" displaycolor="#FF0000"/></basematerials>
<object id="1" type="model" name="part" pid="5" pindex="0"><mesh><vertices><vertex x="0" y="0" z="0"/>
<vertex x="10" y="0" z="0"/><vertex x="0" y="10" z="0"/><vertex x="0" y="0" z="10"/></vertices>
<triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3" pid="5" p1="0"/><triangle v1="1" v2="2" v3="3"/>
<triangle v1="0" v2="3" v3="2"/></triangles></mesh></object>
<object id="2" type="model"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 20 0 0"/>
<component objectid="1"/></components></object></resources>
<build><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 5"/><item objectid="1"/></build></model>
"""

_OBJ = """# part
mtllib part.mtl
o one
v 0 0 0
v 1000 0 0 1 0 0
v 0 1000 0
v 0 0 1000
vt 0 0
vn 0 0 1
g body
usemtl red
s off
f 1 3 2
f 1/1 2/1 4/1
f 2//1 3//1 4//1
f -4 -1 -2
o two
l 1 2
v 2000 0 0
v 3000 0 0
v 3000 1000 0
v 2000 1000 0
f 5 6 7 8
"""

_MTL = """newmtl red
Kd 0.8 0.1 0.1
d 1.0
Tr 0
map_Kd red.png
newmtl blue
Kd spectral blue.rfl 1
"""

_STL = """solid part
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 1000 0
vertex 1000 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 1000 0 0
vertex 0 0 1000
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 1000 0 0
vertex 0 1000 0
vertex 0 0 1000
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 1000
vertex 0 1000 0
endloop
endfacet
endsolid part
"""

_VOCABULARY = """groups:
  Pipe assembly:
    names: [pipe, elbow, tee]
    connector: true
  Valve assembly:
    names: [valve body, handwheel]
    unit: valve
  Tank: {names: [tank, shell], unit: tank}
"""

_LABELS_CSV = 'mesh,group,name\n/World/a,Pipe assembly,pipe\n"/World/b,c",Valve assembly,valve body\n/d,Tank,\n'

_CONFIG = """[load]
unit = "mm"
max_gap = 0.001
[label]
labeler = "embedded"
"""

_ANSWER = """{"seen": "a long round tube", "group": "Pipe assembly", "name": "pipe", "propose_group": null,
"propose_name": null, "reason": null, "confidence": 0.9}"""

_BATCH = """{"id": "batch_req_1", "custom_id": "0123456789abcdef", "response": {"status_code": 200, "request_id": "r", \
"body": {"id": "c", "object": "chat.completion", "choices": [{"index": 0, "message": {"role": "assistant", \
"content": "{\\"seen\\": \\"a tube\\", \\"group\\": \\"Pipe assembly\\", \\"name\\": \\"pipe\\"}", "refusal": null}, \
"finish_reason": "stop"}], "usage": {"prompt_tokens": 400, "completion_tokens": 40, "total_tokens": 440}}}, "error": null}
{"id": "batch_req_2", "custom_id": "f123456789abcdef", "response": {"status_code": 500, "body": {"error": {"message": \
"server"}}}, "error": {"code": "x", "message": "y"}}
"""

_INDEX = '{"q-0123456789abcdef": ["/World/a", "/World/b"], "q-f123456789abcdef": ["/World/c"]}'

_PROPOSALS = """{"labels": [{"group": "Pipe assembly", "name": "u-bend", "reason": "a bend by 180 degrees", "count": 2, "parts": ["/a"]},
{"group": "Pump unit", "name": null, "reason": ""}]}
"""

_ROUND = """{"goals": "read every gauge", "start": "V-001", "steps": [{"do": "walk", "at": "V-001", "length_m": 3.5},
{"do": "close", "at": "V-001"}, {"do": "climb", "at": "L-1", "level": "F-1"}], "length_m": 3.5}"""

_MAPPING = "plan,plant\nV-1,V-001\nT-1,T-001 # a tank\n"

TEXTS: dict[str, tuple[str, ...]] = {
    "usda": (_USD_FEATURES,),
    "dae": (_DAE,),
    "ply": (_PLY,),
    "3mf": (_3MF,),
    "obj": (_OBJ,),
    "mtl": (_MTL,),
    "stl": (_STL,),
    "vocabulary": (_VOCABULARY,),
    "labels-csv": (_LABELS_CSV,),
    "config": (_CONFIG,),
    "answer": (_ANSWER,),
    "batch": (_BATCH,),
    "index": (_INDEX,),
    "proposals": (_PROPOSALS,),
    "round": (_ROUND,),
    "mapping": (_MAPPING,),
}
"""By the name of a kind."""
