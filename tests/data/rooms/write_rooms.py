"""Writes one room in the five languages that neumann reads, each in its own words: room.xml and room.json have rectangles and a cube
where the others have meshes. Run it in this folder."""

import base64
import json
import math
import struct
import zlib

LENS = 683  # lumens per watt


# The picture on the floor: 8 × 8, of which no two corners are alike.
def png(size, color):
    rows = b"".join(b"\0" + bytes(c for x in range(size) for c in color(x, y)) for y in range(size))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows, 9))
            + chunk(b"IEND", b""))


def tile(x, y):
    if x < 2 and y < 4:
        return 200, 60, 50
    if x > 5 and y < 2:
        return 40, 60, 180
    return (220, 200, 150) if (x + y) % 2 else (90, 100, 110)


with open("tiles.png", "wb") as file:
    file.write(png(8, tile))

# Corners counter-clockwise as seen from the side that counts; texture coordinates with v = 0 at the top of the picture.
SQUARE = [0, 1, 2, 0, 2, 3]
FLOOR = ([(0, 0, 4), (4, 0, 4), (4, 0, 0), (0, 0, 0)], SQUARE)
FLOOR_UV = [(0, 1), (1, 1), (1, 0), (0, 0)]
CEILING = ([(0, 3, 0), (4, 3, 0), (4, 3, 4), (0, 3, 4)], SQUARE)
BACK = ([(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0)], SQUARE)
LEFT = ([(0, 0, 4), (0, 0, 0), (0, 3, 0), (0, 3, 4)], SQUARE)
RIGHT = ([(4, 0, 0), (4, 0, 4), (4, 3, 4), (4, 3, 0)], SQUARE)
LAMP = ([(1, 2.9, 1), (2, 2.9, 1), (2, 2.9, 2), (1, 2.9, 2)], SQUARE)


# A box of 0.5 × 0.6 × 0.5 around (2.9, 0.6, 1.6), turned by 30° around y.
def box():
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))

    def place(x, y, z):
        return 2.9 + 0.5 * (c * x + s * z), 0.6 + 0.6 * y, 1.6 + 0.5 * (c * z - s * x)

    points, corners = [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(points)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                v = [0, 0, 0]
                v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3] = side, (a, b)[side < 0], (a, b)[side > 0]
                points.append(place(*v))
            corners += [first + i for i in SQUARE]
    return points, corners


# A screen bent like a quarter of a cylinder of radius 1 around (1.2, ·, 1.2), with normals that point outwards.
def screen(parts=6):
    points, normals, corners = [], [], []
    for i in range(parts + 1):
        angle = 0.5 * math.pi * i / parts
        for y in (0, 1):
            points.append((1.2 + math.sin(angle), y, 1.2 + math.cos(angle)))
            normals.append((math.sin(angle), 0, math.cos(angle)))
        if i < parts:
            a = 2 * i
            corners += [a, a + 2, a + 3, a, a + 3, a + 1]
    return (points, corners), normals


SCREEN, SCREEN_NORMALS = screen()
WHITE, RED, GREEN, BROWN = (0.75, 0.75, 0.75), (0.6, 0.1, 0.08), (0.15, 0.5, 0.2), (0.5, 0.4, 0.3)
RADIANCE, INTENSITY, BULB = (9, 8, 6), (2, 3, 4), (3.2, 1.5, 2.8)
PARTS = {"floor": (FLOOR, "tiles"), "ceiling": (CEILING, WHITE), "back": (BACK, WHITE), "left": (LEFT, RED), "right": (RIGHT, GREEN),
         "lamp": (LAMP, (0, 0, 0)), "box": (box(), BROWN), "screen": (SCREEN, WHITE)}
EYE, FOV, WIDTH, HEIGHT = (2, 1.5, 9), 32, 32, 24


def flat(triples):
    return " ".join(f"{c:.9g}" for t in triples for c in t)


def numbers(values, between=" "):
    return between.join(f"{v:.9g}" for v in values)


