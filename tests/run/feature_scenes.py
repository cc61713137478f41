#!/usr/bin/env python3
"""Small glTF files, one a feature, none with a light or a camera unless it is about those: FOLDER/NAME.gltf."""
import base64
import json
import math
import struct
import sys
import zlib

FLOAT, USHORT, SHORT, UBYTE = 5126, 5123, 5122, 5121
CODES = {FLOAT: "f", USHORT: "H", SHORT: "h", UBYTE: "B"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class File:
    def __init__(self):
        self.data = b""
        self.d = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                  "materials": [], "accessors": [], "bufferViews": []}

    def view(self, raw, **more):
        self.data += b"\0" * (-len(self.data) % 4)
        self.d["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw), **more})
        self.data += raw
        return len(self.d["bufferViews"]) - 1

    def accessor(self, values, kind="VEC3", component=FLOAT, **more):
        raw = struct.pack(f"<{len(values)}{CODES[component]}", *values)
        entry = {"bufferView": self.view(raw), "componentType": component, "count": len(values) // WIDTHS[kind], "type": kind}
        self.d["accessors"].append({**entry, **more})
        return len(self.d["accessors"]) - 1

    def material(self, color=(0.7, 0.7, 0.7, 1), rough=0.9, **more):
        pbr = {"baseColorFactor": list(color), "metallicFactor": 0, "roughnessFactor": rough, **more.pop("pbr", {})}
        self.d["materials"].append({"pbrMetallicRoughness": pbr, **more})
        return len(self.d["materials"]) - 1

    def mesh(self, primitive, **more):
        self.d["meshes"].append({"primitives": [primitive], **more})
        return len(self.d["meshes"]) - 1

    def node(self, **node):
        self.d["nodes"].append(node)
        self.d["scenes"][0]["nodes"].append(len(self.d["nodes"]) - 1)
        return len(self.d["nodes"]) - 1

    def box(self, material, half=(0.5, 0.5, 0.5), **attributes):
        places, normals, indices, uvs = box_arrays(half)
        primitive = {"attributes": {"POSITION": self.accessor(places), "NORMAL": self.accessor(normals),
                                    "TEXCOORD_0": self.accessor(uvs, "VEC2"), **attributes},
                     "indices": self.accessor(indices, "SCALAR", USHORT), "material": material}
        return self.mesh(primitive)

    def floor(self):
        self.node(name="floor", mesh=self.box(self.material((0.6, 0.55, 0.5, 1)), (4, 0.1, 4)), translation=[0, -0.1, 0])

    def texture(self, pixel):
        rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(16)) for y in range(16))
        chunk = lambda name, body: struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
        png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 16, 16, 8, 6, 0, 0, 0)) +
               chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
        self.d.setdefault("images", []).append({"uri": "data:image/png;base64," + base64.b64encode(png).decode()})
        self.d.setdefault("textures", []).append({"source": len(self.d["images"]) - 1})
        return len(self.d["textures"]) - 1

    def uses(self, *extensions):
        self.d["extensionsUsed"] = list(extensions)

    def save(self, path):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.d["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        json.dump(self.d, open(path, "w"))


def box_arrays(half):
    places, normals, uvs, indices = [], [], [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(places) // 3
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = [0, 0, 0]
                corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3] = side, u, v
                places += [c * h for c, h in zip(corner, half)]
                normals += [side if a == axis else 0 for a in range(3)]
                uvs += [(u + 1) / 2, (v + 1) / 2]
            order = (0, 1, 2, 0, 2, 3) if side > 0 else (0, 2, 1, 0, 3, 2)
            indices += [first + i for i in order]
    return places, normals, indices, uvs


def vertex_colours(f):
    f.floor()
    colours = [c for i in range(24) for c in ((255, 60, 60), (60, 255, 60), (80, 80, 255), (250, 250, 80))[i % 4] + (255,)]
    f.node(mesh=f.box(f.material((1, 1, 1, 1)), COLOR_0=f.accessor(colours, "VEC4", UBYTE, normalized=True)), translation=[0, 0.5, 0])


def strips_and_fans(f):
    f.floor()
    wave = [c for i in range(9) for y in (0, 1.5) for c in (i / 4 - 1, y, 0.3 * math.sin(i))]
    disk = [0, 0.02, 1] + [c for i in range(13) for c in (0.7 * math.cos(i * math.tau / 12), 0.02, 1 + 0.7 * -math.sin(i * math.tau / 12))]
    for places, mode in ((wave, 5), (disk, 6)):
        f.node(mesh=f.mesh({"attributes": {"POSITION": f.accessor(places)}, "mode": mode,
                            "material": f.material((0.8, 0.5, 0.2, 1), doubleSided=True)}))


def sparse(f):
    f.floor()
    mesh = f.box(f.material((0.3, 0.6, 0.8, 1)))
    position = f.d["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"]
    rows = f.view(struct.pack("<4H", 8, 9, 14, 15))
    values = f.view(struct.pack("<12f", *[c for x in (-1, 1, 1, -1) for c in (0.2 * x, 1.5, 0.1)]))
    f.d["accessors"][position]["sparse"] = {"count": 4, "indices": {"bufferView": rows, "componentType": USHORT},
                                            "values": {"bufferView": values}}
    f.node(mesh=mesh, translation=[0, 0.5, 0])


def instancing(f):
    f.uses("EXT_mesh_gpu_instancing")
    f.floor()
    places = [c for x in range(-3, 4) for z in range(-3, 4) for c in (x, 0.2, z)]
    f.node(mesh=f.box(f.material((0.5, 0.7, 0.3, 1)), (0.25, 0.25, 0.25)),
           extensions={"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": f.accessor(places)}}})


