"""Scenes made by code: what no file of the repository has in the wanted number or kind."""
import array
import hashlib
import math
import struct

HEAD = """<scene version="3.0.0">
    <default name="width" value="512"/>
    <default name="height" value="512"/>
    <default name="spp" value="16"/>
    <default name="max_depth" value="10"/>
    <integrator type="path"><integer name="max_depth" value="$max_depth"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="{fov}"/>
        <transform name="to_world"><lookat origin="{origin}" target="{target}" up="0, 1, 0"/></transform>
        <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
        <film type="hdrfilm">
            <integer name="width" value="$width"/>
            <integer name="height" value="$height"/>
            <string name="pixel_format" value="rgb"/>
            <rfilter type="box"/>
        </film>
    </sensor>
"""

DIFFUSE = '<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="{rgb}"/></bsdf></bsdf>'
METAL = ('<bsdf type="twosided"><bsdf type="roughconductor"><string name="distribution" value="{distribution}"/>'
         '<float name="alpha" value="{alpha}"/><string name="material" value="none"/>'
         '<rgb name="specular_reflectance" value="{rgb}"/></bsdf></bsdf>')
MATERIALS = {
    "diffuse": DIFFUSE.format(rgb="0.75, 0.6, 0.45"),
    "GGX": METAL.format(distribution="ggx", alpha=0.2, rgb="0.9, 0.7, 0.3"),
    "Beckmann": METAL.format(distribution="beckmann", alpha=0.3, rgb="0.6, 0.7, 0.9"),
    "mirror": '<bsdf type="twosided"><bsdf type="conductor"><string name="material" value="none"/></bsdf></bsdf>',
    "glass": '<bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>',
    "thin glass": '<bsdf type="thindielectric"><float name="int_ior" value="1.5"/></bsdf>',
    "rough glass": '<bsdf type="roughdielectric"><string name="distribution" value="ggx"/>'
                   '<float name="alpha" value="0.2"/><float name="int_ior" value="1.5"/></bsdf>',
}

# A box of 4 x 4 x 4 about the origin, normals inward: the rectangle is [-1, 1]^2 at z = 0, normal +z.
WALLS = ('<rotate x="1" angle="-90"/><translate y="-2"/>', '<rotate x="1" angle="90"/><translate y="2"/>',
         '<rotate y="1" angle="90"/><translate x="-2"/>', '<rotate y="1" angle="-90"/><translate x="2"/>',
         '<translate z="-2"/>', '<rotate y="1" angle="180"/><translate z="2"/>')
LAMP = ('<shape type="rectangle"><transform name="to_world"><scale value="{size}"/><rotate x="1" angle="90"/>'
        '<translate value="{x}, 1.99, {z}"/></transform><emitter type="area"><rgb name="radiance" value="{radiance}"/>'
        '</emitter><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>')


def _write(folder, name, parts):
    path = folder / f"{name}.xml"
    text = "\n    ".join(parts) + "\n</scene>\n"
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
    return path


def _room(wall_material):
    head = HEAD.format(fov=70, origin="0, 0, 1.9", target="0, -0.2, 0")
    walls = [f'<shape type="rectangle"><transform name="to_world"><scale value="2"/>{place}</transform>'
             f'{wall_material}</shape>' for place in WALLS]
    return [head, *walls]


