"""Runs inside Blender: renders one scene file with Cycles, with several samples and seeds.

Plain path tracing: no clamp, no denoiser, no adaptive sampling, no light threshold, box filter.
"""
import json
import math
import pathlib
import re
import sys
import time

import bpy
import mathutils

sys.path.append(str(pathlib.Path(__file__).parent))
from job_list import run_jobs  # noqa: E402
from mitsuba_xml import Refused, read_scene  # noqa: E402


KINDS = {"diffuse": "ShaderNodeBsdfDiffuse", "light": "ShaderNodeEmission", "glass": "ShaderNodeBsdfGlass",
         "metal": "ShaderNodeBsdfGlossy"}


def shader(material, name):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    node = nodes.new(KINDS[material["kind"]])
    if "texture" in material:
        links.new(texture(nodes, links, material["texture"]), node.inputs["Color"])
    else:
        node.inputs["Color"].default_value = (*material["colour"], 1.0)
    if material["kind"] == "glass":
        make_smooth(node)
        node.inputs["IOR"].default_value = material["ior"]
    elif material["kind"] == "metal":
        node.distribution = "GGX"
        node.inputs["Roughness"].default_value = math.sqrt(material["alpha"])
    elif material["kind"] == "light":
        node.inputs["Strength"].default_value = 1.0
    links.new(node.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def make_smooth(glass):
    """Blender up to 3.6 has a distribution for it, later ones take roughness 0."""
    if "SHARP" in glass.bl_rna.properties["distribution"].enum_items:
        glass.distribution = "SHARP"
    else:
        glass.inputs["Roughness"].default_value = 0.0


def texture(nodes, links, description):
    """The colour output of a texture's node."""
    place = nodes.new("ShaderNodeMapping")
    links.new(nodes.new("ShaderNodeUVMap").outputs["UV"], place.inputs["Vector"])
    to_uv = mathutils.Matrix(description["to_uv"])
    (x, y, _), (across, up, _) = to_uv.to_translation(), to_uv.to_scale()
    if "image" in description:  # its first row is at v = 0 in Mitsuba, at v = 1 here
        node = nodes.new("ShaderNodeTexImage")
        node.image = bpy.data.images.load(description["image"])
        y, up = 1 - y, -up
    else:
        node = nodes.new("ShaderNodeTexChecker")
        node.inputs["Scale"].default_value = 2.0  # its squares have side 1; that at the origin has the second colour
        for name, colour in zip(("Color2", "Color1"), description["colours"]):
            node.inputs[name].default_value = (*colour, 1.0)
    place.inputs["Location"].default_value, place.inputs["Scale"].default_value = (x, y, 0), (across, up, 1)
    links.new(place.outputs["Vector"], node.inputs["Vector"])
    return node.outputs["Color"]


def add_shapes(scene, collection):
    for i, mesh in enumerate(scene["meshes"]):
        data = bpy.data.meshes.new(f"mesh{i}")
        data.from_pydata(mesh["vertices"], [], mesh["faces"])
        data.update()
        if "texture" in mesh["material"]:
            add_square_uvs(data)
        data.materials.append(shader(mesh["material"], f"mesh{i}"))
        collection.objects.link(bpy.data.objects.new(f"mesh{i}", data))
    for i, sphere in enumerate(scene["spheres"]):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=7, radius=sphere["radius"], location=sphere["centre"])
        made = bpy.context.object
        made.data.materials.append(shader(sphere["material"], f"sphere{i}"))
        for polygon in made.data.polygons:
            polygon.use_smooth = True


def add_square_uvs(rectangle):
    """Its four corners are those of the unit square."""
    for loop, corner in zip(rectangle.loops, rectangle.uv_layers.new().data):
        corner.uv = ((0, 0), (1, 0), (1, 1), (0, 1))[loop.vertex_index]


