// Shaders of the network in 3D. All sizes are pixels of the screen, whatever the distance; a point is moved towards the eye
// by its pipe's radius, in depth only, so that a line in the middle of a pipe is seen on it, but not through what stands
// before it.

export const COMMON = /* glsl */ `
uniform vec2 uViewport;
uniform float uScale;
uniform vec4 uPlane;
varying float vCut;
bool perspective() { return projectionMatrix[2][3] != 0.0; }
float depthOf(vec4 seen, float pull) {
  vec4 near = seen;
  if (perspective()) near.xyz += normalize(-seen.xyz) * min(pull, 0.4 * length(seen.xyz));
  else near.z += pull;
  vec4 clip = projectionMatrix * near;
  return clip.z / clip.w;
}
vec2 screenOf(vec4 clip) { return 0.5 * uViewport * clip.xy / clip.w; }
float pixelsPerMetre(vec4 seen) {
  float scale = 0.5 * uViewport.y * projectionMatrix[1][1];
  return perspective() ? scale / max(-seen.z, 1e-3) : scale;
}
`;

export const RIBBON_VERTEX = /* glsl */ `
attribute vec3 aFrom;
attribute vec3 aTo;
attribute vec3 aAlong;
attribute vec4 aColor;
attribute vec3 aLook;
uniform float uCasing;
uniform float uFaint;
varying vec2 vAt;
varying vec3 vSize;
varying vec4 vColor;
varying vec2 vDash;
${COMMON}
void main() {
  vec4 a = modelViewMatrix * vec4(aFrom, 1.0);
  vec4 b = modelViewMatrix * vec4(aTo, 1.0);
  vec2 along = aAlong.xy;
  if (perspective()) {
    // What is behind the eye is cut off at the near plane.
    float edge = projectionMatrix[3][2] / (projectionMatrix[2][2] - 1.0) * -1.001;
    if (a.z > edge && b.z > edge) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
    float t = clamp((edge - a.z) / (b.z - a.z), 0.0, 1.0);
    if (a.z > edge) { a = mix(a, b, t); along.x = mix(along.x, along.y, t); }
    else if (b.z > edge) { b = mix(a, b, t); along.y = mix(along.x, along.y, t); }
  }
  vec4 ca = projectionMatrix * a;
  vec4 cb = projectionMatrix * b;
  vec2 sa = screenOf(ca);
  vec2 sb = screenOf(cb);
  vec2 way = sb - sa;
  float length_ = length(way);
  vec2 dir = length_ > 1e-3 ? way / length_ : vec2(1.0, 0.0);
  // From afar lines are thinner, so that the plant is still seen; what is marked or selected isn't.
  float metre = 0.5 * (pixelsPerMetre(a) + pixelsPerMetre(b));
  float bore = max(aAlong.z - 0.06, 0.03) / 0.75;
  float thin = aLook.z > 1.5 ? 1.0 : clamp(0.35 + bore * metre / (6.0 * uScale), 0.5, 1.0);
  float core = 0.5 * aLook.x * thin * uScale;
  float casing = uCasing * thin * uScale;
  float reach = core + casing + 1.0;
  float cap = uFaint > 0.0 ? 0.0 : reach;
  float side = position.y;
  float end = position.x;
  vec2 at = mix(sa, sb, end) + dir * (2.0 * end - 1.0) * cap + vec2(-dir.y, dir.x) * side * reach;
  vAt = vec2(mix(-cap, length_ + cap, end), side * reach);
  vSize = vec3(core, casing, length_);
  vColor = aColor;
  // Dashes keep their place on the pipe; their length doubles or halves with the distance so that they stay readable.
  float period = exp2(floor(log2(20.0 * uScale / metre) + 0.5));
  float perPixel = length_ > 1e-3 ? (along.y - along.x) / length_ : 0.0;
  float from = along.x - cap * perPixel;
  float to = along.y + cap * perPixel;
  vDash = vec2(mix(from, to, end) / period, aLook.y);
  float depth = depthOf(mix(a, b, end), aAlong.z);
  vCut = dot(uPlane, mix(a, b, end));
  gl_Position = vec4(at / (0.5 * uViewport), depth, 1.0);
  if (aColor.a <= 0.0 || (uFaint > 0.0 && aLook.z < 0.0)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  vSize.y *= aLook.z < 0.0 ? 0.0 : 1.0;
}
`;

export const RIBBON_FRAGMENT = /* glsl */ `
uniform vec3 uCasingColor;
uniform float uFaint;
uniform float uTime;
varying vec2 vAt;
varying vec3 vSize;
varying vec4 vColor;
varying vec2 vDash;
varying float vCut;
void main() {
  if (vCut > 0.0) discard;
  float off = length(vec2(vAt.x - clamp(vAt.x, 0.0, vSize.z), vAt.y));
  float core = vSize.x;
  float casing = vSize.y;
  float inCore = 1.0 - smoothstep(core - 0.5, core + 0.5, off);
  float inAll = 1.0 - smoothstep(core + casing - 0.5, core + casing + 0.5, off);
  if (vDash.y > 0.5 && vDash.y < 1.5) {
    float gap = abs(fract(vDash.x) - 0.5) * 2.0;
    inCore *= 1.0 - smoothstep(0.56, 0.62, gap);
  }
  vec3 color = vColor.rgb;
  if (uTime >= 0.0 && vDash.y > 1.5) {
    float wave = fract(vDash.x * 0.5 - uTime);
    color = mix(color, uCasingColor, 0.55 * smoothstep(0.75, 0.9, wave) * (1.0 - smoothstep(0.9, 1.0, wave)));
  }
  float alpha = uFaint > 0.0 ? inCore * uFaint * vColor.a : inAll * vColor.a;
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(uFaint > 0.0 ? color : mix(uCasingColor, color, inCore), alpha);
  #include <colorspace_fragment>
}
`;

