// Makes the files in this folder with meshoptimizer and gltfpack, the original programs of the format:
//
//     npm install --no-save gltfpack@1.3.0 meshoptimizer@1.3.0
//     node make.mjs
//
// streams.json       arrays for every codec and filter, their streams, and the arrays that MeshoptDecoder decodes from them
// torus_plain.glb    a torus, quantized by gltfpack and not compressed
// torus_ext.glb      the same with EXT_meshopt_compression
// torus_khr.glb      the same with KHR_meshopt_compression: version 1 of the attribute codec, and filters
// torus_floats.glb   the same with float attributes
// torus_fallback.*   the same with an uncompressed copy of the arrays, for readers that cannot decompress
import fs from "fs";
import { execFileSync } from "child_process";
import { MeshoptEncoder as encoder } from "meshoptimizer/encoder";
import { MeshoptDecoder as decoder } from "meshoptimizer/decoder";

await encoder.ready;
await decoder.ready;

// A random number in 0..n, from a fixed sequence.
let state = 1;
function random(n) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * n);
}

// The arrays in streams.json. Each array has one or more streams, which must all decode to the same array.
const arrays = [];
const base64 = (bytes) => Buffer.from(bytes).toString("base64");
function add(name, mode, filter, count, byteStride, streams) {
    let decoded;
    for (const stream of streams) {
        const bytes = new Uint8Array(count * byteStride);
        decoder.decodeGltfBuffer(bytes, count, byteStride, stream, mode, filter);
        if (decoded && Buffer.compare(bytes, decoded) !== 0) throw new Error(name);
        decoded = bytes;
    }
    streams = streams.map(base64);
    arrays.push({ name, mode, filter, count, byteStride, decoded: base64(decoded), streams });
}

// ---- Attributes: different content in each channel of four bytes --------------------------------

function elements(count, stride) {
    const bytes = new Uint8Array(count * stride);
    const view = new DataView(bytes.buffer);
    let rare = 0;
    for (let i = 0; i < count; i++) {
        for (let at = 0; at < stride; at += 4) {
            const place = i * stride + at;
            rare += random(12) === 0 ? random(256) : 0;
            switch ((at / 4) % 6) {
                case 0: view.setFloat32(place, Math.sin(i / 20) * 3, true); break;
                case 1: view.setInt16(place, i * 300, true); view.setInt16(place + 2, -i * 7 + random(3), true); break;
                case 2: view.setUint32(place, rare, true); break;
                case 3: for (let k = 0; k < 4; k++) bytes[place + k] = i * k; break;
                case 4: for (let k = 0; k < 4; k++) bytes[place + k] = random(256); break;
                case 5: view.setUint32(place, 0xffffffff, true); break;
            }
        }
    }
    return bytes;
}

const versions = (source, count, stride, levels) => [
    encoder.encodeVertexBufferLevel(source, count, stride, 2, 0),
    ...levels.map((level) => encoder.encodeVertexBufferLevel(source, count, stride, level, 1)),
];
for (const [count, stride, ...levels] of [[1, 4, 3], [16, 4, 3], [17, 24, 0, 3], [80, 24, 0, 1, 2, 3], [258, 12, 3]]) {
    const streams = versions(elements(count, stride), count, stride, levels);
    add(`${count} elements of ${stride} bytes`, "ATTRIBUTES", "NONE", count, stride, streams);
}
// Blocks of larger elements have fewer elements.
const long = Uint8Array.from({ length: 33 * 256 }, (_, i) => (i & 255) + (i >> 8 < 20 ? 0 : 1));
add("33 elements of 256 bytes", "ATTRIBUTES", "NONE", 33, 256, versions(long, 33, 256, [3]));
add("zeros", "ATTRIBUTES", "NONE", 600, 4, versions(new Uint8Array(2400), 600, 4, [3]));

// ---- Indices ------------------------------------------------------------------------------------

function grid(n, m) {
    const triangles = [];
    for (let i = 0; i + 1 < n; i++) {
        for (let j = 0; j + 1 < m; j++) {
            const a = i * m + j;
            triangles.push(a, a + 1, a + m, a + m, a + 1, a + m + 1);
        }
    }
    return Uint32Array.from(triangles);
}

