"""Cycles' pictures of a Cornell box at depths 0, 1, …, for neumann blame, and the box itself as glTF.

blender --background --factory-startup --python scenes/compare/cycles_box.py -- OUT [SAMPLES [SEED]]
"""
import math
import os
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from blender_scenes import *

out, samples, seed = (arguments() + ["256", "0"][len(arguments()) - 1:])[:3]
scene = new_scene()
white, red, green = matte("white", (.73, .73, .73)), matte("red", (.6, .06, .05)), matte("green", (.12, .43, .1))
light = lamp("lamp", (1, .7, .3), 18)
size = 5.5
rectangle("floor", white, (0, 0, 0), (size, 0, 0), (0, size, 0))
rectangle("ceiling", white, (0, size, size), (size, 0, 0), (0, -size, 0))
rectangle("back", white, (0, size, 0), (size, 0, 0), (0, 0, size))
rectangle("left", red, (0, 0, 0), (0, size, 0), (0, 0, size))
rectangle("right", green, (size, size, 0), (0, -size, 0), (0, 0, size))
rectangle("lamp", light, (2.1, 3.2, 4.4), (1.3, 0, 0), (0, -1.1, 0))


def block(name, at, width, height, angle):
    bpy.ops.mesh.primitive_cube_add(size=1, location=(*at, height / 2), rotation=(0, 0, math.radians(angle)))
    bpy.context.object.scale = (width, width, height)
    bpy.context.object.data.materials.append(white)


block("short", (3.7, 1.7), 1.65, 1.64, 17)
block("tall", (1.85, 3.5), 1.65, 3.3, -17)
# Looks down a little, so that the lamp is not in the picture: its edges would say more about pixels than about light.
camera(location=(2.75, -8, 2.75), rotation=(math.radians(80), 0, 0), lens=50, sensor_width=25, clip_start=.1)
exact_cycles(96, 96, int(samples))
scene.cycles.seed = int(seed)
os.makedirs(out, exist_ok=True)
export_glb(os.path.join(out, "box.glb"))
for material in (white, red, green):
    diffuse_in_cycles(material)
for depth in range(5):
    limit_bounces(depth)
    render(os.path.join(out, f"depth_{depth}.exr"))