export const ARROW_VERTEX = /* glsl */ `
attribute vec3 aAt;
attribute vec3 aDirection;
attribute vec3 aRoom;
attribute vec3 aColor;
varying vec3 vColor;
varying vec3 vEdge;
varying float vHeight;
${COMMON}
void main() {
  vec4 seen = modelViewMatrix * vec4(aAt, 1.0);
  vec3 toward = (modelViewMatrix * vec4(aDirection, 0.0)).xyz;
  vec4 clip = projectionMatrix * seen;
  float metre = pixelsPerMetre(seen);
  // How long a metre of the pipe appears: seen from its end an arrow says nothing.
  vec4 beside = projectionMatrix * vec4(seen.xyz + toward * (10.0 / metre), 1.0);
  vec2 way = screenOf(beside) - screenOf(clip);
  float share = min(1.0, length(way) / 10.0);
  float room = aRoom.x * metre * share;
  float fit = aRoom.z * smoothstep(30.0 * uScale, 44.0 * uScale, room) * smoothstep(0.2, 0.35, share);
  vec2 dir = length(way) > 1e-4 ? normalize(way) : vec2(1.0, 0.0);
  float size = (5.5 + 1.2 * aRoom.z) * uScale * fit;
  vec2 at = screenOf(clip) + size * (dir * position.x + vec2(-dir.y, dir.x) * position.y);
  vEdge = vec3(float(gl_VertexID == 0), float(gl_VertexID == 1), float(gl_VertexID == 2));
  vHeight = 2.6 * size;
  vCut = dot(uPlane, seen);
  vColor = aColor;
  bool behind = perspective() && seen.z > -1e-3;
  gl_Position = fit <= 0.01 || behind
    ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(at / (0.5 * uViewport), depthOf(seen, aRoom.y), 1.0);
}
`;

export const ARROW_FRAGMENT = /* glsl */ `
uniform vec3 uCasingColor;
uniform float uScale;
uniform float uFaint;
varying vec3 vColor;
varying vec3 vEdge;
varying float vHeight;
varying float vCut;
void main() {
  if (vCut > 0.0) discard;
  float edge = min(vEdge.x, min(vEdge.y, vEdge.z)) * vHeight;
  float rim = 1.3 * uScale;
  float core = smoothstep(rim - 0.5, rim + 0.5, edge);
  float alpha = uFaint > 0.0 ? uFaint * core : smoothstep(0.0, 1.0, edge);
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(mix(uCasingColor, vColor, core), alpha);
  #include <colorspace_fragment>
}
`;

export const DOT_VERTEX = /* glsl */ `
attribute vec3 aColor;
attribute vec3 aDot;
varying vec3 vColor;
varying float vForm;
varying float vSide;
${COMMON}
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vec4 clip = projectionMatrix * seen;
  float metre = pixelsPerMetre(seen);
  // Small things of the network (ports) come when there is room for them.
  float fit = aDot.y < 6.0 ? smoothstep(110.0 * uScale, 180.0 * uScale, metre) : 1.0;
  if (aDot.y > 6.0 && aDot.y < 14.0) fit = clamp(0.45 + metre / (90.0 * uScale), 0.55, 1.0);
  vColor = aColor;
  vForm = aDot.x;
  vSide = (aDot.y + 3.0) * uScale * fit;
  vCut = dot(uPlane, seen);
  gl_PointSize = vSide;
  bool behind = perspective() && seen.z > -1e-3;
  gl_Position = fit <= 0.01 || aDot.y <= 0.0 || behind
    ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(clip.xy / clip.w, depthOf(seen, aDot.z), 1.0);
}
`;

// Forms: 0 a dot (junction), 1 a ring (open end), 2 a bar in a square (closed end), 3 a small square (port).
export const DOT_FRAGMENT = /* glsl */ `
uniform vec3 uCasingColor;
uniform float uScale;
uniform float uFaint;
varying vec3 vColor;
varying float vForm;
varying float vSide;
varying float vCut;
void main() {
  if (vCut > 0.0) discard;
  vec2 p = (gl_PointCoord - 0.5) * vSide;
  float radius = 0.5 * vSide - 1.5 * uScale;
  float round_ = length(p) - radius;
  float square = max(abs(p.x), abs(p.y)) - 0.86 * radius;
  float shape = vForm < 1.5 ? round_ : square;
  float inside = 1.0 - smoothstep(-0.5, 0.5, shape);
  float all = 1.0 - smoothstep(-0.5, 0.5, shape - 1.2 * uScale);
  if (vForm > 0.5 && vForm < 1.5) inside *= smoothstep(-0.5, 0.5, length(p) - radius + 2.4 * uScale);
  if (vForm > 1.5 && vForm < 2.5) inside *= smoothstep(-0.5, 0.5, abs(abs(p.x) - 0.43 * radius) - 0.6 * uScale);
  float alpha = uFaint > 0.0 ? inside * uFaint : all;
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(mix(uCasingColor, vColor, inside), alpha);
  #include <colorspace_fragment>
}
`;
