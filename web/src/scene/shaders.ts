// What is drawn of the plant: first what each pixel shows (colour, normal, mesh), then the picture made of it.

/** Flags of an instance, as the shaders read them. */
export const FLAG = { ghost: 1, hatched: 2, selected: 4, alike: 16, marked: 32 } as const;

/** Meshes of a part that are lit under the cursor. */
export const MOST_HOVERED = 8;

export const PLANT_VERTEX = /* glsl */ `
#include <common>
#include <batching_pars_vertex>
attribute vec2 oct;
uniform highp sampler2D stateTexture;
uniform int ghosts;
flat varying vec4 vState;
flat varying vec3 vMesh;
varying vec3 vNormal;
varying vec3 vWorld;

vec3 unfold(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}

void main() {
  float instance = getIndirectIndex(gl_DrawID);
  int width = textureSize(stateTexture, 0).x;
  int at = 2 * int(instance);
  vState = texelFetch(stateTexture, ivec2(at % width, at / width), 0);
  vMesh = texelFetch(stateTexture, ivec2((at + 1) % width, (at + 1) / width), 0).rgb;
  bool ghost = (int(vState.a * 255.0 + 0.5) & 1) != 0;
  if (ghost != (ghosts == 1)) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  mat4 place = getBatchingMatrix(instance);
  vec4 world = place * vec4(position, 1.0);
  mat3 turn = mat3(normalize(place[0].xyz), normalize(place[1].xyz), normalize(place[2].xyz));
  vNormal = turn * unfold(max(oct / 127.0, -1.0));
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

const CLIP = /* glsl */ `
uniform vec4 section;
uniform bool cutting;
bool isCutOff(vec3 at) { return cutting && dot(section.xyz, at) > section.w; }
`;

export const PLANT_FRAGMENT = /* glsl */ `
layout(location = 0) out vec4 outColor;
layout(location = 1) out vec4 outNormal;
layout(location = 2) out vec4 outMesh;
flat in vec4 vState;
flat in vec3 vMesh;
in vec3 vNormal;
in vec3 vWorld;
uniform vec3 toLight;
uniform vec3 lookDirection;
uniform bool parallel;
uniform vec3 accent;
uniform vec3 markColor;
${CLIP}
vec3 linear(vec3 c) { return pow(c, vec3(2.2)); }
vec3 shown(vec3 c) { return pow(clamp(c, 0.0, 1.0), vec3(1.0 / 2.2)); }

void main() {
  if (isCutOff(vWorld)) discard;
  int flags = int(vState.a * 255.0 + 0.5);
  vec3 toEye = parallel ? -lookDirection : normalize(cameraPosition - vWorld);
  vec3 n = normalize(vNormal);
  if (dot(n, toEye) < 0.0) n = -n;
  vec3 base = linear(vState.rgb);
  float stripe = step(0.5, fract((gl_FragCoord.x + gl_FragCoord.y) / 9.0));
  if ((flags & ${FLAG.hatched}) != 0) base = mix(base, base * 0.62 + 0.02, stripe);
  if ((flags & ${FLAG.marked}) != 0) base = linear(markColor);
  if ((flags & ${FLAG.alike}) != 0) base = mix(base, linear(accent), 0.5 * stripe + 0.1);
  if ((flags & ${FLAG.selected}) != 0) base = mix(base, linear(accent), 0.55);
  bool cap = cutting && !gl_FrontFacing;
  if (cap) n = section.xyz;
  float sky = 0.5 + 0.5 * n.z;
  float key = max(dot(n, toLight), 0.0);
  float rim = pow(1.0 - max(dot(n, toEye), 0.0), 3.0);
  vec3 light = mix(vec3(0.30, 0.29, 0.28), vec3(0.62, 0.65, 0.70), sky) + 0.46 * key + 0.10 * max(dot(n, toEye), 0.0);
  vec3 color = cap ? base * 0.7 : base * light + 0.03 * rim;
  outColor = vec4(shown(color), 1.0);
  vec3 seen = (viewMatrix * vec4(n, 0.0)).xyz;
  outNormal = vec4(seen.xy * 0.5 + 0.5, vState.a, 1.0);
  outMesh = vec4(vMesh, 1.0);
}`;

export const GHOST_FRAGMENT = /* glsl */ `
layout(location = 0) out vec4 outColor;
flat in vec4 vState;
flat in vec3 vMesh;
in vec3 vNormal;
in vec3 vWorld;
uniform vec3 lookDirection;
uniform bool parallel;
uniform float faint;
${CLIP}
void main() {
  if (isCutOff(vWorld)) discard;
  vec3 toEye = parallel ? -lookDirection : normalize(cameraPosition - vWorld);
  float facing = abs(dot(normalize(vNormal), toEye));
  float alpha = faint * (0.35 + 0.65 * pow(1.0 - facing, 2.0));
  outColor = vec4(mix(vState.rgb, vec3(0.55, 0.6, 0.66), 0.7) * alpha, alpha);
}`;

/** Single shapes over everything: what is selected, seen through what is before it. */
export const MASK_VERTEX = /* glsl */ `
varying vec3 vWorld;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