def unlit(f):
    f.uses("KHR_materials_unlit")
    f.floor()
    f.node(mesh=f.box(f.material((0.9, 0.4, 0.1, 1), extensions={"KHR_materials_unlit": {}})), translation=[0, 0.5, 0])


def quantized(f):
    f.uses("KHR_mesh_quantization")
    f.floor()
    places, normals, indices, _ = box_arrays((1, 1, 1))
    primitive = {"attributes": {"POSITION": f.accessor([int(p * 32767) for p in places], "VEC3", SHORT, normalized=True),
                                "NORMAL": f.accessor(normals)},
                 "indices": f.accessor(indices, "SCALAR", USHORT), "material": f.material((0.6, 0.3, 0.6, 1))}
    # 6 bytes a row are not a multiple of four, as attributes must be.
    view = f.d["accessors"][primitive["attributes"]["POSITION"]]["bufferView"]
    padded = b"".join(struct.pack("<4h", *[int(c * 32767) for c in places[i:i + 3]], 0) for i in range(0, 72, 3))
    f.d["accessors"][primitive["attributes"]["POSITION"]]["bufferView"] = f.view(padded, byteStride=8)
    assert view >= 0
    f.node(mesh=f.mesh(primitive), translation=[0, 0.6, 0], scale=[0.6, 0.6, 0.6])


def morph(f):
    f.floor()
    mesh = f.box(f.material((0.2, 0.5, 0.4, 1)))
    up = [c for i in range(24) for c in (0, 1 if f_place(i)[1] > 0 else 0, 0)]
    f.d["meshes"][mesh]["primitives"][0]["targets"] = [{"POSITION": f.accessor(up)}]
    f.d["meshes"][mesh]["weights"] = [0.8]
    f.node(mesh=mesh, translation=[0, 0.5, 0])


def f_place(i):
    places = box_arrays((0.5, 0.5, 0.5))[0]
    return places[3 * i:3 * i + 3]


def masked(f):
    f.floor()
    texture = f.texture(lambda x, y: (60, 160, 60, 255 if (x // 4 + y // 4) % 2 else 0))
    f.node(mesh=f.box(f.material((1, 1, 1, 1), pbr={"baseColorTexture": {"index": texture}}, alphaMode="MASK", doubleSided=True),
                      (1, 1, 0.02)), translation=[0, 1, 0])


def glass(f):
    f.uses("KHR_materials_transmission")
    f.floor()
    f.node(mesh=f.box(f.material((0.6, 0.9, 0.9, 1), 0.05, extensions={"KHR_materials_transmission": {"transmissionFactor": 0.9}})),
           translation=[0, 0.5, 0])
    f.node(mesh=f.box(f.material((0.8, 0.2, 0.2, 1))), translation=[0.4, 0.5, -1.5])


def orthographic(f):
    f.floor()
    for x in (-1.5, 0, 1.5):
        f.node(mesh=f.box(f.material((0.4 + 0.15 * x, 0.5, 0.6, 1))), translation=[x, 0.5, -x])
    f.d["cameras"] = [{"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0.1, "zfar": 50}}]
    f.node(camera=0, translation=[0, 4, 6], rotation=[-math.sin(0.3), 0, 0, math.cos(0.3)])


def emissive_room(f):
    f.uses("KHR_materials_emissive_strength")
    white = f.material((0.7, 0.7, 0.7, 1))
    for half, at in (((3, 0.1, 3), (0, -0.1, 0)), ((3, 0.1, 3), (0, 3.1, 0)), ((0.1, 1.5, 3), (-3.1, 1.5, 0)),
                     ((0.1, 1.5, 3), (3.1, 1.5, 0)), ((3, 1.5, 0.1), (0, 1.5, -3.1)), ((3, 1.5, 0.1), (0, 1.5, 3.1))):
        f.node(mesh=f.box(white, half), translation=list(at))
    lamp = f.material((0, 0, 0, 1), emissiveFactor=[1, 0.9, 0.7],
                      extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 20}})
    f.node(mesh=f.box(lamp, (0.8, 0.02, 0.8)), translation=[0, 2.95, 0])
    f.node(mesh=f.box(f.material((0.7, 0.3, 0.2, 1))), translation=[0.5, 0.5, -0.5])


SCENES = [vertex_colours, strips_and_fans, sparse, instancing, unlit, quantized, morph, masked, glass, orthographic, emissive_room]
if __name__ == "__main__":
    for scene in SCENES:
        file = File()
        scene(file)
        file.save(f"{sys.argv[1]}/{scene.__name__}.gltf")
        print(scene.__name__)
