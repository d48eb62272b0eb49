// SPDX-License-Identifier: MIT
// Parts of a GLB that is not compressed, and the file that parts make. Khronos Group, "glTF 2.0 Specification", section 4.4.

const kHead = 12;
const kChunkHead = 8;
const kJson = 0x4e4f534a;
const kBinary = 0x004e4942;
const kComponents = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const kArrays = { 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };

/** The JSON of a GLB, and its binary part as a view of the bytes. */
export function partsOf(bytes) {
    const length = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength).getUint32(kHead, true);
    const end = kHead + kChunkHead + length;
    return { json: JSON.parse(new TextDecoder().decode(bytes.subarray(kHead + kChunkHead, end))), binary: bytes.subarray(end + kChunkHead) };
}

/** The numbers of an accessor as they are stored, as a view of the binary part. */
export function numbersIn(json, binary, accessor) {
    const { bufferView, byteOffset = 0, count, type, componentType } = json.accessors[accessor];
    const begin = binary.byteOffset + (json.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
    return new kArrays[componentType](binary.buffer, begin, count * kComponents[type]);
}

/** The pieces of a GLB, one after another: JSON, and the pieces of the binary part. */
export function glbPieces(json, pieces) {
    const chunk = (kind, parts, fill) => {
        const size = parts.reduce((sum, part) => sum + part.length, 0);
        const padding = new Uint8Array((4 - size % 4) % 4).fill(fill);
        return [new Uint8Array(new Uint32Array([size + padding.length, kind]).buffer), ...parts, padding];
    };
    const body = [...chunk(kJson, [new TextEncoder().encode(JSON.stringify(json))], 0x20), ...chunk(kBinary, pieces, 0)];
    const total = body.reduce((sum, piece) => sum + piece.length, kHead);
    return [new Uint8Array(new Uint32Array([0x46546c67, 2, total]).buffer), ...body];
}
