/* Shaders: light, colours of values, the section plane. Colours are as displayed (sRGB). */

import {
  AlwaysStencilFunc,
  BackSide,
  DataTexture,
  DecrementWrapStencilOp,
  DoubleSide,
  FrontSide,
  IncrementWrapStencilOp,
  LinearFilter,
  NotEqualStencilFunc,
  ReplaceStencilOp,
  ShaderMaterial,
  Vector3,
  Vector4,
} from "three";

const CUT = `
  uniform bool cutting;
  uniform vec4 plane;
  varying vec3 place;
  void cut() { if (cutting && dot(place, plane.xyz) > plane.w) discard; }
`;

/* Centroid: at the rims of thin triangles values beyond them would be extrapolated. */
const SURFACE_VERTEX = `
  attribute float value;
  varying vec3 place;
  centroid varying vec3 direction;
  centroid varying float level;
  void main() {
    place = position;
    direction = normalMatrix * normal;
    level = value;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }
`;

const SURFACE_FRAGMENT = `
  ${CUT}
  uniform vec3 colour;
  uniform vec3 inside;
  uniform float opacity;
  uniform bool coloured;
  uniform vec2 range;
  uniform sampler2D map;
  centroid varying vec3 direction;
  centroid varying float level;
  const vec3 KEY = vec3(-0.42, 0.58, 0.70);
  vec3 ofValue() {
    if (level < -0.5) return vec3(0.62);
    float t = clamp((level - range.x) / (range.y - range.x), 0.0, 1.0);
    return texture2D(map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  }
  void main() {
    cut();
    vec3 n = normalize(direction);
    vec3 base = coloured ? ofValue() : colour;
    // Triangles so thin that rounding turned them over are seen from outside all the same.
    if (!gl_FrontFacing && n.z < 0.0) { n = -n; if (!coloured) base = inside; }
    float diffuse = max(dot(n, KEY), 0.0);
    float sky = 0.5 + 0.5 * n.y;
    float facing = max(n.z, 0.0);
    float light = coloured ? 0.66 + 0.10 * sky + 0.27 * diffuse : 0.40 + 0.17 * sky + 0.50 * diffuse;
    light += (coloured ? 0.04 : 0.08) * facing;
    float shine = pow(max(dot(reflect(-KEY, n), vec3(0.0, 0.0, 1.0)), 0.0), 28.0);
    gl_FragColor = vec4(base * light + (coloured ? 0.05 : 0.13) * shine, opacity);
  }
`;

const PLAIN_VERTEX = `
  varying vec3 place;
  void main() {
    place = (modelMatrix * vec4(position, 1.0)).xyz;
    gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
  }
`;

const LINE_FRAGMENT = `
  ${CUT}
  uniform vec3 colour;
  uniform float opacity;
  void main() { cut(); gl_FragColor = vec4(colour, opacity); }
`;

const CAP_FRAGMENT = `
  uniform vec3 colour;
  uniform vec3 hatch;
  uniform float ratio;
  void main() {
    float stripe = mod((gl_FragCoord.x + gl_FragCoord.y) / ratio, 9.0);
    gl_FragColor = vec4(mix(colour, hatch, step(stripe, 1.4)), 1.0);
  }
`;

/** `#rrggbb` as three numbers from 0 to 1. */
export function vectorOf(colour) {
  const part = (at) => parseInt(colour.slice(at, at + 2), 16) / 255;
  return new Vector3(part(1), part(3), part(5));
}

/** The section plane that all materials of a viewer share. */
export function sectionUniforms() {
  return { cutting: { value: false }, plane: { value: new Vector4(1, 0, 0, 0) } };
}

/** A texture of 256 colours. */
export function mapTexture(bytes) {
  const texture = new DataTexture(bytes, 256, 1);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export function surfaceMaterial(section, map, opacity) {
  return new ShaderMaterial({
    vertexShader: SURFACE_VERTEX,
    fragmentShader: SURFACE_FRAGMENT,
    uniforms: {
      ...section,
      map,
      colour: { value: new Vector3() },
      inside: { value: new Vector3() },
      opacity: { value: opacity },
      coloured: { value: false },
      range: { value: [0, 1] },
    },
    side: DoubleSide,
    forceSinglePass: true,
    transparent: opacity < 1,
    depthWrite: opacity === 1,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}

export function lineMaterial(section, opacity) {
  return new ShaderMaterial({
    vertexShader: PLAIN_VERTEX,
    fragmentShader: LINE_FRAGMENT,
    uniforms: { ...section, colour: { value: new Vector3() }, opacity: { value: opacity } },
    transparent: opacity < 1,
    depthWrite: opacity === 1,
  });
}

/** Counts the surfaces behind the plane: back faces up, front faces down. */
export function countingMaterials(section) {
  const counting = (side, operation) =>
    new ShaderMaterial({
      vertexShader: PLAIN_VERTEX,
      fragmentShader: `${CUT} void main() { cut(); gl_FragColor = vec4(1.0); }`,
      uniforms: { ...section },
      side,
      depthWrite: false,
      depthTest: false,
      colorWrite: false,
      stencilWrite: true,
      stencilFunc: AlwaysStencilFunc,
      stencilFail: operation,
      stencilZFail: operation,
      stencilZPass: operation,
    });
  return [counting(BackSide, IncrementWrapStencilOp), counting(FrontSide, DecrementWrapStencilOp)];
}

/** Fills the section plane where it lies within the solid. */
export function capMaterial() {
  return new ShaderMaterial({
    vertexShader: PLAIN_VERTEX,
    fragmentShader: CAP_FRAGMENT,
    uniforms: {
      colour: { value: new Vector3() },
      hatch: { value: new Vector3() },
      ratio: { value: 1 },
    },
    side: DoubleSide,
    stencilWrite: true,
    stencilRef: 0,
    stencilFunc: NotEqualStencilFunc,
    stencilFail: ReplaceStencilOp,
    stencilZFail: ReplaceStencilOp,
    stencilZPass: ReplaceStencilOp,
  });
}
