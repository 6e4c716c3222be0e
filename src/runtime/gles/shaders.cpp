// SPDX-License-Identifier: Apache-2.0
#include "runtime/gles/shaders.hpp"

namespace cloudgen::runtime::gles::shader {

const char* const kCommon = R"(
uniform vec3 uEye, uRight, uUp, uForward;
uniform vec2 uLens;        // of the slopes to the right and up, in half pictures
uniform vec3 uSun;         // towards it
uniform float uGround;     // height of the flat ground
uniform vec2 uHaze;        // extinction at the eye per metre, height that it falls off with
uniform highp sampler2D uSky;

/// The clear sky in a direction.
vec3 skyAt(vec3 d) {
  vec2 flatWay = d.xz, sunWay = uSun.xz;
  float cosine = dot(flatWay, sunWay) * inversesqrt(max(dot(flatWay, flatWay) * dot(sunWay, sunWay), 1e-12));
  float u = sqrt(acos(clamp(cosine, -1.0, 1.0)) * 0.318309886), v = sqrt(max(d.y, 0.0));
  vec2 size = vec2(textureSize(uSky, 0));
  return textureLod(uSky, (vec2(u, v) * (size - 1.0) + 0.5) / size, 0.0).rgb;
}
vec3 hazeColor(vec3 d) { return skyAt(normalize(vec3(d.x, max(0.0, 0.15 * d.y), d.z))); }

/// Share of a thing's own colour that comes through the haze before it.
float clarity(float rise, float meters) {
  float x = rise * meters / uHaze.y;
  float mean = abs(x) < 1e-3 ? 1.0 : (1.0 - exp(-max(x, -80.0))) / x;
  return exp(-meters * uHaze.x * mean);
}
)";

const char* const kPuffVertex = R"(
layout(location = 0) in uvec2 aDraw;  // cloud, puff
uniform vec3 uCameraUp;
uniform float uPixel;                 // slope that a pixel spans
uniform int uLocked;
layout(std140) uniform Locks { uvec4 uLockedPuff[256]; vec4 uLockedFacing[256]; };

flat out vec3 vColor, vVeil;          // its own light as it arrives, and the haze before it
flat out vec3 vFromPlus, vFromMinus;  // shares of the six light maps
flat out vec3 vDepth;                 // optical depth, distance, deviation along the ray
flat out float vLayer;
out vec2 vPlace;
out vec3 vRay;

const float kTile = 2.2;              // deviations from the middle of a sprite to its edge

