"""Reads the part of Mitsuba's scene format that other renderers can be given, into plain values.

Runs in any Python. What it does not know is refused by name, so that no scene is rendered differently than written.
"""
import math
import pathlib
import xml.etree.ElementTree as xml


UNLIMITED = 1000  # edges of a path


class Refused(Exception):
    pass


def identity():
    return [[float(i == j) for j in range(4)] for i in range(4)]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def point(m, p):
    return tuple(sum(m[i][k] * (*p, 1.0)[k] for k in range(4)) for i in range(3))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def numbers(text):
    return [float(x) for x in text.replace(",", " ").split()]


def rgb(text):
    values = numbers(text)
    return tuple(values * 3 if len(values) == 1 else values)


def _look_at(e):
    origin, target, up = (numbers(e.get(k)) for k in ("origin", "target", "up"))
    forward = unit(minus(target, origin))
    left = unit(cross(up, forward))
    columns = (left, cross(forward, left), forward, origin)
    return [[columns[j][i] for j in range(4)] for i in range(3)] + [[0.0, 0.0, 0.0, 1.0]]


def _vector(e, default):
    if e.get("value"):
        values = numbers(e.get("value"))
        return values * 3 if len(values) == 1 else values
    return [float(e.get(k, default)) for k in "xyz"]


def _rotate(e):
    x, y, z = unit(_vector(e, 0))
    angle = math.radians(float(e.get("angle")))
    c, s, d = math.cos(angle), math.sin(angle), 1 - math.cos(angle)
    return [[c + x * x * d, x * y * d - z * s, x * z * d + y * s, 0.0],
            [y * x * d + z * s, c + y * y * d, y * z * d - x * s, 0.0],
            [z * x * d - y * s, z * y * d + x * s, c + z * z * d, 0.0], [0.0, 0.0, 0.0, 1.0]]


def _step(e):
    m = identity()
    if e.tag in ("lookat", "look_at"):
        return _look_at(e)
    if e.tag == "matrix":
        values = numbers(e.get("value"))
        return [values[4 * i:4 * i + 4] for i in range(4)]
    if e.tag == "rotate":
        return _rotate(e)
    for i, v in enumerate(_vector(e, 1 if e.tag == "scale" else 0)):
        if e.tag == "translate":
            m[i][3] = v
        elif e.tag == "scale":
            m[i][i] = v
        else:
            raise Refused(f"transform {e.tag}")
    return m