export const MASK_FRAGMENT = /* glsl */ `
layout(location = 0) out vec4 outColor;
in vec3 vWorld;
${CLIP}
void main() {
  if (isCutOff(vWorld)) discard;
  outColor = vec4(1.0);
}`;

export const FULL_VERTEX = /* glsl */ `
varying vec2 vUv;
void main() {
  vUv = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

export const COMPOSE_FRAGMENT = /* glsl */ `
layout(location = 0) out vec4 outColor;
in vec2 vUv;
uniform sampler2D tColor, tNormal, tMesh, tGhost, tMask;
uniform highp sampler2D tDepth;
uniform vec2 texel;
uniform vec2 used;
uniform mat4 fromClip;
uniform bool occlusion, hasGhosts, hasMask;
uniform float weight, turn, edgeStrength;
uniform vec3 skyTop, skyBottom, ink, accent;

vec3 placeAt(vec2 uv) {
  vec4 p = fromClip * vec4(uv / used * 2.0 - 1.0, texture(tDepth, uv).r * 2.0 - 1.0, 1.0);
  return p.xyz / p.w;
}
vec3 normalAt(vec2 uv) {
  vec2 xy = texture(tNormal, uv).xy * 2.0 - 1.0;
  return vec3(xy, sqrt(max(0.0, 1.0 - dot(xy, xy))));
}
int flagsAt(vec2 uv) { return int(texture(tNormal, uv).z * 255.0 + 0.5); }

// Lines where parts, creases and silhouettes end, on the nearer side.
float edgeAt(vec2 uv, vec3 p, vec3 n, vec3 mesh) {
  float found = 0.0;
  float pixel = length(placeAt(uv + vec2(texel.x, 0.0)) - p);
  for (int k = 0; k < 4; k++) {
    vec2 way = k == 0 ? vec2(1, 0) : k == 1 ? vec2(-1, 0) : k == 2 ? vec2(0, 1) : vec2(0, -1);
    vec2 at = uv + way * texel;
    vec4 other = texture(tMesh, at);
    if (other.a == 0.0) { found = max(found, 0.85); continue; }
    vec3 q = placeAt(at);
    float away = abs(dot(q - p, n));
    bool nearer = p.z >= q.z;
    float far = max(abs(p.z) * 0.004, 3.0 * length(q.xy - p.xy));
    if (nearer && away > far) found = max(found, 0.8);
    else if (other.rgb != mesh && nearer) found = max(found, 0.5);
    else if (dot(normalAt(at), n) < 0.83 && nearer) found = max(found, 0.42);
  }
  return found;
}

