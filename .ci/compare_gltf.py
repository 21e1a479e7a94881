"""Converts glTF files of other authors with `meshwright convert --strict`, and compares each result with its source.

    compare_gltf.py MESHWRIGHT FOLDER OUTPUT

A file whose conversion succeeds must have the same content as its source: nodes, meshes, materials, textures, skins and
animations. A conversion that fails must say why. This program shares no code with Meshwright.
"""

import base64
import hashlib
import json
import struct
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

FORMATS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
LARGEST = {"b": 127, "B": 255, "h": 32767, "H": 65535}
IDENTITY = {"translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]}


class Document:
    def __init__(self, path):
        self.path = path
        data = path.read_bytes()
        binary = None
        if data[:4] == b"glTF":
            length = struct.unpack_from("<I", data, 12)[0]
            binary = data[28 + length :]
            data = data[20 : 20 + length]
        self.json = json.loads(data)
        self.buffers = [
            self.uri(buffer["uri"]) if "uri" in buffer else binary for buffer in self.json.get("buffers", [])
        ]

    def uri(self, uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",")[1])
        return (self.path.parent / unquote(uri)).read_bytes()

    def part(self, kind, index):
        return self.json[kind][index]

    def rows(self, view, offset, count, width, code):
        view = self.part("bufferViews", view)
        size = width * struct.calcsize(code)
        start = view.get("byteOffset", 0) + offset
        stride = view.get("byteStride", size)
        buffer = self.buffers[view["buffer"]]
        return [struct.unpack_from(f"<{width}{code}", buffer, start + stride * k) for k in range(count)]

    def accessor(self, index):
        accessor = self.part("accessors", index)
        code, width, count = FORMATS[accessor["componentType"]], WIDTHS[accessor["type"]], accessor["count"]
        rows = [(0,) * width] * count
        if "bufferView" in accessor:
            rows = self.rows(accessor["bufferView"], accessor.get("byteOffset", 0), count, width, code)
        if sparse := accessor.get("sparse"):
            indices, values = sparse["indices"], sparse["values"]
            kind = FORMATS[indices["componentType"]]
            places = self.rows(indices["bufferView"], indices.get("byteOffset", 0), sparse["count"], 1, kind)
            new = self.rows(values["bufferView"], values.get("byteOffset", 0), sparse["count"], width, code)
            for (place,), row in zip(places, new):
                rows[place] = row
        if accessor.get("normalized"):
            rows = [tuple(x / LARGEST[code] for x in row) for row in rows]
        return [tuple(round(x, 5) + 0.0 for x in row) for row in rows]

    def image(self, index):
        image = self.part("images", index)
        if "bufferView" in image:
            view = self.part("bufferViews", image["bufferView"])
            start = view.get("byteOffset", 0)
            data = self.buffers[view["buffer"]][start : start + view["byteLength"]]
        else:
            data = self.uri(image["uri"])
        return {"name": image.get("name"), "bytes": hashlib.sha256(data).hexdigest()}

    def texture(self, info):
        texture = self.part("textures", info["index"])
        sampler = self.part("samplers", texture["sampler"]) if "sampler" in texture else {}
        sampler = {"wrapS": 10497, "wrapT": 10497, **sampler}
        return {**info, "texCoord": info.get("texCoord", 0), "index": None, "name": texture.get("name"),
                "sampler": sampler, "image": self.image(texture["source"])}

    def material(self, index):
        if index is None:
            return None

        def resolved(value):
            if isinstance(value, dict):
                value = {key: resolved(part) for key, part in value.items()}
                return self.texture(value) if "index" in value else value
            return value

        material = resolved(self.part("materials", index))
        pbr = {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 1, "roughnessFactor": 1,
               **material.get("pbrMetallicRoughness", {})}
        defaults = {"name": f"material {index}", "emissiveFactor": [0, 0, 0], "alphaMode": "OPAQUE",
                    "doubleSided": False}
        return rounded({**defaults, **material, "pbrMetallicRoughness": pbr})

    def triangles(self, primitive):
        attributes = {name: self.accessor(index) for name, index in primitive["attributes"].items()}
        for k, target in enumerate(primitive.get("targets", [])):
            attributes |= {f"target {k} {name}": self.accessor(index) for name, index in target.items()}
        sets = [int(name[8:]) for name in attributes if name.startswith("WEIGHTS_")]

        def corner(i):
            values = {name: rows[i] for name, rows in attributes.items() if not name.startswith(("JOINTS", "WEIGHTS"))}
            weights = [pair for k in sets for pair in zip(attributes[f"JOINTS_{k}"][i], attributes[f"WEIGHTS_{k}"][i])]
            values["weights"] = tuple(sorted((joint, round(weight, 4)) for joint, weight in weights if weight > 0))
            return tuple(sorted(values.items()))

        count = len(attributes["POSITION"])
        order = [int(i) for (i,) in self.accessor(primitive["indices"])] if "indices" in primitive else range(count)
        mode = primitive.get("mode", 4)
        if mode == 4:
            faces = [order[k : k + 3] for k in range(0, len(order), 3)]
        elif mode == 5:
            faces = [order[k : k + 3] if k % 2 == 0 else [order[k], order[k + 2], order[k + 1]] for k in range(len(order) - 2)]
            faces = [face for face in faces if len(set(face)) == 3]
        else:
            faces = [[order[k], order[k + 1], order[0]] for k in range(1, len(order) - 1)]
        corners = ([corner(i) for i in face] for face in faces)
        # Two triangles are the same if they differ only in the corner at which they begin.
        return [min(face[k:] + face[:k] for k in range(3)) for face in corners]

    def mesh(self, index):
        mesh = self.part("meshes", index)
        triangles = [
            (json.dumps(self.material(primitive.get("material")), sort_keys=True), triangle)
            for primitive in mesh["primitives"]
            for triangle in self.triangles(primitive)
        ]
        weights = mesh.get("weights") or [0] * len(mesh["primitives"][0].get("targets", []))
        return {"name": mesh.get("name"), "extras": mesh.get("extras"), "weights": weights,
                "triangles": sorted(triangles)}

    def skin(self, index):
        skin = self.part("skins", index)
        matrices = skin.get("inverseBindMatrices")
        return {**skin, "joints": [self.node_name(i) for i in skin["joints"]],
                "skeleton": self.node_name(skin.get("skeleton")),
                "inverseBindMatrices": None if matrices is None else self.accessor(matrices)[: len(skin["joints"])]}

    def node_name(self, index):
        return None if index is None else self.part("nodes", index).get("name")

    def node(self, index):
        node = {key: value for key, value in self.part("nodes", index).items() if value != IDENTITY.get(key)}
        for kind, key in [("mesh", "mesh"), ("skin", "skin")]:
            if key in node:
                node[key] = getattr(self, kind)(node[key])
        if "camera" in node:
            node["camera"] = self.part("cameras", node["camera"])
        light = node.get("extensions", {}).pop("KHR_lights_punctual", None)
        if light:
            node["light"] = self.json["extensions"]["KHR_lights_punctual"]["lights"][light["light"]]
        node["children"] = [self.node(child) for child in node.get("children", [])]
        return {key: value for key, value in node.items() if value not in ({}, [])}

    def animation(self, animation):
        channels = []
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            channels.append([self.node_name(channel["target"].get("node")), channel["target"]["path"],
                             sampler.get("interpolation", "LINEAR"), self.accessor(sampler["input"]),
                             self.accessor(sampler["output"])])
        return {"name": animation.get("name"), "extras": animation.get("extras"), "channels": channels}

    def content(self):
        scenes = self.json.get("scenes", [])
        scene = scenes[self.json.get("scene", 0)] if scenes else {}
        asset = self.json["asset"]
        return {
            "copyright": asset.get("copyright"),
            "scene": [scene.get("name"), scene.get("extras"), self.json.get("extras")],
            "nodes": [self.node(root) for root in scene.get("nodes", [])],
            "animations": [self.animation(animation) for animation in self.json.get("animations", [])],
        }


