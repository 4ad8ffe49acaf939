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

/** Lower triangles have no certain normal, as their corners are rounded; steps of the coordinates. */
const LOWEST = 24;

/** Unit normals of all triangles in the first frame, and for each the corner that begins its longest
    edge if it is too thin for a normal, else −1. */
function faceNormals(surface) {
  const { cells, levels, low, high, steps } = surface;
  const [sx, sy, sz] = [0, 1, 2].map((axis) => (high[axis] - low[axis]) / steps);
  const lowest = LOWEST * Math.max(sx, sy, sz);
  const normals = new Float32Array(cells.length);
  const thin = new Int32Array(cells.length / 3).fill(-1);
  for (let t = 0; t < cells.length; t += 3) {
    const a = 3 * cells[t], b = 3 * cells[t + 1], c = 3 * cells[t + 2];
    const ux = (levels[b] - levels[a]) * sx, vx = (levels[c] - levels[a]) * sx;
    const uy = (levels[b + 1] - levels[a + 1]) * sy, vy = (levels[c + 1] - levels[a + 1]) * sy;
    const uz = (levels[b + 2] - levels[a + 2]) * sz, vz = (levels[c + 2] - levels[a + 2]) * sz;
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const double = Math.hypot(x, y, z);
    normals[t] = x / (double || 1);
    normals[t + 1] = y / (double || 1);
    normals[t + 2] = z / (double || 1);
    const first = Math.hypot(ux, uy, uz), last = Math.hypot(vx, vy, vz);
    const second = Math.hypot(vx - ux, vy - uy, vz - uz);
    const longest = Math.max(first, second, last);
    if (double < lowest * longest) thin[t / 3] = t + (longest === first ? 0 : longest === second ? 1 : 2);
  }
  return { normals, thin };
}

/** Give thin triangles the normal of the one across their longest edge, as far as that has one. */
function borrowNormals({ normals, thin }, cells, same, edges) {
  let left = thin.filter((corner) => corner >= 0);
  for (let before = Infinity; left.length && left.length < before; ) {
    before = left.length;
    left = left.filter((corner) => {
      const next = corner % 3 === 2 ? corner - 2 : corner + 1;
      const other = edges.get(same[cells[next]] * same.length + same[cells[corner]]);
      if (other === undefined || thin[Math.floor(other / 3)] >= 0) return true;
      const [mine, theirs] = [corner - (corner % 3), other - (other % 3)];
      normals.copyWithin(mine, theirs, theirs + 3);
      thin[mine / 3] = -1;
      return false;
    });
  }
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
 * of vertices at sharp edges, `open` pairs at edges with one triangle only.
 */
export function topologyOf(surface) {
  const { cells } = surface;
  const same = welded(surface);
  const edges = directedEdges(cells, same);
  const faces = faceNormals(surface);
  const { normals, thin } = faces;
  borrowNormals(faces, cells, same, edges);
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
    if (cosine > smooth || thin[f / 3] >= 0 || thin[g / 3] >= 0) {
      parents[root(parents, corner)] = root(parents, otherNext);
      parents[root(parents, next)] = root(parents, other);
    } else if (a < b) creases.push(corner, next);
  }
  return vertices(cells, parents, creases, open);
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
    creases: ofCorners(creases),
    open: ofCorners(open),
  };
}

/** How far from closed surfaces may be, of the area and volume of their box. */
const NEARLY = 3e-4;

/**
 * Whether surfaces with these open edges enclose a volume, together and nearly.
 *
 * `edges` holds six coordinates of each edge, from its start to its end. Along rims that lie on each
 * other, though divided otherwise, the integrals of r × dl and of its products with x, y and z
 * cancel; they do not along the rims of a hole, nor along those at both ends of a pipe.
 */
export function enclose(edges, size) {
  const sums = new Float64Array(12);
  const centre = meanOf(edges);
  for (let i = 0; i < edges.length; i += 6) {
    const along = [0, 1, 2].map((axis) => edges[i + 3 + axis] - edges[i + axis]);
    const at = [0, 1, 2].map((axis) => (edges[i + 3 + axis] + edges[i + axis]) / 2 - centre[axis]);
    for (let axis = 0; axis < 3; axis += 1) {
      const [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
      const turned = at[next] * along[last] - at[last] * along[next];
      sums[axis] += turned / size ** 2;
      for (let other = 0; other < 3; other += 1) sums[3 + 3 * other + axis] += (turned * at[other]) / size ** 3;
    }
  }
  return sums.every((sum) => Math.abs(sum) < NEARLY);
}

function meanOf(edges) {
  const mean = [0, 0, 0];
  edges.forEach((x, i) => (mean[i % 3] += x / (edges.length / 3)));
  return mean;
}
