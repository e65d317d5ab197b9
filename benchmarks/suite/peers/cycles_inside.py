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


def shader(material, name):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    kinds = {"diffuse": "ShaderNodeBsdfDiffuse", "light": "ShaderNodeEmission", "glass": "ShaderNodeBsdfGlass",
             "metal": "ShaderNodeBsdfGlossy"}
    node = nodes.new(kinds[material["kind"]])
    node.inputs["Color"].default_value = (*material["colour"], 1.0)
    if material["kind"] == "glass":
        node.distribution, node.inputs["IOR"].default_value = "SHARP", material["ior"]
    elif material["kind"] == "metal":
        node.distribution = "GGX"
        node.inputs["Roughness"].default_value = math.sqrt(material["alpha"])
    elif material["kind"] == "light":
        node.inputs["Strength"].default_value = 1.0
    made.node_tree.links.new(node.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def add_shapes(scene, collection):
    for i, mesh in enumerate(scene["meshes"]):
        data = bpy.data.meshes.new(f"mesh{i}")
        data.from_pydata(mesh["vertices"], [], mesh["faces"])
        data.update()
        data.materials.append(shader(mesh["material"], f"mesh{i}"))
        collection.objects.link(bpy.data.objects.new(f"mesh{i}", data))
    for i, sphere in enumerate(scene["spheres"]):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=7, radius=sphere["radius"], location=sphere["centre"])
        made = bpy.context.object
        made.data.materials.append(shader(sphere["material"], f"sphere{i}"))
        for polygon in made.data.polygons:
            polygon.use_smooth = True


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
    world.node_tree.nodes["Background"].inputs[0].default_value = (*scene["sky"], 1.0)
    bpy.context.scene.world = world


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