class Reader:
    """Values of one file; `$name` stands for the <default> of that name."""

    def __init__(self, path):
        self.folder = pathlib.Path(path).parent
        self.root = xml.parse(path).getroot()
        defaults = {e.get("name"): e.get("value") for e in self.root.findall("default")}
        for e in self.root.iter():
            for key, value in e.attrib.items():
                for name in sorted(defaults, key=len, reverse=True):
                    value = value.replace(f"${name}", defaults[name])
                e.set(key, value)

    def child(self, e, name, default=None):
        found = next((c for c in e if c.get("name") == name and c.tag != "transform"), None)
        if found is None:
            return default
        return found.get("value") or " ".join(found.get(axis, "0") for axis in "xyz")

    def transform(self, e):
        m = identity()
        for t in e.findall("transform"):
            for step in t:
                m = product(_step(step), m)
        return m

    def material(self, e):
        """{kind, colour, ...} of a <bsdf>."""
        kind = e.get("type")
        if kind == "twosided":
            return self.material(e.find("bsdf"))
        if kind == "diffuse":
            if e.find("texture") is not None:
                return {"kind": "diffuse", "texture": self.texture(e.find("texture"))}
            return {"kind": "diffuse", "colour": rgb(self.child(e, "reflectance", "0.5"))}
        if kind == "dielectric":
            ratio = float(self.child(e, "int_ior", 1.5046)) / float(self.child(e, "ext_ior", 1.000277))
            return {"kind": "glass", "colour": (1.0, 1.0, 1.0), "ior": ratio}
        if kind == "roughconductor" and self.child(e, "material") == "none" \
                and self.child(e, "distribution") == "ggx":
            return {"kind": "metal", "colour": rgb(self.child(e, "specular_reflectance", "1")),
                    "alpha": float(self.child(e, "alpha", 0.1))}
        raise Refused(f"bsdf {kind}")

    def texture(self, e):
        """{to_uv, and image or colours}: a bilinear, repeated sRGB image, or the two colours of a checkerboard whose
        squares are half a unit wide."""
        made = {"to_uv": self.transform(e)}
        if any(made["to_uv"][i][k] for i in range(3) for k in range(3) if i != k):
            raise Refused("a turned texture")
        if e.get("type") == "checkerboard":
            colours = [rgb(self.child(e, name, default)) for name, default in (("color0", "0.4"), ("color1", "0.2"))]
            return {**made, "colours": colours}
        if e.get("type") != "bitmap":
            raise Refused(f"texture {e.get('type')}")
        for name, only in (("filter_type", "bilinear"), ("wrap_mode", "repeat"), ("raw", "false")):
            if self.child(e, name, only) != only:
                raise Refused(f"a bitmap whose {name} is {self.child(e, name)}")
        return {**made, "image": str(self.folder / self.child(e, "filename"))}

    def material_of(self, shape):
        own, ref = shape.find("bsdf"), shape.find("ref")
        if own is None and ref is not None:
            own = next((b for b in self.root.findall("bsdf") if b.get("id") == ref.get("id")), None)
        return self.material(own) if own is not None else {"kind": "diffuse", "colour": (0.5, 0.5, 0.5)}

    def mesh(self, shape):
        """(vertices, faces) in world space; a rectangle's corners are those of the unit square of uv in turn."""
        kind, m = shape.get("type"), self.transform(shape)
        if kind == "rectangle":
            vertices, faces = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2), (0, 2, 3)]
        elif kind == "cube":
            vertices = [tuple(1 if i >> a & 1 else -1 for a in range(3)) for i in range(8)]
            faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        elif kind == "obj":
            if self.child(shape, "face_normals") != "true":
                raise Refused("smooth meshes")
            vertices, faces = self._obj(self.folder / self.child(shape, "filename"))
        else:
            raise Refused(f"shape {kind}")
        faces = [t for f in faces for t in ((f[0], f[k], f[k + 1]) for k in range(1, len(f) - 1))]
        return [point(m, v) for v in vertices], faces

    @staticmethod
    def _obj(path):
        vertices, faces = [], []
        for line in path.read_text(encoding="utf-8").splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append(tuple(map(float, words[1:4])))
            elif words[:1] == ["f"]:
                faces.append(tuple(int(w.split("/")[0]) - 1 for w in words[1:]))
        return vertices, faces

    def scene(self):
        sensor = self.root.find("sensor")
        film = sensor.find("film")
        if film.find("rfilter") is None or film.find("rfilter").get("type") != "box":
            raise Refused("a reconstruction filter other than box")
        if sensor.get("type") != "perspective":
            raise Refused(f"sensor {sensor.get('type')}")
        integrator = self.root.find("integrator")
        if integrator.get("type") not in ("path", "direct"):
            raise Refused(f"integrator {integrator.get('type')}")
        depth = 2 if integrator.get("type") == "direct" else int(self.child(integrator, "max_depth", -1))
        scene = {"max_depth": UNLIMITED if depth < 0 else depth, "to_world": self.transform(sensor), "fov": float(self.child(sensor, "fov")), "meshes": [],
                 "spheres": [], "points": [], "sky": (0.0, 0.0, 0.0), "envmap": None}
        for shape in self.root.findall("shape"):
            self._add_shape(scene, shape)
        for emitter in self.root.findall("emitter"):
            self._add_emitter(scene, emitter)
        return scene

    def _add_shape(self, scene, shape):
        emitter = shape.find("emitter")
        item = {"material": self.material_of(shape)}
        if emitter is not None:
            if any(item["material"].get("colour", (1,))):
                raise Refused("surfaces that emit and reflect")
            item["material"] = {"kind": "light", "colour": rgb(self.child(emitter, "radiance"))}
        if "texture" in item["material"] and shape.get("type") != "rectangle":
            raise Refused(f"a texture on a {shape.get('type')}")
        if shape.get("type") == "sphere":
            if emitter is not None or shape.find("transform") is not None:
                raise Refused("spheres that are transformed or emit")
            scene["spheres"].append({**item, "centre": rgb(self.child(shape, "center", "0 0 0")),
                                     "radius": float(self.child(shape, "radius", 1))})
        else:
            item["vertices"], item["faces"] = self.mesh(shape)
            scene["meshes"].append(item)

    def _add_emitter(self, scene, emitter):
        if emitter.get("type") == "constant":
            scene["sky"] = rgb(self.child(emitter, "radiance", "1"))
        elif emitter.get("type") == "envmap":
            scene["envmap"] = {"image": str(self.folder / self.child(emitter, "filename")),
                               "scale": float(self.child(emitter, "scale", 1)), "to_world": self.transform(emitter)}
        elif emitter.get("type") == "point":
            scene["points"].append({"position": rgb(self.child(emitter, "position", "0 0 0")),
                                    "intensity": rgb(self.child(emitter, "intensity", "1"))})
        else:
            raise Refused(f"emitter {emitter.get('type')}")


def read_scene(path):
    return Reader(path).scene()