def write_xml():
    def square(name, matrix, inside):
        return (f'    <shape type="rectangle" id="{name}">\n        <transform name="to_world"><matrix value="{matrix}"/></transform>\n'
                f"        {inside}\n    </shape>\n")

    def paint(color):
        return f'<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="{numbers(color, ", ")}"/></bsdf></bsdf>'

    picture = ('<bsdf type="twosided"><bsdf type="diffuse"><texture type="bitmap" name="reflectance">'
               '<string name="filename" value="tiles.png"/><transform name="to_uv"><scale y="-1"/></transform></texture></bsdf></bsdf>')
    shapes = square("floor", "2 0 0 2  0 0 1 0  0 -2 0 2  0 0 0 1", picture)
    shapes += square("ceiling", "2 0 0 2  0 0 -1 3  0 2 0 2  0 0 0 1", paint(WHITE))
    shapes += square("back", "2 0 0 2  0 1.5 0 1.5  0 0 1 0  0 0 0 1", paint(WHITE))
    shapes += square("left", "0 0 1 0  0 1.5 0 1.5  -2 0 0 2  0 0 0 1", paint(RED))
    shapes += square("right", "0 0 -1 4  0 1.5 0 1.5  2 0 0 2  0 0 0 1", paint(GREEN))
    shapes += square("lamp", "0.5 0 0 1.5  0 0 -1 2.9  0 0.5 0 1.5  0 0 0 1",
                     paint((0, 0, 0)) + f'<emitter type="area"><rgb name="radiance" value="{numbers(RADIANCE, ", ")}"/></emitter>')
    with open("screen.obj", "w") as file:
        (points, corners), normals = SCREEN, SCREEN_NORMALS
        file.write("".join(f"v {numbers(p)}\n" for p in points) + "".join(f"vn {numbers(n)}\n" for n in normals))
        for i in range(0, len(corners), 3):
            file.write("f " + " ".join(f"{c + 1}//{c + 1}" for c in corners[i:i + 3]) + "\n")
    with open("room.xml", "w") as file:
        file.write(f"""<scene version="3.0.0">
    <integrator type="path"/>
    <sensor type="perspective">
        <float name="fov" value="{FOV}"/>
        <string name="fov_axis" value="y"/>
        <transform name="to_world"><lookat origin="2, 1.5, 9" target="2, 1.5, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm">
            <integer name="width" value="{WIDTH}"/>
            <integer name="height" value="{HEIGHT}"/>
            <rfilter type="box"/>
        </film>
    </sensor>
{shapes}    <shape type="cube" id="box">
        <transform name="to_world">
            <scale x="0.5" y="0.6" z="0.5"/>
            <rotate y="1" angle="30"/>
            <translate x="2.9" y="0.6" z="1.6"/>
        </transform>
        {paint(BROWN)}
    </shape>
    <shape type="obj" id="screen">
        <string name="filename" value="screen.obj"/>
        {paint(WHITE)}
    </shape>
    <emitter type="point">
        <point name="position" value="{numbers(BULB, ", ")}"/>
        <rgb name="intensity" value="{numbers(INTENSITY, ", ")}"/>
    </emitter>
</scene>
""")


