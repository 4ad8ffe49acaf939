/* Scenes as bellows_design/web/packing.py packs them. */

const FORMAT = "bellows-scene";
const LARGEST = 65535;

/** Inflate zlib's bytes (ArrayBuffer or typed array). */
export async function inflate(buffer) {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("This browser cannot unpack the data (no DecompressionStream): a newer one can.");
  }
  const stream = new Blob([buffer]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/** Header and arrays of a packed binary; `expected` is the header's format. */
export async function open(buffer, expected) {
  const bytes = new Uint8Array(await inflate(buffer));
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  if (header.format !== expected || header.version !== 1) {
    throw new Error(`The data are ${header.format} ${header.version}, not ${expected} 1.`);
  }
  return { header, arrays: bytes.subarray(4 + length) };
}

/** Numbers at `place`, each the sum of differences along the points; `components` each. */
export function numbersAt(arrays, place, points, components) {
  const { offset, count, bytes } = place;
  const numbers = bytes === 2 ? new Uint16Array(count) : new Uint32Array(count);
  for (let plane = 0; plane < bytes; plane += 1) {
    const from = offset + plane * count;
    for (let i = 0; i < count; i += 1) numbers[i] |= arrays[from + i] << (8 * plane);
  }
  const row = points * components;
  for (let start = 0; start < count; start += row) {
    for (let i = start + components; i < start + row; i += 1) numbers[i] += numbers[i - components];
  }
  return numbers;
}

function summedInTime(numbers, frame) {
  for (let i = frame; i < numbers.length; i += 1) numbers[i] += numbers[i - frame];
  return numbers;
}

function unpackedField(field, arrays, points) {
  const levels = numbersAt(arrays, field.values, points, 1);
  return { ...field, levels: summedInTime(levels, points), steps: LARGEST - 1 };
}

function unpackedSurface(surface, arrays) {
  const { points, corners } = surface;
  const levels = numbersAt(arrays, surface.positions, points, 3);
  return {
    ...surface,
    cells: numbersAt(arrays, surface.cells, surface.cells.count / corners, corners),
    levels: summedInTime(levels, points * 3),
    steps: LARGEST,
    fields: surface.fields.map((field) => unpackedField(field, arrays, points)),
  };
}

/** The scene in `buffer` (ArrayBuffer): `{surfaces: [...]}` with typed arrays. */
export async function unpack(buffer) {
  const { header, arrays } = await open(buffer, FORMAT);
  return { surfaces: header.surfaces.map((surface) => unpackedSurface(surface, arrays)) };
}

/** Bytes of text in base64. */
export function bytesOfBase64(text) {
  const binary = atob(text.replace(/\s+/g, ""));
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i += 1) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
