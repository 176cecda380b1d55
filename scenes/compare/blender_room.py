"""A furnished room made in Blender: room.glb for neumann, cycles.exr from Cycles, room.blend to look at, and room.dae, which lacks half.

blender --background --factory-startup --python scenes/compare/blender_room.py -- OUT [SAMPLES]

With 0 samples nothing is rendered.
"""
import math
import os
import sys

import bpy

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from blender_scenes import *

out, samples = (arguments() + ["256"])[:2]
os.makedirs(out, exist_ok=True)
scene = new_scene()


def tiles(name):
    """A picture on a matte surface, scaled, turned and moved by the node Mapping. Its corner is red, so that its place is seen."""
    material = matte(name, (1, 1, 1))
    nodes, links = material.node_tree.nodes, material.node_tree.links
    size = 64
    pixels = []
    for y in range(size):
        for x in range(size):
            color = (.7, .2, .2) if x < 16 and y < 32 else (.8, .7, .5) if (x // 16 + y // 16) % 2 else (.3, .35, .4)
            pixels += [*color, 1]
    image = bpy.data.images.new(name, size, size)
    image.pixels.foreach_set(pixels)
    image.pack()
    texture, mapping, coordinates = (nodes.new("ShaderNode" + kind) for kind in ("TexImage", "Mapping", "UVMap"))
    texture.image = image
    mapping.inputs["Scale"].default_value = (3, 2, 1)
    mapping.inputs["Location"].default_value = (.25, .1, 0)
    mapping.inputs["Rotation"].default_value = (0, 0, math.radians(20))
    links.new(coordinates.outputs[0], mapping.inputs[0])
    links.new(mapping.outputs[0], texture.inputs[0])
    links.new(texture.outputs[0], nodes["Principled BSDF"].inputs["Base Color"])
    return material


def solid_glass(name):
    """The exporter takes the thickness from a node group of this name; without it glass is a thin sheet."""
    material = principled(name, Roughness=0, IOR=1.5, Transmission=1, Base_Color=(1, 1, 1, 1))
    group = bpy.data.node_groups.new("glTF Settings", "ShaderNodeTree")
    group.inputs.new("NodeSocketFloat", "Thickness")
    node = material.node_tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    node.inputs["Thickness"].default_value = .5
    return material


def box(name, material, at, size):
    bpy.ops.mesh.primitive_cube_add(size=1, location=at)
    bpy.context.object.name, bpy.context.object.scale = name, size
    bpy.context.object.data.materials.append(material)


def ball(name, material, at, radius):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12, radius=radius, location=at)
    bpy.context.object.name = name
    bpy.context.object.data.materials.append(material)
    bpy.ops.object.shade_smooth()


floor, white, red = tiles("tiles"), matte("white", (.75, .75, .75)), matte("red", (.6, .15, .1))
wood = principled("wood", Base_Color=(.4, .25, .12, 1), Specular=.5, Roughness=.4)
metal = principled("metal", Base_Color=(.9, .8, .6, 1), Metallic=1, Roughness=.25)
glass, shine = solid_glass("glass"), lamp("lamp", (1, .9, .7), 12)

rectangle("floor", floor, (-2, -2, 0), (4, 0, 0), (0, 4, 0))
rectangle("ceiling", white, (-2, 2, 2.5), (4, 0, 0), (0, -4, 0))
rectangle("back", white, (-2, 2, 0), (4, 0, 0), (0, 0, 2.5))
rectangle("front", white, (2, -2, 0), (-4, 0, 0), (0, 0, 2.5))
rectangle("left", red, (-2, -2, 0), (0, 4, 0), (0, 0, 2.5))
rectangle("right", white, (2, 2, 0), (0, -4, 0), (0, 0, 2.5))
box("top", wood, (0, .6, .7), (1.4, .8, .05))
for number, (x, y) in enumerate([(-.62, .28), (-.62, .92), (.62, .28), (.62, .92)]):
    box(f"leg {number}", wood, (x, y, .3375), (.06, .06, .675))
ball("metal ball", metal, (-.35, .6, .947), .22)
ball("glass ball", glass, (.3, .5, .907), .18)
rectangle("lamp", shine, (-.2, .5, 2.49), (1, 0, 0), (0, -.6, 0))
bpy.ops.object.light_add(type="POINT", location=(-1.3, -.5, 1.6))
bulb = bpy.context.object.data
bulb.energy, bulb.color, bulb.shadow_soft_size = 12, (1, .7, .4), 0
camera(location=(.5, -1.9, 1.5), rotation=(math.radians(80), 0, math.radians(10)), lens=20)
exact_cycles(192, 144, int(samples))
export_glb(os.path.join(out, "room.glb"))
bpy.ops.wm.collada_export(filepath=os.path.join(out, "room.dae"))
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(out, "room.blend"))
for material in (floor, white, red):
    diffuse_in_cycles(material)
if int(samples):
    render(os.path.join(out, "cycles.exr"))