def write_gltf():
    file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "accessors": [],
            "bufferViews": [], "images": [{"uri": "tiles.png"}], "textures": [{"source": 0}],
            "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_specular", "KHR_materials_emissive_strength"],
            "extensions": {"KHR_lights_punctual": {"lights": [
                {"type": "point", "color": [c / 4 for c in INTENSITY], "intensity": 4 * LENS}]}},
            "cameras": [{"type": "perspective", "perspective": {"yfov": math.radians(FOV), "aspectRatio": WIDTH / HEIGHT, "znear": 0.01}}]}
    buffer = b""

    def accessor(kind, values, form):
        nonlocal buffer
        data = struct.pack(f"<{len(values)}{form}", *values)
        file["bufferViews"].append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
        buffer += data + b"\0" * (-len(data) % 4)
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[kind]
        a = {"bufferView": len(file["bufferViews"]) - 1, "componentType": 5126 if form == "f" else 5123, "count": len(values) // width,
             "type": kind}
        file["accessors"].append(a)
        return len(file["accessors"]) - 1

    def node(**properties):
        file["nodes"].append(properties)
        file["scenes"][0]["nodes"].append(len(file["nodes"]) - 1)

    for number, (name, ((points, corners), color)) in enumerate(PARTS.items()):
        attributes = {"POSITION": accessor("VEC3", [c for p in points for c in p], "f")}
        if name == "floor":
            attributes["TEXCOORD_0"] = accessor("VEC2", [c for t in FLOOR_UV for c in t], "f")
        if name == "screen":
            attributes["NORMAL"] = accessor("VEC3", [c for n in SCREEN_NORMALS for c in n], "f")
        basis = {"baseColorTexture": {"index": 0}} if color == "tiles" else {"baseColorFactor": [*color, 1]}
        material = {"name": name, "doubleSided": name != "lamp", "pbrMetallicRoughness": {**basis, "metallicFactor": 0},
                    "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}
        if name == "lamp":
            material["emissiveFactor"] = [c / 9 for c in RADIANCE]
            material["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": 9}
        file["materials"].append(material)
        file["meshes"].append({"name": name, "primitives": [
            {"attributes": attributes, "indices": accessor("SCALAR", corners, "H"), "material": number}]})
        node(name=name, mesh=number)
    node(translation=BULB, extensions={"KHR_lights_punctual": {"light": 0}})
    node(translation=EYE, camera=0)
    file["buffers"] = [{"byteLength": len(buffer), "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()}]
    with open("room.gltf", "w") as out:
        json.dump(file, out, indent=1)


def write_pbrt():
    text = f"""# Looks along -z with x to the right, as the others do.
Scale -1 1 1
LookAt {numbers(EYE)}  2 1.5 0  0 1 0
Camera "perspective" "float fov" {FOV}
Film "rgb" "integer xresolution" {WIDTH} "integer yresolution" {HEIGHT}
PixelFilter "box"
Integrator "path" "integer maxdepth" 100
WorldBegin
LightSource "point" "rgb I" [ {numbers(INTENSITY)} ] "point3 from" [ {numbers(BULB)} ]
Texture "tiles" "spectrum" "imagemap" "string filename" "tiles.png"
"""
    for name, ((points, corners), color) in PARTS.items():
        reflectance = '"texture reflectance" "tiles"' if color == "tiles" else f'"rgb reflectance" [ {numbers(color)} ]'
        text += f'AttributeBegin # {name}\n  Material "diffuse" {reflectance}\n'
        if name == "lamp":
            text += f'  AreaLightSource "diffuse" "rgb L" [ {numbers(RADIANCE)} ]\n'
        text += f'  Shape "trianglemesh"\n    "point3 P" [ {flat(points)} ]\n'
        if name == "floor":
            text += f'    "point2 uv" [ {flat((u, 1 - v) for u, v in FLOOR_UV)} ]\n'
        if name == "screen":
            text += f'    "normal N" [ {flat(SCREEN_NORMALS)} ]\n'
        text += f'    "integer indices" [ {numbers(corners)} ]\nAttributeEnd\n'
    with open("room.pbrt", "w") as file:
        file.write(text)


def write_dae():
    effects = materials = geometries = nodes = ""
    for name, ((points, corners), color) in PARTS.items():
        def source(kind, values, names):
            params = "".join(f'<param name="{n}" type="float"/>' for n in names)
            return (f'<source id="{name}-{kind}"><float_array id="{name}-{kind}-array" count="{len(values) * len(names)}">{flat(values)}'
                    f'</float_array><technique_common><accessor source="#{name}-{kind}-array" count="{len(values)}" '
                    f'stride="{len(names)}">{params}</accessor></technique_common></source>\n')

        sources, inputs, indices = source("positions", points, "XYZ"), "", [[c] for c in corners]
        if name == "floor":
            sources += source("map", [(u, 1 - v) for u, v in FLOOR_UV], "ST")
            inputs = f'<input semantic="TEXCOORD" source="#{name}-map" offset="1" set="0"/>'
        if name == "screen":
            sources += source("normals", SCREEN_NORMALS, "XYZ")
            inputs = f'<input semantic="NORMAL" source="#{name}-normals" offset="1"/>'
        if inputs:
            indices = [i * 2 for i in indices]
        geometries += (f'<geometry id="{name}-mesh"><mesh>\n{sources}<vertices id="{name}-vertices"><input semantic="POSITION" '
                       f'source="#{name}-positions"/></vertices>\n<triangles material="paint" count="{len(corners) // 3}">'
                       f'<input semantic="VERTEX" source="#{name}-vertices" offset="0"/>{inputs}<p>'
                       f'{" ".join(str(i) for corner in indices for i in corner)}</p></triangles>\n</mesh></geometry>\n')
        diffuse = '<texture texture="tiles-sampler" texcoord="UVMap"/>' if color == "tiles" else f"<color>{numbers(color)} 1</color>"
        parameters = ('<newparam sid="tiles-surface"><surface type="2D"><init_from>tiles</init_from></surface></newparam>'
                      '<newparam sid="tiles-sampler"><sampler2D><source>tiles-surface</source></sampler2D></newparam>') * (color == "tiles")
        emission = f"<emission><color>{numbers(RADIANCE)} 1</color></emission>" * (name == "lamp")
        effects += (f'<effect id="{name}-effect"><profile_COMMON>{parameters}<technique sid="common"><lambert>{emission}<diffuse>{diffuse}'
                    f"</diffuse></lambert></technique></profile_COMMON></effect>\n")
        materials += f'<material id="{name}-material"><instance_effect url="#{name}-effect"/></material>\n'
        bind = '<bind_vertex_input semantic="UVMap" input_semantic="TEXCOORD" input_set="0"/>' * (color == "tiles")
        nodes += (f'<node id="{name}"><instance_geometry url="#{name}-mesh"><bind_material><technique_common>'
                  f'<instance_material symbol="paint" target="#{name}-material">{bind}</instance_material></technique_common></bind_material>'
                  f"</instance_geometry></node>\n")
    with open("room.dae", "w") as file:
        file.write(f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset>
<library_cameras><camera id="camera"><optics><technique_common><perspective><yfov>{FOV}</yfov><aspect_ratio>{WIDTH / HEIGHT:.9g}</aspect_ratio>
<znear>0.01</znear><zfar>1000</zfar></perspective></technique_common></optics></camera></library_cameras>
<library_lights><light id="bulb"><technique_common><point><color>{numbers(INTENSITY)}</color><constant_attenuation>0</constant_attenuation>
<linear_attenuation>0</linear_attenuation><quadratic_attenuation>1</quadratic_attenuation></point></technique_common></light></library_lights>
<library_images><image id="tiles"><init_from>tiles.png</init_from></image></library_images>
<library_effects>
{effects}</library_effects>
<library_materials>
{materials}</library_materials>
<library_geometries>
{geometries}</library_geometries>
<library_visual_scenes><visual_scene id="room">
{nodes}<node id="light"><translate>{numbers(BULB)}</translate><instance_light url="#bulb"/></node>
<node id="eye"><translate>{numbers(EYE)}</translate><instance_camera url="#camera"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#room"/></scene>
</COLLADA>
""")


# The floor is the top of a slab, of which the rest is not seen: a quad's picture would lie the other way round.
def write_tungsten():
    def quad(name, position, scale, rotation, **more):
        return {"name": name, "type": "quad", "transform": {"position": position, "scale": scale, "rotation": rotation}, "bsdf": name, **more}

    area = 1
    scene = {
        "media": [],
        "bsdfs": [{"name": name, "type": "lambert", "albedo": "tiles.png" if color == "tiles" else color[0] if color == WHITE else color}
                  for name, (_, color) in PARTS.items() if name != "lamp"] + [{"name": "lamp", "type": "null"}],
        "primitives": [
            {"name": "floor", "type": "cube", "transform": {"position": [2, -0.05, 2], "scale": [4, 0.1, 4], "rotation": [0, -90, 0]},
             "bsdf": "floor"},
            quad("ceiling", [2, 3, 2], 4, [180, 0, 0]),
            quad("back", [2, 1.5, 0], [4, 1, 3], [90, 0, 0]),
            quad("left", [0, 1.5, 2], [3, 1, 4], [0, 0, -90]),
            quad("right", [4, 1.5, 2], [3, 1, 4], [0, 0, 90]),
            quad("lamp", [1.5, 2.9, 1.5], 1, [0, 0, 180], power=[math.pi * area * c for c in RADIANCE]),
            {"name": "box", "type": "cube", "transform": {"position": [2.9, 0.6, 1.6], "scale": [1, 1.2, 1], "rotation": [0, -30, 0]},
             "bsdf": "box"},
            {"name": "screen", "type": "mesh", "file": "screen.obj", "smooth": True, "bsdf": "screen"},
            {"name": "bulb", "type": "point", "transform": {"position": BULB}, "power": [4 * math.pi * c for c in INTENSITY]},
        ],
        "camera": {"type": "pinhole", "fov": 2 * math.degrees(math.atan(math.tan(math.radians(FOV / 2)) * WIDTH / HEIGHT)),
                   "resolution": [WIDTH, HEIGHT], "reconstruction_filter": "box", "tonemap": "filmic",
                   "transform": {"position": EYE, "look_at": [2, 1.5, 0], "up": [0, 1, 0]}},
        "integrator": {"type": "path_tracer", "max_bounces": 64},
        "renderer": {"spp": 64},
    }
    with open("room.json", "w") as file:
        json.dump(scene, file, indent=1)


for write in (write_xml, write_gltf, write_pbrt, write_dae, write_tungsten):
    write()