const bytesOf = (array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
const optimized = grid(7, 7);
encoder.reorderMesh(optimized, true, true);
const mixed = Uint32Array.from({ length: 90 }, (_, i) => (i % 7 === 0 ? random(70000) : random(40)));
const first = grid(4, 4);
encoder.reorderMesh(first, true, true);
const twice = Uint32Array.from([...first, ...first, ...[...first].map((i) => i + 1000)]);
for (const [name, indices] of [["a grid", grid(7, 7)], ["an optimized grid", optimized], ["any triangles", mixed],
    ["a grid three times", twice]]) {
    add(name, "TRIANGLES", "NONE", indices.length, 4, [encoder.encodeIndexBuffer(bytesOf(indices), indices.length, 4)]);
    add(`${name}, as a list`, "INDICES", "NONE", indices.length, 4,
        [encoder.encodeIndexSequence(bytesOf(indices), indices.length, 4)]);
}
const short = Uint16Array.from(optimized);
add("a grid of shorts", "TRIANGLES", "NONE", short.length, 2,
    [encoder.encodeIndexBuffer(bytesOf(short), short.length, 2)]);
add("shorts as a list", "INDICES", "NONE", short.length, 2,
    [encoder.encodeIndexSequence(bytesOf(short), short.length, 2)]);

// ---- Filters ------------------------------------------------------------------------------------

function filtered(name, filter, stride, encoded, count) {
    add(name, "ATTRIBUTES", filter, count, stride, versions(encoded, count, stride, [2]));
}
const unit = (n) => {
    const vector = Array.from({ length: n }, () => random(2001) / 1000 - 1);
    const length = Math.hypot(...vector) || 1;
    return vector.map((x) => x / length);
};
const n = 24;
const normals = Float32Array.from(Array.from({ length: n }, () => [...unit(3), random(3) - 1]).flat());
normals.set([0, 0, 1, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0, -1, 0, 0]);
for (const bits of [4, 8]) filtered(`normals of ${bits} bits`, "OCTAHEDRAL", 4, encoder.encodeFilterOct(normals, n, 4, bits), n);
for (const bits of [10, 16]) filtered(`normals of ${bits} bits in 16`, "OCTAHEDRAL", 8, encoder.encodeFilterOct(normals, n, 8, bits), n);
const turns = Float32Array.from(Array.from({ length: n }, () => unit(4)).flat());
for (const bits of [6, 16]) filtered(`turns of ${bits} bits`, "QUATERNION", 8, encoder.encodeFilterQuat(turns, n, 8, bits), n);
const numbers = Float32Array.from({ length: 3 * n }, () => (random(2001) / 1000 - 1) * 10 ** (random(20) - 10));
for (const bits of [1, 15, 24]) filtered(`floats of ${bits} bits`, "EXPONENTIAL", 12, encoder.encodeFilterExp(numbers, n, 12, bits), n);
const colors = Float32Array.from({ length: 4 * n }, () => random(256) / 255);
for (const bits of [3, 8]) filtered(`colors of ${bits} bits`, "COLOR", 4, encoder.encodeFilterColor(colors, n, 4, bits), n);
for (const bits of [11, 16]) filtered(`colors of ${bits} bits in 16`, "COLOR", 8, encoder.encodeFilterColor(colors, n, 8, bits), n);

fs.writeFileSync("streams.json", "[\n" + arrays.map((array) => JSON.stringify(array)).join(",\n") + "\n]\n");

// ---- Whole files --------------------------------------------------------------------------------

function torus(n, m) {
    const arrays = { POSITION: [], NORMAL: [], TEXCOORD_0: [], COLOR_0: [] };
    const indices = [];
    for (let i = 0; i <= n; i++) {
        for (let j = 0; j <= m; j++) {
            // The vertices at the seams are exactly equal.
            const [u, v] = [(i % n) / n, (j % m) / m].map((x) => 2 * Math.PI * x);
            const out = [Math.cos(u) * Math.cos(v), Math.sin(u) * Math.cos(v), Math.sin(v)];
            arrays.POSITION.push(2 * Math.cos(u) + 0.75 * out[0], 2 * Math.sin(u) + 0.75 * out[1], 0.75 * out[2]);
            arrays.NORMAL.push(...out);
            arrays.TEXCOORD_0.push(i / n, j / m);
            arrays.COLOR_0.push(i / n, (i % 3) / 2, j / m, 1);
            if (i < n && j < m) {
                const a = i * (m + 1) + j;
                indices.push(a, a + m + 1, a + 1, a + 1, a + m + 1, a + m + 2);
            }
        }
    }
    const accessors = [], bufferViews = [], parts = [], attributes = {};
    let length = 0;
    const push = (array, componentType, type, size, more) => {
        const bytes = bytesOf(array);
        accessors.push({ bufferView: parts.length, componentType, type, count: array.length / size, ...more });
        bufferViews.push({ buffer: 0, byteOffset: length, byteLength: bytes.length });
        parts.push(bytes);
        length += bytes.length;
        return accessors.length - 1;
    };
    for (const [name, values] of Object.entries(arrays)) {
        const size = { POSITION: 3, NORMAL: 3, TEXCOORD_0: 2, COLOR_0: 4 }[name];
        const column = (k) => values.filter((_, i) => i % size === k).map(Math.fround);
        const bounds = (f) => Array.from({ length: size }, (_, k) => f(...column(k)));
        const more = name === "POSITION" ? { min: bounds(Math.min), max: bounds(Math.max) } : {};
        attributes[name] = push(Float32Array.from(values), 5126, `VEC${size}`, size, more);
    }
    return {
        asset: { version: "2.0" },
        scene: 0,
        scenes: [{ nodes: [0] }],
        nodes: [{ mesh: 0, name: "torus" }],
        meshes: [{ name: "torus", primitives: [{ attributes, indices: push(Uint32Array.from(indices), 5125, "SCALAR", 1) }] }],
        accessors,
        bufferViews,
        buffers: [{ byteLength: length, uri: `data:application/octet-stream;base64,${base64(Buffer.concat(parts))}` }],
    };
}

fs.writeFileSync("torus.gltf", JSON.stringify(torus(12, 8)));
const pack = (output, ...options) =>
    execFileSync("npx", ["gltfpack", "-i", "torus.gltf", "-o", output, "-kv", "-kn", ...options]);
pack("torus_plain.glb");
pack("torus_ext.glb", "-c");
pack("torus_khr.glb", "-cc", "-ce", "khr");
pack("torus_floats.glb", "-c", "-vpf", "-vtf", "-vnf");
pack("torus_fallback.gltf", "-c", "-cf");
fs.rmSync("torus.gltf");