void main() {
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
  Cloud cloud = cloudAt(aDraw.x);
  vec4 lower = archetypeTexel(cloud.archetype, 0), steps = archetypeTexel(cloud.archetype, 1);
  Puff puff = puffAt(aDraw.y, lower.xyz, steps.xyz);
  mat3 turn = turnOf(cloud.yaw);
  vec3 away = cloud.position + cloud.scale * (turn * puff.center) - uEye;
  mat3 axes = turn * puff.axes;
  vec3 sigma = cloud.scale * puff.sigma;
  float far = max(length(away), 1.0);
  float widest = max(sigma.x, max(sigma.y, sigma.z));
  if (dot(away, uForward) < -kTile * widest) return;

  vec3 facing = -away / far;
  if (far < 1.1 * widest)
    for (int i = 0; i < uLocked; ++i)
      if (uLockedPuff[i].xy == aDraw) facing = uLockedFacing[i].xyz;
  vec3 right = normalize(cross(uCameraUp, facing)), up = cross(facing, right);

  // What is seen of a Gaussian is one, too: its covariance across the ray, and the square root of that.
  vec3 x = (right * axes) * sigma, y = (up * axes) * sigma;
  float a = dot(x, x), b = dot(x, y), c = dot(y, y);
  float area = sqrt(max(a * c - b * b, 1e-6));
  float least = 0.5 * uPixel * far;
  a += least * least;
  c += least * least;
  float widened = sqrt(max(a * c - b * b, 1e-6));
  mat2 root = mat2(a + widened, b, b, c + widened) / sqrt(a + c + 2.0 * widened);

  vec3 along = (facing * axes) / sigma;
  float deviation = inversesqrt(dot(along, along));
  float depth = cloud.factor * puff.depth * deviation / min(sigma.x, min(sigma.y, sigma.z)) * area / widened;
  if (depth < 0.002) return;

  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  vec2 place = root * (kTile * corner);
  vec3 at = away + right * place.x + up * place.y;
  gl_Position = vec4(dot(at, uRight) * uLens.x, dot(at, uUp) * uLens.y, 0.0, dot(at, uForward));
  vRay = at;

  vec4 dimSun = archetypeTexel(cloud.archetype, 2), dimOther = archetypeTexel(cloud.archetype, 3);
  vec4 own = colorOf(cloud, aDraw.y, uint(steps.w));
  vec3 color = own.rgb * (cloud.sunlight * dimSun.xyz + dimOther.xyz) / max(dimSun.xyz + dimOther.xyz, vec3(1e-6));
  color += own.a * cloud.sunlight * max(0.0, -dot(facing, uSun)) * archetypeTexel(cloud.archetype, 4).xyz;
  float clear = clarity(-facing.y, far);
  vColor = clear * min(color, vec3(1.0));
  vVeil = (1.0 - clear) * hazeColor(-facing);
  vDepth = vec3(depth, far, deviation);

  // The maps' axes: right, up, away from the eye.
  vec3 sun = vec3(dot(uSun, right), dot(uSun, up), -dot(uSun, facing));
  vFromPlus = max(sun, vec3(0.0)) * max(sun, vec3(0.0));
  vFromMinus = max(-sun, vec3(0.0)) * max(-sun, vec3(0.0));
  vec2 tiles = vec2(dimSun.w, dimOther.w);
  vec2 tile = vec2(float(puff.sprite % int(tiles.x)), float(puff.sprite / int(tiles.x)));
  vPlace = (tile + 0.5 + 0.49 * vec2(corner.x, -corner.y)) / tiles;
  vLayer = lower.w;
}
)";

const char* const kPuffFragment = R"(
uniform highp sampler2DArray uSpritesA, uSpritesB;
flat in vec3 vColor, vVeil, vFromPlus, vFromMinus, vDepth;
flat in float vLayer;
in vec2 vPlace;
in vec3 vRay;
layout(location = 0) out vec4 oColor;

const float kOfSun = 0.8;  // share of a lit face's colour that the sun gives

void main() {
  vec4 plus = texture(uSpritesA, vec3(vPlace, vLayer)), minus = texture(uSpritesB, vec3(vPlace, vLayer));
  float relief = 1.0 - kOfSun + 2.0 * kOfSun * (dot(plus.rgb, vFromPlus) + dot(minus.rgb, vFromMinus));
  // What lies before the ground, of a Gaussian along the ray: so that no line is seen where a sprite cuts it.
  float under = -vRay.y;
  float behind = under > 0.0 ? ((uEye.y - uGround) / under - 1.0) * vDepth.y : 1e9;
  float seen = smoothstep(-2.0, 2.0, behind / vDepth.z);
  float open = exp(-vDepth.x * plus.a * seen);
  oColor = vec4((relief * vColor + vVeil) * (1.0 - open), 1.0 - open);
}
)";

