// One mesh in every format that the page takes.

/** A cube with edges of 40, which the page has to scale. */
const POSITIONS = [[0, 0, 0], [40, 0, 0], [40, 40, 0], [0, 40, 0], [0, 0, 40], [40, 0, 40], [40, 40, 40], [0, 40, 40]];
const QUADS = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
const TRIANGLES = QUADS.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]);

const lines = (...parts) => `${parts.flat().join("\n")}\n`;
const bytes = (text) => [...new TextEncoder().encode(text)];

function obj() {
  return bytes(lines(POSITIONS.map((p) => `v ${p.join(" ")}`), QUADS.map((quad) => `f ${quad.map((i) => i + 1).join(" ")}`)));
}

function stl() {
  const facet = (corners) =>
    lines("facet normal 0 0 0", "outer loop", corners.map((i) => `vertex ${POSITIONS[i].join(" ")}`), "endloop", "endfacet");
  return bytes(`solid cube\n${TRIANGLES.map(facet).join("")}endsolid cube\n`);
}

function ply() {
  const axes = ["x", "y", "z"].map((axis) => `property float ${axis}`);
  const header = ["ply", "format ascii 1.0", `element vertex ${POSITIONS.length}`, ...axes];
  const faces = [`element face ${QUADS.length}`, "property list uchar int vertex_indices", "end_header"];
  return bytes(lines(header, faces, POSITIONS.map((p) => p.join(" ")), QUADS.map((quad) => `4 ${quad.join(" ")}`)));
}

function glb() {
  const numbers = new Float32Array(POSITIONS.flat());
  const corners = new Uint32Array(TRIANGLES.flat());
  const binary = Buffer.concat([Buffer.from(numbers.buffer), Buffer.from(corners.buffer)]);
  const json = JSON.stringify({
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: POSITIONS.length, type: "VEC3", min: [0, 0, 0], max: [40, 40, 40] },
      { bufferView: 1, componentType: 5125, count: corners.length, type: "SCALAR" },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: numbers.byteLength },
      { buffer: 0, byteOffset: numbers.byteLength, byteLength: corners.byteLength },
    ],
    buffers: [{ byteLength: binary.length }],
  });
  const text = Buffer.from(json.padEnd(Math.ceil(json.length / 4) * 4));
  const word = (...values) => Buffer.from(new Uint32Array(values).buffer);
  const length = 12 + 8 + text.length + 8 + binary.length;
  return [...Buffer.concat([word(0x46546c67, 2, length), word(text.length, 0x4e4f534a), text, word(binary.length, 0x004e4942), binary])];
}

/** Names and bytes of files with the same cube. */
export const CUBES = Object.entries({ obj, stl, ply, glb }).map(([ending, make]) => [`cube.${ending}`, make()]);
/** A square that is open, and so a cloth. */
export const SQUARE = ["square.obj", bytes("v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 4 3 2\n")];
