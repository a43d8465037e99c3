"""Renders a scene of `fullbright-lab export` with Blender's Cycles, as Fullbright means it. Blender runs this:

    blender --background --factory-startup --python testdemos/outside/cycles.py -- SCENE.gltf OUT.exr SAMPLES SEED LOOKED_FOR

glTF's importer makes Principled materials, whose diffuse part is not Lambert's; materials without a coat get
Lambert's here. Light
takes as many reflections as `r_bounces` said, nothing is clamped, and pixels are boxes, as in the laboratory's references. LOOKED_FOR
0 leaves it to chance to find what glows: Cycles 3.4 errs by some per cent where it looks for triangles that are near.
"""

import json
import sys

import bpy
import numpy

if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Debian 12's importer wants it, its numpy has dropped it


def has_coat(material):
    """Of glTF's text: Blender 3.4's importer leaves KHR_materials_specular out."""
    specular = material.get("extensions", {}).get("KHR_materials_specular", {}).get("specularFactor", 1)
    return specular > 0 or material["pbrMetallicRoughness"].get("metallicFactor", 1) > 0


def lambert(material):
    """Replaces Principled by Lambert and emission, with what was linked to it."""
    tree = material.node_tree
    principled = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    links = tree.links

    def take_over(name, to):
        source = principled.inputs[name]
        if source.links:
            links.new(source.links[0].from_socket, to)
        else:
            to.default_value = source.default_value

    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Roughness"].default_value = 0
    take_over("Base Color", diffuse.inputs["Color"])
    take_over("Normal", diffuse.inputs["Normal"]) if principled.inputs["Normal"].links else None
    emission = tree.nodes.new("ShaderNodeEmission")
    take_over("Emission", emission.inputs["Color"])
    take_over("Emission Strength", emission.inputs["Strength"])
    both = tree.nodes.new("ShaderNodeAddShader")
    links.new(diffuse.outputs[0], both.inputs[0])
    links.new(emission.outputs[0], both.inputs[1])
    result = both.outputs[0]
    alpha = principled.inputs["Alpha"]
    if alpha.links or alpha.default_value < 1:
        mix = tree.nodes.new("ShaderNodeMixShader")
        take_over("Alpha", mix.inputs["Fac"])
        links.new(tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[1])
        links.new(result, mix.inputs[2])
        result = mix.outputs[0]
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL" and n.is_active_output)
    links.new(result, output.inputs["Surface"])


def set_visibility(gltf):
    """What only some rays see: glTF has no word for it."""
    for node in gltf["nodes"]:
        seen = node.get("extras", {}).get("fullbright")
        thing = bpy.data.objects.get(node.get("name", ""))
        if seen is None or thing is None or "seen_by_camera" not in seen:
            continue
        thing.visible_camera = seen["seen_by_camera"]
        for kind in ("diffuse", "glossy", "transmission", "volume_scatter", "shadow"):
            setattr(thing, "visible_" + kind, seen["seen_by_other_rays"])


def main():
    path, out, samples, seed, looked_for = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    with open(path, encoding="utf-8") as file:
        gltf = json.load(file)
    facts = gltf["extras"]["fullbright"]
    scene = bpy.context.scene
    scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")
    size = gltf["cameras"][0]["extras"]["fullbright"]
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = size["width"], size["height"], 100
    coated = sorted(m["name"] for m in gltf["materials"] if has_coat(m))
    for material in bpy.data.materials:
        material.cycles.sample_as_light = looked_for != "0"
        if material.name not in coated:
            lambert(material)
    if coated:
        print(f"coats and metals are Principled's: {', '.join(coated)}")
    set_visibility(gltf)
    scene.world = bpy.data.worlds.new("behind everything")
    scene.world.use_nodes = True
    color = facts["sky"] if facts["behind_everything"] else [0, 0, 0]
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (*color, 1)

    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = int(samples), int(seed)
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = facts["bounces"] - 1  # Cycles counts from the first reflection on
    for kind in ("diffuse", "glossy", "transmission"):
        setattr(cycles, kind + "_bounces", cycles.max_bounces)
    cycles.transparent_max_bounces = 256
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    scene.view_settings.view_transform = "Raw"
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"
    render.filepath = out
    bpy.ops.render.render(write_still=True)


main()