const char* const kImpostorVertex = R"(
layout(location = 0) in uvec2 aDraw;  // cloud, tile
uniform highp sampler2D uPlaces;
flat out vec3 vVeil;
flat out float vClear;
out vec2 vPlace;
void main() {
  Cloud cloud = cloudAt(aDraw.x);
  vec4 facing = texelFetch(uPlaces, ivec2(0, int(aDraw.y)), 0), offset = texelFetch(uPlaces, ivec2(1, int(aDraw.y)), 0);
  vec3 right = normalize(cross(abs(facing.y) > 0.999 ? vec3(0.0, 0.0, -1.0) : vec3(0.0, 1.0, 0.0), facing.xyz));
  vec3 up = cross(facing.xyz, right);
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  vec3 away = cloud.position + offset.xyz - uEye;
  vec3 at = away + facing.w * (corner.x * right + corner.y * up);
  gl_Position = vec4(dot(at, uRight) * uLens.x, dot(at, uUp) * uLens.y, 0.0, dot(at, uForward));
  float far = length(away);
  vec3 d = away / far;
  vClear = clarity(d.y, far);
  vVeil = (1.0 - vClear) * hazeColor(d);
  const float kAcross = 16.0, kPixels = 64.0;
  vec2 tile = vec2(float(aDraw.y & 15u), float(aDraw.y >> 4));
  vPlace = (tile + 0.5 + corner * (0.5 - 0.5 / kPixels)) / kAcross;
}
)";

const char* const kImpostorFragment = R"(
uniform sampler2D uAtlas;
flat in vec3 vVeil;
flat in float vClear;
in vec2 vPlace;
layout(location = 0) out vec4 oColor;
void main() {
  vec4 picture = texture(uAtlas, vPlace);
  oColor = vec4(picture.rgb * vClear + vVeil * picture.a, picture.a);
}
)";

const char* const kVolumeVertex = R"(
layout(location = 0) in uvec2 aDraw;  // cloud, grid
uniform highp sampler2D uBoxes;
flat out vec4 vLower;                 // of the box, and the greatest extinction
flat out vec3 vUpper, vEye;           // the eye in the box's axes, at its scale
flat out mat3 vTurnBack;
flat out vec3 vDimming;
flat out vec2 vScale;                 // metres of a unit, on the extinction
flat out vec2 vGrid;
out vec3 vRay;
void main() {
  Cloud cloud = cloudAt(aDraw.x);
  vLower = texelFetch(uBoxes, ivec2(0, int(aDraw.y)), 0);
  vUpper = texelFetch(uBoxes, ivec2(1, int(aDraw.y)), 0).xyz;
  mat3 turn = turnOf(cloud.yaw);
  vTurnBack = transpose(turn);
  vEye = vTurnBack * (uEye - cloud.position) / cloud.scale;
  vScale = vec2(cloud.scale, cloud.factor);
  vGrid = vec2(float(aDraw.y % 6u), float(aDraw.y / 6u));
  vec4 dimSun = archetypeTexel(cloud.archetype, 2), dimOther = archetypeTexel(cloud.archetype, 3);
  vDimming = (cloud.sunlight * dimSun.xyz + dimOther.xyz) / max(dimSun.xyz + dimOther.xyz, vec3(1e-6));

  // A square before the eye that hides the sphere about the box; all of the picture from near by.
  vec3 middle = cloud.position + cloud.scale * (turn * (0.5 * (vLower.xyz + vUpper))) - uEye;
  float radius = 0.5 * cloud.scale * length(vUpper - vLower.xyz), far = length(middle);
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  if (far < 1.3 * radius) {
    gl_Position = vec4(corner, 0.0, 1.0);
    vRay = uForward + corner.x / uLens.x * uRight + corner.y / uLens.y * uUp;
  } else {
    vec3 facing = middle / far;
    vec3 right = normalize(cross(facing, abs(facing.y) > 0.99 ? uRight : vec3(0.0, 1.0, 0.0))), up = cross(right, facing);
    float half_ = radius * far * inversesqrt(far * far - radius * radius);
    vRay = middle + half_ * (corner.x * right + corner.y * up);
    gl_Position = vec4(dot(vRay, uRight) * uLens.x, dot(vRay, uUp) * uLens.y, 0.0, dot(vRay, uForward));
  }
}
)";

const char* const kVolumeFragment = R"(
uniform highp sampler3D uCells;
flat in vec4 vLower;
flat in vec3 vUpper, vEye;
flat in mat3 vTurnBack;
flat in vec3 vDimming;
flat in vec2 vScale, vGrid;
in vec3 vRay;
layout(location = 0) out vec4 oColor;

