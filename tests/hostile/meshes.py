"""Mesh files of every format, as a known object: damaged, lying, or more than they look."""

import base64
import io
import json
import os
import struct
import zipfile

import base
from case import PLAN, Case, changed, text_of

TETRAHEDRON = [(0, 0, 0), (0.05, 0, 0), (0, 0.05, 0), (0, 0, 0.05)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def _stl(count=None, faces=FACES, points=TETRAHEDRON):
    data = b"\0" * 80 + struct.pack("<I", len(faces) if count is None else count)
    for face in faces:
        data += struct.pack("<3f", 0, 0, 0) + b"".join(struct.pack("<3f", *points[i]) for i in face) + b"\0\0"
    return data


def _ply(vertices="4", faces="4", body=None, form="ascii",
    properties="property float x\nproperty float y\nproperty float z\n",
    indices="property list uchar int vertex_indices\n"):
    body = body if body is not None else "".join(f"{x} {y} {z}\n" for x, y,
        z in TETRAHEDRON) + "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES)
    head = f"ply\nformat {form} 1.0\nelement vertex {vertices}\n{properties}element face {faces}\n{indices}end_header\n"
    return head.encode() + (body.encode() if isinstance(body, str) else body)


def _off(head="OFF\n4 4 0\n", tail=""):
    return head + "".join(f"{x} {y} {z}\n" for x, y, z in TETRAHEDRON) + "".join(f"3 {a} {b} {c}\n" for a, b,
        c in FACES) + tail


POINTS = b"".join(struct.pack("<3f", *p) for p in TETRAHEDRON)
INDICES = b"".join(struct.pack("<3H", *f) for f in FACES)


def _gltf(buffer=None, **changes):
    data = POINTS + INDICES
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
                "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                + base64.b64encode(data).decode()}]}
    if buffer is not None:
        document["buffers"][0].update(buffer)
    for path, value in changes.items():
        document = changed(document, path.replace("__", "/"), value)
    return json.dumps(document)


def _glb(text=None, data=POINTS + INDICES, version=2, length=None, chunk=None):
    document = json.loads(_gltf())
    del document["buffers"][0]["uri"]
    text = (text or json.dumps(document)).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I", len(text) if chunk is None else chunk) + b"JSON" + text + struct.pack("<I",
        len(data)) + b"BIN\0" + data
    return b"glTF" + struct.pack("<II", version, 12 + len(body) if length is None else length) + body


def _zip(entries):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries.items():
            archive.writestr(name, content)
    return out.getvalue()


DAE = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="12">{numbers}</float_array><technique_common>
<accessor source="#a" count="{count}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#{source}"/></vertices><triangles count="4">
<input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
NUMBERS = " ".join(str(x) for p in TETRAHEDRON for x in p)
CORNERS = " ".join(str(i) for f in FACES for i in f)


def _dae(numbers=NUMBERS, count=4, source="p", indices=CORNERS):
    return DAE.format(numbers=numbers, count=count, source=source, indices=indices)


ENTITIES = "<!DOCTYPE c [" + '<!ENTITY a0 "' + "x" * 100 + '">' + "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">'
    for i in range(1, 10)) + "]><COLLADA>&a9;</COLLADA>"
EXTERNAL = '<!DOCTYPE c [<!ENTITY f SYSTEM "file:///etc/passwd">]><COLLADA version="1.4.1">&f;</COLLADA>'
MODEL_3MF = ('<?xml version="1.0"?>'
    '<model unit="meter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">'
    '<resources>{objects}</resources><build>{items}</build></model>')
TYPES_3MF = '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>'
RELATIONS = ('<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
    '</Relationships>')


def _3mf(model):
    return _zip({"[Content_Types].xml": TYPES_3MF, "_rels/.rels": RELATIONS, "3D/3dmodel.model": model})


