"""What the scripts of this folder share: objects and materials of Blender, and Cycles without its savings. Runs in Blender's own Python."""
import sys

import bpy


def arguments():
    """Those behind --, which Blender leaves alone."""
    return sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []


def new_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = None  # Blender's own is grey, and no glTF file has it
    return scene


def principled(name, **inputs):
    """A material of the node Principled BSDF; underscores in names of its inputs are blanks."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    node = material.node_tree.nodes["Principled BSDF"]
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    return material


def matte(name, color):
    return principled(name, Base_Color=(*color, 1), Specular=0, Roughness=1)


def lamp(name, color, strength):
    """The surface of a lamp that reflects nothing."""
    return principled(name, Base_Color=(0, 0, 0, 1), Specular=0, Roughness=1, Emission=(*color, 1), Emission_Strength=strength)


def diffuse_in_cycles(material):
    """The node Diffuse BSDF, which is Lambert's law, in place of Principled, whose diffuse part is Burley's. Not for the export, which
    knows Principled alone."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    before = nodes["Principled BSDF"]
    node = nodes.new("ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = before.inputs["Base Color"].default_value
    for link in before.inputs["Base Color"].links:
        links.new(link.from_socket, node.inputs["Color"])
    links.new(node.outputs[0], nodes["Material Output"].inputs["Surface"])


def mesh(name, material, vertices, faces):
    data = bpy.data.meshes.new(name)
    data.from_pydata(vertices, [], faces)
    data.materials.append(material)
    placed = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(placed)
    return placed


def rectangle(name, material, corner, across, up):
    """Seen from where across runs to the right and up upwards; with texture coordinates from (0, 0) at the corner."""
    points = [corner, [c + a for c, a in zip(corner, across)], [c + a + u for c, a, u in zip(corner, across, up)],
              [c + u for c, u in zip(corner, up)]]
    placed = mesh(name, material, points, [(0, 1, 2, 3)])
    placed.data.uv_layers.new().data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])
    return placed


def camera(**properties):
    bpy.ops.object.camera_add(location=properties.pop("location"), rotation=properties.pop("rotation"))
    placed = bpy.context.object
    for name, value in properties.items():
        setattr(placed.data, name, value)
    bpy.context.scene.camera = placed


def exact_cycles(width, height, samples):
    """Cycles without what makes it faster and darker: no clamping, no threshold of lights, no blurred caustics, no limits of bounces."""
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    cycles.device, cycles.samples = "CPU", samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    limit_bounces(64)
    cycles.min_light_bounces = 4  # Russian roulette beyond, which is right on average
    cycles.pixel_filter_type = "BOX"


def limit_bounces(number):
    cycles = bpy.context.scene.cycles
    for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "transparent_max_bounces"):
        setattr(cycles, name, number)


def render(path):
    bpy.context.scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def export_glb(path):
    """As by File → Export → glTF 2.0 with Cameras and Punctual Lights."""
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", export_cameras=True, export_lights=True)