def rounded(value):
    if isinstance(value, dict):
        return {key: rounded(part) for key, part in value.items()}
    if isinstance(value, list):
        return [rounded(part) for part in value]
    return round(float(value), 5) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


def difference(a, b, place=""):
    """Returns a text with the place and the values of the first difference; None if there is no difference."""
    if isinstance(a, dict) and isinstance(b, dict):
        pairs = [(key, a.get(key), b.get(key)) for key in sorted(a.keys() | b.keys())]
    elif isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)) and len(a) == len(b):
        pairs = [(i, *pair) for i, pair in enumerate(zip(a, b))]
    else:
        return None if a == b else f"{place}: {str(a)[:200]} became {str(b)[:200]}"
    return next((found for key, x, y in pairs if (found := difference(x, y, f"{place}/{key}"))), None)


def main():
    meshwright, folder, output = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    output.mkdir(parents=True, exist_ok=True)
    same, reported, failed = 0, 0, 0
    for source in sorted(path for path in folder.rglob("*") if path.suffix in (".gltf", ".glb")):
        target = output / f"{same + reported + failed}.glb"
        run = subprocess.run([meshwright, "convert", source, target, "--strict"], capture_output=True, text=True)
        if run.returncode == 1 and run.stderr.startswith("error: "):
            reported += 1
            reason = run.stderr.removeprefix("error: ").replace(f"{source}: ", "").replace(f"{target}: ", "")
            print(f"{source.relative_to(folder)}: {reason.strip()[:200]}")
            continue
        found = run.stderr if run.returncode else difference(Document(source).content(), Document(target).content())
        if found:
            failed += 1
            print(f"{source.relative_to(folder)}: CHANGED without a report: {found}")
        else:
            same += 1
    print(f"{same} files have the same content, {reported} are refused or reported, {failed} failed")
    sys.exit(failed > 0 or same == 0)


main()