def add_lights(scene, collection):
    for i, lamp in enumerate(scene["points"]):
        light = bpy.data.lights.new(f"point{i}", "POINT")
        strongest = max(lamp["intensity"])
        light.color = [c / strongest for c in lamp["intensity"]]
        light.energy, light.shadow_soft_size = 4 * math.pi * strongest, 0.0
        made = bpy.data.objects.new(f"point{i}", light)
        made.location = lamp["position"]
        collection.objects.link(made)
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*scene["sky"], 1.0)
    if scene["envmap"]:
        add_sky(world.node_tree, background, scene["envmap"])
    bpy.context.scene.world = world


# From Mitsuba's directions of a sky, +y up, to those of Blender's, +z up, for which the images' columns agree.
SKY_AXES = mathutils.Matrix(((0, 0, 1), (1, 0, 0), (0, 1, 0)))


def add_sky(tree, background, envmap):
    node, place = tree.nodes.new("ShaderNodeTexEnvironment"), tree.nodes.new("ShaderNodeMapping")
    node.image = bpy.data.images.load(envmap["image"])
    turn = SKY_AXES @ mathutils.Matrix(envmap["to_world"]).to_3x3().inverted()
    place.inputs["Rotation"].default_value = turn.to_euler("XYZ")
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], place.inputs["Vector"])
    tree.links.new(place.outputs["Vector"], node.inputs["Vector"])
    tree.links.new(node.outputs["Color"], background.inputs["Color"])
    background.inputs["Strength"].default_value = envmap["scale"]




def add_camera(scene, collection):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.lens_unit, camera.angle = "HORIZONTAL", "FOV", math.radians(scene["fov"])
    camera.clip_start, camera.clip_end = 0.01, 1000
    made = bpy.data.objects.new("camera", camera)
    # Mitsuba's camera looks along +z with +x to the left, Blender's along -z with +x to the right.
    made.matrix_world = mathutils.Matrix(scene["to_world"]) @ mathutils.Matrix.Diagonal((-1, 1, -1, 1))
    collection.objects.link(made)
    bpy.context.scene.camera = made


def configure(order, max_depth):
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    render.resolution_x = render.resolution_y = order["size"]
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", order["threads"]
    image = render.image_settings
    image.file_format, image.color_depth, image.color_mode, image.exr_codec = "OPEN_EXR", "32", "RGB", "ZIP"
    render.use_compositing = render.use_sequencer = False
    render.dither_intensity = 0
    cycles.device = "CPU"
    cycles.use_denoising = cycles.use_adaptive_sampling = cycles.use_guiding = cycles.use_fast_gi = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    bounces = max(0, max_depth - 2)  # light is sampled at the camera's hit and after each bounce
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = bounces
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.use_auto_tile = False
    cycles.debug_bvh_type = "STATIC_BVH"


def render_seconds(path):
    """What Cycles itself says it rendered for, without its scene's preparation; it rounds to 0.01 s."""
    header = pathlib.Path(path).read_bytes()[:8192]
    found = re.search(rb"render_time\x00string\x00....([0-9:.]+)", header, re.S)
    seconds = 0.0
    for part in found[1].decode().split(":") if found else []:
        seconds = 60 * seconds + float(part)
    return seconds


def main():
    order = json.loads(sys.argv[-1])
    try:
        scene = read_scene(order["scene"])
    except Refused as e:
        print(f"REFUSED Cycles cannot be given {e}", flush=True)
        return
    bpy.ops.wm.read_factory_settings(use_empty=True)
    target = bpy.context.scene
    target.render.engine = "CYCLES"
    add_shapes(scene, target.collection)
    add_lights(scene, target.collection)
    add_camera(scene, target.collection)
    configure(order, scene["max_depth"])

    def render(job):
        begin = time.perf_counter()
        target.cycles.samples, target.cycles.seed = job["spp"], job["seed"]
        target.render.filepath = job["output"]
        bpy.ops.render.render(write_still=True)
        busy = time.perf_counter() - begin
        return {"seconds": max(0.01, render_seconds(job["output"])), "busy_seconds": busy}

    for _, result in run_jobs(order, render):
        print("RESULT", json.dumps(result), flush=True)


main()