def _spheres(materials):
    """27 spheres in a grid, the materials in turn."""
    for i in range(27):
        x, y, z = ((i // 3**k % 3 - 1) * 1.1 for k in range(3))
        yield (f'<shape type="sphere"><point name="center" value="{x:.2f}, {y - 0.3:.2f}, {z - 0.5:.2f}"/>'
               f'<float name="radius" value="0.4"/>{materials[i % len(materials)]}</shape>')


def material_room(folder, name):
    """A lit room of one material with 27 spheres of it; glass spheres stand in a diffuse room."""
    return _room_of(folder, name, MATERIALS[name], MATERIALS["diffuse"] if "glass" in name else MATERIALS[name])


def _room_of(folder, name, material, wall):
    lamp = LAMP.format(size=0.5, x=0, z=0, radiance=10)
    return _write(folder, f"room-{name.replace(' ', '-')}", [*_room(wall), lamp, *_spheres([material])])


def textured_room(folder, side):
    """The diffuse room, its reflectance from an image of that many texels a side, of the same mean."""
    image = folder / f"noise-{side}.tga"
    if not image.exists():
        _write_noise(image, side)
    material = ('<bsdf type="twosided"><bsdf type="diffuse"><texture name="reflectance" type="bitmap"><string name="filename" '
                f'value="{image.name}"/><boolean name="raw" value="true"/></texture></bsdf></bsdf>')
    return _room_of(folder, f"texture {side}", material, material)


def _write_noise(path, side):
    """An 8-bit RGB TGA of pseudo-random texels about the diffuse room's reflectance."""
    random = array.array("B", hashlib.shake_128(b"texels").digest(side * 3))
    blue_green_red = (115, 153, 191) * side
    head = struct.pack("<3B2HB4H2B", 0, 0, 2, 0, 0, 0, 0, 0, side, side, 24, 0)
    rows = []
    for y in range(side):
        first = 3 * (37 * y % side)
        rows.append(bytes(m + r % 64 - 32 for m, r in zip(blue_green_red, random[first:] + random[:first])))
    path.write_bytes(head + b"".join(rows))


def many_materials(folder):
    """The room with spheres of every material."""
    lamp = LAMP.format(size=0.5, x=0, z=0, radiance=10)
    return _write(folder, "many-materials", [*_room(MATERIALS["diffuse"]), lamp, *_spheres(list(MATERIALS.values()))])


def many_lamps(folder, count):
    """The diffuse room under `count` lamps (two triangles each) of one power in all, their powers unequal."""
    side = math.ceil(math.sqrt(count))
    lamps = []
    for i in range(count):
        x, z = ((c + 0.5) / side * 3.8 - 1.9 for c in (i % side, i // side))
        lamps.append(LAMP.format(size=f"{1.2 / side:.6f}", x=f"{x:.5f}", z=f"{z:.5f}",
                                 radiance=f"{2 * (1 + i % 7) * side * side / count:.5f}"))
    diffuse = MATERIALS["diffuse"]
    return _write(folder, f"lamps-{count}", [*_room(diffuse), *lamps, *_spheres([diffuse])])


UNIFORM_SKY = '<emitter type="constant"><rgb name="radiance" value="1"/></emitter>'


def sky_of(image):
    return f'<emitter type="envmap"><string name="filename" value="{image}"/></emitter>'


def hills(folder, triangles, sky=UNIFORM_SKY, name="hills"):
    """Waves of about that many triangles under a sky."""
    cells = max(2, round(math.sqrt(triangles / 2)))
    mesh = folder / f"hills-{triangles}.ply"
    if not mesh.exists():
        _write_hills(mesh, cells)
    head = HEAD.format(fov=50, origin="0, 3.5, 7.5", target="0, 0, 0")
    shape = (f'<shape type="ply"><string name="filename" value="{mesh.name}"/><boolean name="face_normals" '
             f'value="true"/>{MATERIALS["diffuse"]}</shape>')
    return _write(folder, f"{name}-{triangles}", [head, shape, sky])


def _write_hills(path, cells):
    waves = [(0.25 * 0.5**k, 0.7 * 2.1**k, 1.3 * k, 2.1 * k) for k in range(6)]
    places = [16 * i / cells - 8 for i in range(cells + 1)]
    along_x = [[math.sin(f * x + p) for x in places] for _, f, p, _ in waves]
    along_z = [[a * math.cos(1.1 * f * z + q) for z in places] for a, f, _, q in waves]
    vertices, faces = array.array("f"), bytearray()
    for j, z in enumerate(places):
        row = [w[j] for w in along_z]
        for i, x in enumerate(places):
            vertices.extend((x, sum(r * w[i] for r, w in zip(row, along_x)), z))
    for j in range(cells):
        first = j * (cells + 1)
        for a in range(first, first + cells):
            below = a + cells + 1
            for face in ((a, below + 1, a + 1), (a, below, below + 1)):
                faces += b"\x03" + array.array("i", face).tobytes()
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices) // 3}\nproperty float x\n"
              f"property float y\nproperty float z\nelement face {2 * cells * cells}\n"
              "property list uchar int vertex_indices\nend_header\n")
    temporary = path.with_suffix(".part")
    temporary.write_bytes(header.encode() + vertices.tobytes() + bytes(faces))
    temporary.rename(path)