const float kCells = 40.0, kAcross = 6.0;

void main() {
  vec3 d = normalize(vRay), way = vTurnBack * d;
  // Where the ray goes through the box.
  vec3 inverse = 1.0 / (abs(way) + 1e-9) * mix(vec3(-1.0), vec3(1.0), greaterThanEqual(way, vec3(0.0)));
  vec3 a = (vLower.xyz - vEye) * inverse, b = (vUpper - vEye) * inverse;
  vec3 low = min(a, b), high = max(a, b);
  float from = max(max(low.x, low.y), max(low.z, 0.0)), to = min(min(high.x, high.y), high.z);
  // The ground hides what is behind it.
  if (d.y < 0.0) to = min(to, (uEye.y - uGround) / -d.y / vScale.x);
  if (to <= from) discard;
  vec3 size = vUpper - vLower.xyz;
  float cell = min(size.x, min(size.y, size.z)) / kCells;
  float jitter = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec3 light = vec3(0.0);
  float open = 1.0, seenAt = 0.0;
  float at = from + cell * jitter * 0.5;
  for (int i = 0; i < 160; ++i) {
    if (at >= to || open < 0.01) break;
    float stepLong = max(0.7 * cell, 0.0008 * at);
    vec3 place = (vEye + way * at - vLower.xyz) / size;
    vec4 texel = texture(uCells, vec3((vGrid + place.xy) / kAcross, place.z));
    if (texel.a < 0.004) {
      at += 1.8 * stepLong;
      continue;
    }
    float seen = open * (1.0 - exp(-texel.a * texel.a * vLower.w * vScale.y * stepLong));
    light += seen * texel.rgb;
    seenAt += seen * at;
    open -= seen;
    at += stepLong;
  }
  float share = 1.0 - open;
  if (share < 0.003) discard;
  // What is left unseen is as bright as the rest.
  if (open < 0.01) {
    light /= share;
    seenAt /= share;
    share = 1.0;
  } else {
    seenAt /= share;
  }
  float clear = clarity(d.y, seenAt * vScale.x);
  oColor = vec4(light * vDimming * clear + hazeColor(d) * ((1.0 - clear) * share), share);
}
)";

const char* const kPictureVertex = R"(
out vec2 vSlope;
void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 4.0 - 1.0;
  gl_Position = vec4(corner, 0.0, 1.0);
  vSlope = corner / uLens;
}
)";

const char* const kBackdropFragment = R"(
uniform sampler2D uShadow, uPatches;
uniform vec3 uGroundColor, uDimSun, uDimOther;
uniform vec4 uShadowBox;        // its lower corner and 1 / size, x and z
in vec2 vSlope;
layout(location = 0) out vec4 oColor;

vec3 groundAt(vec3 d, float meters) {
  vec2 at = uEye.xz + d.xz * meters;
  float coarse = texture(uPatches, at / 90000.0).r * 2.0 - 1.0;
  float seen = 1.0 / (1.0 + meters * meters / 2.25e10);
  vec3 ground = uGroundColor * (1.0 + 0.45 * seen * coarse);
  vec2 place = (at - uShadowBox.xy) * uShadowBox.zw;
  vec2 edge = abs(place - 0.5);
  float depth = max(edge.x, edge.y) < 0.5 ? texture(uShadow, place).r : 0.0;
  // As clouds of water scatter forwards, and around them.
  float sun = 0.12 + 0.88 * exp(-0.28 * 8.0 * depth / max(0.14, uSun.y));
  return 1.1 * ground * (sun * uDimSun + uDimOther) / max(uDimSun + uDimOther, vec3(1e-6));
}

void main() {
  vec3 d = normalize(uForward + vSlope.x * uRight + vSlope.y * uUp);
  vec3 color;
  if (d.y > -1e-4) {
    color = skyAt(d);
  } else {
    float meters = (uEye.y - uGround) / -d.y;
    color = mix(hazeColor(d), groundAt(d, meters), clarity(d.y, meters));
  }
  oColor = vec4(color, 1.0);
}
)";