BINARY = "binary_little_endian"
DAMAGED = {
    "empty.stl": b"", "short.stl": b"\0" * 50, "header-only.stl": b"\0" * 84,
    "count-lies.stl": _stl(count=4000000000), "cut-off.stl": _stl()[:-60],
    "nan.stl": _stl(points=[(float("nan"), 0, 0)] + TETRAHEDRON[1:]),
    "infinite.stl": _stl(points=[(float("inf"), 0, 0)] + TETRAHEDRON[1:]),
    "text-cut-off.stl": "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nver",
    "text-no-number.stl": "solid a\nfacet normal 0 0 1\nouter loop\nvertex a b c\nendloop\nendfacet\nendsolid\n",
    "text-empty.stl": "solid a\nendsolid a\n", "all-flat.stl": _stl(points=[(0, 0, 0)] * 4),
    "empty.ply": b"", "no-end.ply": b"ply\nformat ascii 1.0\n",
    "count-lies.ply": _ply(vertices="4000000000", form=BINARY, body=b"0123456789"),
    "count-overflows.ply": _ply(vertices="99999999999999999999"),
    "negative-count.ply": _ply(vertices="-4"), "index-out.ply": _ply(body="0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    + "3 0 1 4\n" * 4), "negative-index.ply": _ply(body="0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + "3 0 1 -1\n" * 4),
    "no-numbers.ply": _ply(body="a b c\n" * 8), "cut-off.ply": _ply(body="0 0 0\n1 0"),
    "no-faces.ply": _ply(faces="0", body="0 0 0\n" * 4), "format.ply": _ply(form="octal"),
    "no-x.ply": _ply(properties="property float y\nproperty float z\n"),
    "list-lies.ply": _ply(form=BINARY, body=POINTS + b"\xff\xff\xff\xff",
    indices="property list uint int vertex_indices\n"), "property.ply":
    _ply(properties="property quad x\nproperty float y\nproperty float z\n"),
    "1e400.ply": _ply(body="1e400 0 0\n" * 4 + "3 0 1 2\n" * 4),
    "empty.obj": "", "no-faces.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
    "index-0.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "index-out.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
    "index-before.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -9\n",
    "index-huge.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n",
    "nan.obj": "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "words.obj": "v a b c\nf 1 2 3\n",
    "binary.obj": bytes(range(256)) * 20, "short-vertex.obj": "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "1e39.obj": "v 1e39 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "empty.off": "", "counts.off": "OFF\n-1 -1 -1\n", "counts-lie.off": "OFF\n4000000000 4000000000 0\n0 0 0\n",
    "index-out.off": _off(tail="").replace("3 1 2 3", "3 1 2 9"), "cut-off.off": _off()[:30],
    "magic.off": "FOO\n4 4 0\n", "corners.off": "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n",
    "4OFF.off": "4OFF\n1 0 0\n",
    "empty.gltf": "", "no-json.gltf": "{", "no-meshes.gltf": '{"asset": {"version": "2.0"}}',
    "version-1.gltf": _gltf(asset__version="1.0"), "deep.gltf": "[" * 200000,
    "accessor-out.gltf": _gltf(accessors__0__count=400000000),
    "view-out.gltf": _gltf(bufferViews__0__byteLength=1 << 40),
    "offset-out.gltf": _gltf(bufferViews__1__byteOffset=1 << 60),
    "index-out.gltf": _gltf(bufferViews__1__byteOffset=0), "negative.gltf": _gltf(accessors__0__count=-4),
    "no-view.gltf": _gltf(accessors__0__bufferView=99), "component.gltf": _gltf(accessors__0__componentType=1),
    "type.gltf": _gltf(accessors__0__type="MAT9"),
    "base64.gltf": _gltf({"uri": "data:application/octet-stream;base64,!!!!"}),
    "buffer-short.gltf": _gltf({"uri": "data:application/octet-stream;base64,AAAA"}),
    "buffer-missing.gltf": _gltf({"uri": "none.bin"}), "traversal.gltf":
    _gltf({"uri": "../../../../../../etc/passwd"}), "absolute.gltf": _gltf({"uri": "/etc/passwd"}),
    "web.gltf": _gltf({"uri": "http://example.org/a.bin"}), "file-uri.gltf": _gltf({"uri": "file:///etc/passwd"}),
    "device.gltf": _gltf({"uri": "/dev/zero"}), "node-loop.gltf": _gltf(nodes=[{"children": [0], "mesh": 0}]),
    "node-out.gltf": _gltf(nodes=[{"children": [7]}]), "node-matrix.gltf":
    _gltf(nodes=[{"mesh": 0, "matrix": [1, 2]}]),
    "node-scale.gltf": _gltf(nodes=[{"mesh": 0, "scale": [1e300, 1, 1]}]),
    "many-nodes.gltf": _gltf(nodes=[{"mesh": 0, "children": [i + 1, i + 1]} for i in range(40)] + [{"mesh": 0}]),
    "draco.gltf": _gltf(extensionsRequired=["KHR_draco_mesh_compression"]),
    "floats.gltf": _gltf(accessors__0__count=4.5), "string.gltf": _gltf(meshes="m"),
    "empty.glb": b"", "header-only.glb": b"glTF\2\0\0\0\x0c\0\0\0", "length-lies.glb": _glb(length=1 << 31),
    "chunk-lies.glb": _glb(chunk=0x7FFFFFFF), "version-9.glb": _glb(version=9),
    "data-short.glb": _glb(data=POINTS[:10]), "cut-off.glb": _glb()[:100], "version-1.glb": _glb(version=1),
    "empty.dae": "", "no-xml.dae": "<COLLADA", "no-geometry.dae": "<COLLADA version='1.4.1'/>",
    "entities.dae": ENTITIES, "external.dae": EXTERNAL, "index-out.dae": _dae(indices="0 1 99 " * 4),
    "source-missing.dae": _dae(source="q"), "source-itself.dae": _dae(source="v"),
    "words.dae": _dae(numbers="a b c " * 4), "deep.dae": "<a>" * 100000,
    "empty.fbx": b"", "text.fbx": "; FBX 7.4.0 project file\n",
    "binary.fbx": b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400) + b"\xff" * 200,
    "nested.fbx": "; FBX 7.4.0 project file\n" + "A: {" * 50000,
    "empty.3ds": b"", "length-lies.3ds": struct.pack("<HI", 0x4D4D, 0xFFFFFFFF) + b"\0" * 50,
    "length-0.3ds": struct.pack("<HI", 0x4D4D, 0) * 100, "inner.3ds": struct.pack("<HIHIHIH", 0x4D4D, 20, 0x3D3D, 14,
    0x4000, 8, 0xFFFF),
    "empty.3mf": b"", "no-zip.3mf": b"PK\3\4" + b"\xff" * 100, "no-model.3mf": _zip({"a.txt": "a"}),
    "no-xml.3mf": _3mf("<model"), "no-object.3mf": _3mf(MODEL_3MF.format(objects="", items="")),
    "index-out.3mf":
    _3mf(
    MODEL_3MF.format(
    objects=('<object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/></vertices><triangles>'
        '<triangle v1="0" v2="1" v3="99999999"/></triangles></mesh></object>'),
    items='<item objectid="1"/>')),
    "bomb.3mf": _3mf("<model>" + " " * (300 << 20)), "itself.3mf":
    _3mf(
    MODEL_3MF.format(
    objects='<object id="1" type="model"><components><component objectid="1"/></components></object>',
    items='<item objectid="1"/>')),
    "other.x": "xof 0303txt 0032\n", "other.blend": b"BLENDER", "other.ifc": "ISO-10303-21;",
    "other.step": "ISO-10303-21;", "no-ending": _stl(), "pointer.stl":
    "version https://git-lfs.github.com/spec/v1\noid sha256:" + "0" * 64 + "\nsize 12345\n",
}
# Harmless dirt: read, with a warning where something was left out.
READ = {"right.stl": _stl(), "right.ply": _ply(), "right.off": _off(), "right.gltf": _gltf(), "right.glb": _glb(),
    "right.dae": _dae(), "count-lies.dae": _dae(count=400000000),  # there are the numbers that it needs
       
        "spare-bytes.stl": _stl() + b"\0\0", "unused-nan.ply": _ply(vertices="5",
        body="".join(f"{x} {y} {z}\n" for x, y, z in TETRAHEDRON) + "nan 0 0\n" + "".join(f"3 {a} {b} {c}\n" for a,
        b, c in FACES)),
        "STL-as-text-name.stl": b"solid" + _stl()[5:]}


def _cell(mesh):
    return text_of(changed(base.CELL, "known_objects/0/mesh", mesh))


def _fifo_beside(folder):
    os.mkfifo(folder / "pipe.bin")


def _link_beside(folder):
    (folder / "link.bin").symlink_to("/etc/passwd")


def cases():
    for name, content in DAMAGED.items():
        yield Case("mesh/" + name, PLAN, (3, 6) if name == "bomb.3mf" else 3, (name,),
            {"cell.yaml": _cell(name), name: content})
    for name, content in READ.items():
        yield Case("mesh/" + name, PLAN, 0, (), {"cell.yaml": _cell(name), name: content})
    for name, prepare in (("pipe.bin", _fifo_beside), ("link.bin", _link_beside)):
        yield Case("mesh/gltf " + name, PLAN, 3, (name,), {"cell.yaml": _cell("m.gltf"),
            "m.gltf": _gltf({"uri": name})}, prepare=prepare)
