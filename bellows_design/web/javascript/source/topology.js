/* Which corners of triangles share a normal, and which edges are creases. */

/** Edges that bend by more are sharp, degrees. */
export const CREASE = 38;

/** Number of the first point at the same place as each point, in the first frame. */
function welded(surface) {
  const { levels, points } = surface;
  const first = new Map();
  const same = new Uint32Array(points);
  for (let i = 0; i < points; i += 1) {
    const key = (levels[3 * i] * 65536 + levels[3 * i + 1]) * 65536 + levels[3 * i + 2];
    const known = first.get(key);
    if (known === undefined) first.set(key, i);
    same[i] = known === undefined ? i : known;
  }
  return same;
}

/** Unit normals of all triangles in the first frame. */
function faceNormals(surface) {
  const { cells, levels, low, high, steps } = surface;
  const scale = [0, 1, 2].map((axis) => (high[axis] - low[axis]) / steps);
  const normals = new Float32Array(cells.length);
  for (let t = 0; t < cells.length; t += 3) {
    const [a, b, c] = [3 * cells[t], 3 * cells[t + 1], 3 * cells[t + 2]];
    const ux = (levels[b] - levels[a]) * scale[0], vx = (levels[c] - levels[a]) * scale[0];
    const uy = (levels[b + 1] - levels[a + 1]) * scale[1], vy = (levels[c + 1] - levels[a + 1]) * scale[1];
    const uz = (levels[b + 2] - levels[a + 2]) * scale[2], vz = (levels[c + 2] - levels[a + 2]) * scale[2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const length = Math.hypot(x, y, z) || 1;
    normals.set([x / length, y / length, z / length], t);
  }
  return normals;
}

function root(parents, corner) {
  let at = corner;
  while (parents[at] !== at) {
    parents[at] = parents[parents[at]];
    at = parents[at];
  }
  return at;
}

/** Corner that begins each directed edge, by the edge's two ends. */
function directedEdges(cells, same) {
  const edges = new Map();
  const points = same.length;
  for (let corner = 0; corner < cells.length; corner += 1) {
    const next = corner % 3 === 2 ? corner - 2 : corner + 1;
    edges.set(same[cells[corner]] * points + same[cells[next]], corner);
  }
  return edges;
}

/**
 * The vertices that are drawn: points, parted where they lie on a crease.
 *
 * `index` holds the vertices of all triangles, `source` the point of each vertex, `creases` pairs
 * of vertices, `open` those of edges with one triangle only: none where the surface is closed.
 */
export function topologyOf(surface) {
  const { cells } = surface;
  const same = welded(surface);
  const normals = faceNormals(surface);
  const edges = directedEdges(cells, same);
  const parents = Uint32Array.from({ length: cells.length }, (_, i) => i);
  const smooth = Math.cos((CREASE * Math.PI) / 180);
  const creases = [], open = [];
  for (let corner = 0; corner < cells.length; corner += 1) {
    const next = corner % 3 === 2 ? corner - 2 : corner + 1;
    const [a, b] = [same[cells[corner]], same[cells[next]]];
    if (a === b) continue;
    const other = edges.get(b * same.length + a);
    if (other === undefined) {
      open.push(corner, next);
      continue;
    }
    const [f, g] = [corner - (corner % 3), other - (other % 3)];
    const cosine =
      normals[f] * normals[g] + normals[f + 1] * normals[g + 1] + normals[f + 2] * normals[g + 2];
    const otherNext = other % 3 === 2 ? other - 2 : other + 1;
    if (cosine > smooth) {
      parents[root(parents, corner)] = root(parents, otherNext);
      parents[root(parents, next)] = root(parents, other);
    } else if (a < b) creases.push(corner, next);
  }
  return { ...vertices(cells, parents, creases, open), same };
}

function vertices(cells, parents, creases, open) {
  const numbers = new Int32Array(cells.length).fill(-1);
  const index = new Uint32Array(cells.length);
  const source = [];
  for (let corner = 0; corner < cells.length; corner += 1) {
    const at = root(parents, corner);
    if (numbers[at] < 0) {
      numbers[at] = source.length;
      source.push(cells[corner]);
    }
    index[corner] = numbers[at];
  }
  const ofCorners = (corners) => Uint32Array.from(corners, (corner) => index[corner]);
  return {
    index,
    source: Uint32Array.from(source),
    creases: ofCorners([...creases, ...open]),
    open: ofCorners(open),
  };
}

/** Whether the open edges of all these surfaces close each other, to `tolerance` mm. */
export function closeEachOther(openEdges, tolerance) {
  const cell = (x) => Math.floor(x / tolerance);
  const grid = new Map();
  openEdges.forEach(([x, y, z], number) => {
    const key = `${cell(x)},${cell(y)},${cell(z)}`;
    if (!grid.has(key)) grid.set(key, []);
    grid.get(key).push(number);
  });
  const hasPartner = ([x, y, z], number) => {
    for (let i = -1; i < 2; i += 1)
      for (let j = -1; j < 2; j += 1)
        for (let k = -1; k < 2; k += 1) {
          const found = grid.get(`${cell(x) + i},${cell(y) + j},${cell(z) + k}`);
          if (found && found.some((other) => other !== number)) return true;
        }
    return false;
  };
  return openEdges.every(hasPartner);
}