const char* const kPictureFragment = R"(
uniform sampler2D uCloudLight, uBackdrop;
uniform vec4 uCloudPart, uBackdropPart;  // share of the textures that this frame drew into, half a texel of that
#ifdef SUN_IN_VIEW
uniform vec3 uSunlight;
#endif
in vec2 vSlope;
layout(location = 0) out vec4 oColor;

vec3 rolledOff(vec3 v) {
  vec3 over = max((v - 0.75) * 4.0, vec3(0.0));
  return min(v, vec3(0.75)) + 0.25 * over / (1.0 + over);
}

/// As far as the middles of the outermost texels that were drawn.
vec2 within(vec2 place, vec4 part) { return clamp(place, part.zw, 1.0 - part.zw) * part.xy; }

void main() {
  vec2 place = vSlope * uLens * 0.5 + 0.5;
  vec4 clouds = texture(uCloudLight, within(place, uCloudPart));
  float open = 1.0 - clouds.a;
  vec3 color = texture(uBackdrop, within(place, uBackdropPart)).rgb * open + clouds.rgb;
#ifdef SUN_IN_VIEW
  vec3 d = normalize(uForward + vSlope.x * uRight + vSlope.y * uUp);
  float degrees = 57.29578 * acos(clamp(dot(d, uSun), -1.0, 1.0));
  float glare = 46000.0 * smoothstep(0.295, 0.235, degrees) + 1.1 * exp(-degrees / 0.9) + 0.18 * exp(-degrees * 0.25);
  color += uSunlight * (open * glare * smoothstep(-0.002, 0.002, d.y));
#endif
  float most = max(max(color.r, color.g), max(color.b, 1e-6));
  color = mix(rolledOff(color), color * (rolledOff(vec3(most)).r / most), 0.6);
  // The sRGB curve by three roots, to half a step of 255.
  vec3 root = sqrt(clamp(color, 0.0, 1.0)), fourth = sqrt(root), eighth = sqrt(fourth);
  oColor = vec4(max(vec3(0.0), 0.585122381 * root + 0.783140355 * fourth - 0.368262736 * eighth), 1.0);
}
)";

const char* const kShadowVertex = R"(
layout(location = 0) in uvec2 aDraw;
uniform vec4 uShadowBox;
uniform float uCell;  // metres that a texel spans
flat out float vOpacity;
out vec2 vFrom;
void main() {
  Cloud cloud = cloudAt(aDraw.x);
  vec4 lower = archetypeTexel(cloud.archetype, 0), steps = archetypeTexel(cloud.archetype, 1);
  Puff puff = puffAt(aDraw.y, lower.xyz, steps.xyz);
  mat3 turn = turnOf(cloud.yaw);
  vec3 at = cloud.position + cloud.scale * (turn * puff.center);
  vec2 sun = uSun.xz / max(uSun.y, 0.14);
  vec2 foot = at.xz - sun * (at.y - uGround);
  mat3 axes = turn * puff.axes;
  vec3 sigma = cloud.scale * puff.sigma;
  vec3 x = vec3(axes[0].x, axes[1].x, axes[2].x) * sigma, z = vec3(axes[0].z, axes[1].z, axes[2].z) * sigma;
  vec2 own = vec2(length(x), length(z)), grown = max(own, vec2(0.6 * uCell));
  vOpacity = cloud.factor * puff.depth * (own.x * own.y) / (grown.x * grown.y);
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  vFrom = 3.0 * corner;
  gl_Position = vec4(((foot + 3.0 * corner * grown - uShadowBox.xy) * uShadowBox.zw) * 2.0 - 1.0, 0.0, 1.0);
}
)";

const char* const kShadowFragment = R"(
flat in float vOpacity;
in vec2 vFrom;
layout(location = 0) out vec4 oDepth;
void main() { oDepth = vec4(vOpacity * exp(-0.5 * dot(vFrom, vFrom)) / 8.0); }
)";

}  // namespace cloudgen::runtime::gles::shader