float occluded(vec2 uv, vec3 p, vec3 n) {
  float sum = 0.0;
  float reach = max(0.01 * abs(p.z), 0.02);
  for (int k = 0; k < 8; k++) {
    float angle = turn + float(k) * 2.399963;
    float radius = (float(k) + 0.5) / 8.0;
    vec2 at = uv + vec2(cos(angle), sin(angle)) * texel * mix(2.0, 26.0, radius);
    if (at.x < 0.0 || at.y < 0.0 || at.x > used.x || at.y > used.y || texture(tMesh, at).a == 0.0) continue;
    vec3 v = placeAt(at) - p;
    float d = length(v);
    sum += max(0.0, dot(n, v) / max(d, 1e-6) - 0.12) * smoothstep(reach * 2.0, reach * 0.3, d);
  }
  return clamp(1.0 - 0.22 * sum, 0.35, 1.0);
}

void main() {
  vec2 uv = vUv * used;
  vec4 mesh = texture(tMesh, uv);
  vec3 color = mix(skyBottom, skyTop, vUv.y);
  int flags = 0;
  if (mesh.a > 0.0) {
    flags = flagsAt(uv);
    vec3 p = placeAt(uv);
    vec3 n = normalAt(uv);
    color = texture(tColor, uv).rgb;
    if (occlusion) color *= mix(occluded(uv, p, n), 1.0, 0.25);
    color = mix(color, ink, edgeStrength * edgeAt(uv, p, n, mesh.rgb));
  }
  if (hasGhosts) {
    vec4 ghost = texture(tGhost, uv);
    color = color * (1.0 - ghost.a) + ghost.rgb;
  }
  if (hasMask) {
    float here = texture(tMask, uv).r;
    float least = here, most = here;
    for (int k = 0; k < 8; k++) {
      float angle = float(k) * 0.785398;
      float other = texture(tMask, uv + vec2(cos(angle), sin(angle)) * texel * 1.2).r;
      least = min(least, other);
      most = max(most, other);
    }
    bool seen = (flags & 4) != 0;
    if (here > 0.5 && !seen) color = mix(color, accent, 0.28);
    if (most - least > 0.5) color = mix(color, accent, seen || here < 0.5 ? 0.95 : 0.6);
    else if (here < 0.5) {
      // A dark rim, as no one colour stands out from all others.
      float around = 0.0;
      for (int k = 0; k < 8; k++) {
        float angle = float(k) * 0.785398;
        around = max(around, texture(tMask, uv + vec2(cos(angle), sin(angle)) * texel * 2.4).r);
      }
      if (around > 0.5) color = mix(color, vec3(0.06, 0.08, 0.11), 0.8);
    }
  }
  outColor = vec4(color, weight);
}`;

/** The finished picture, with the depth of the plant for what is drawn into it. */
export const SHOW_FRAGMENT = /* glsl */ `
layout(location = 0) out vec4 outColor;
in vec2 vUv;
uniform sampler2D tPicture, tMesh;
uniform highp sampler2D tDepth;
uniform vec2 used;
uniform vec3 hovered[${MOST_HOVERED}];
uniform int nHovered;
void main() {
  vec3 color = texture(tPicture, vUv * used).rgb;
  if (nHovered > 0) {
    vec4 mesh = texture(tMesh, vUv * used);
    for (int k = 0; k < ${MOST_HOVERED}; k++)
      if (k < nHovered && mesh.a > 0.0 && distance(mesh.rgb, hovered[k]) < 0.001) color = mix(color, vec3(1.0), 0.22);
  }
  outColor = vec4(color, 1.0);
  gl_FragDepth = texture(tDepth, vUv * used).r;
}`;

/** Depth in three bytes, small, to be read back. */
export const DEPTH_FRAGMENT = /* glsl */ `
layout(location = 0) out vec4 outColor;
in vec2 vUv;
uniform highp sampler2D tDepth;
uniform vec2 used;
void main() {
  float d = min(texture(tDepth, vUv * used).r, 0.9999999) * 16777215.0;
  outColor = vec4(mod(d, 256.0), mod(floor(d / 256.0), 256.0), floor(d / 65536.0), 255.0) / 255.0;
}`;
