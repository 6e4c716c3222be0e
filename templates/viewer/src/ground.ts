// SPDX-License-Identifier: Apache-2.0
import {
  BufferAttribute,
  BufferGeometry,
  CircleGeometry,
  DataTexture,
  DoubleSide,
  Group,
  LineBasicNodeMaterial,
  LineSegments,
  Mesh,
  MeshBasicNodeMaterial,
  Vector2,
} from 'three/webgpu';
import {Fn, attribute, cameraPosition, float, mix, positionWorld, smoothstep, texture, uniform, vec2, vec3, vec4} from 'three/tsl';
import {displayColor} from './color';
import type {Frame} from './frame';
import type {SceneData} from './scene_data';
import type {Node, Sky} from './sky';
import {Terrain} from './terrain';

const STEPS_DEGREES = [0.05, 0.1, 0.2, 0.25, 0.5, 1, 2, 2.5, 5, 10, 15, 30];
const WANTED_LINES = 7;
const MINOR_LINES = 5;
const SEGMENTS = 96;

export interface GroundLabel {
  text: string;
  x: number;
  z: number;
  kind: 'parallel' | 'meridian';
}

/** The ground: a plane out to the horizon, the scene's box on it with cloud shadows, meridians and parallels. */
export class Ground {
  readonly root = new Group();
  readonly labels: GroundLabel[] = [];
  readonly stepDegrees: number;
  readonly terrain: Terrain;

  constructor(data: SceneData, frame: Frame, sky: Sky, sunlight: DataTexture) {
    const span = Math.max(frame.longitudeSpan * Math.cos((frame.box.south + frame.box.north) * (Math.PI / 360)), frame.box.north - frame.box.south);
    this.stepDegrees = STEPS_DEGREES.find((step) => span / step <= WANTED_LINES) ?? 45;
    this.root.position.y = data.groundHeightMeters;
    this.terrain = new Terrain(data);
    const ring = borderOf(frame);
    this.root.add(
      this.plane(frame, data, sky),
      this.floor(ring, frame, data, sky, sunlight),
      ...this.graticule(frame, sky),
      lines(this.onTerrain(pairs(ring)), sky, 0.85),
    );
    // Painted from back to front without a depth buffer: sky, plane, floor, lines, then the clouds above them.
    this.root.children.forEach((child, index) => {
      child.renderOrder = index;
      child.frustumCulled = false;
    });
  }

  private plane(frame: Frame, data: SceneData, sky: Sky): Mesh {
    const geometry = new CircleGeometry(frame.size * 20 + 400_000, 96).rotateX(-Math.PI / 2).translate(frame.centerX, 0, frame.centerZ);
    const ground = uniform(displayColor(data.sky.ground));
    const center = uniform(new Vector2(frame.centerX, frame.centerZ));
    return painted(
      geometry,
      Fn(() => {
        const place: Node = positionWorld.xz;
        const away: Node = place.sub(center).length();
        const far = smoothstep(float(frame.size * 2), float(frame.size * 12 + 200_000), away);
        return vec4(mix(sky.throughAir(ground.mul(0.88), positionWorld), vec3(uniform(sky.horizon)), far), 1);
      })(),
    );
  }

  /** The ground of the scene's box, under the shadows of the clouds. */
  private floor(ring: number[], frame: Frame, data: SceneData, sky: Sky, sunlight: DataTexture): Mesh {
    const geometry = this.terrain.exists ? this.terrain.geometry() : fan(ring, frame);
    const ground: Node = this.terrain.exists ? attribute('relief', 'vec3') : uniform(displayColor(data.sky.ground));
    const lower = uniform(new Vector2(...data.frame.lower));
    const extent = uniform(new Vector2(frame.width, frame.depth));
    // A low sun casts long shadows that fade into the light of the sky.
    const sunShare = 0.5 * Math.min(1, Math.max(0, data.sun.direction[1] / 0.25));
    const floor = painted(
      geometry,
      Fn(() => {
        const across: Node = positionWorld.xz.sub(lower).div(extent);
        const lit = texture(sunlight, vec2(across.x, across.y)).r;
        // What is left in a shadow is light of the blue sky.
        const shaded = mix(vec3(1 - sunShare, 1 - 0.96 * sunShare, 1 - 0.84 * sunShare), vec3(1, 1, 1), lit);
        return vec4(sky.throughAir(ground.mul(shaded), positionWorld), 1);
      })(),
    );
    // Mountains hide what is behind them; the flat ground hides nothing.
    (floor.material as MeshBasicNodeMaterial).depthTest = (floor.material as MeshBasicNodeMaterial).depthWrite = this.terrain.exists;
    return floor;
  }

  /** Points of lines (x, y, z each) laid on the terrain. */
  private onTerrain(points: number[]): number[] {
    return points.map((value, i) => (i % 3 === 1 ? this.terrain.rise(points[i - 1], points[i + 1]) : value));
  }

  private graticule(frame: Frame, sky: Sky): LineSegments[] {
    const {box} = frame;
    const step = this.stepDegrees;
    const points: number[] = [];
    const minor: number[] = [];
    const decimals = step < 0.1 || step === 0.25 ? 2 : step < 1 || step === 2.5 ? 1 : 0;
    const east = box.west + frame.longitudeSpan;
    const line = (from: [number, number], to: [number, number], points: number[]) => {
      for (let i = 0; i < SEGMENTS; ++i)
        for (const t of [i / SEGMENTS, (i + 1) / SEGMENTS]) {
          const [x, z] = frame.toScene(from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t);
          points.push(x, 0, z);
        }
    };
    const degrees = (value: number, positive: string, negative: string) =>
      `${Math.abs(value).toFixed(decimals)}°${Math.abs(value) < 1e-9 ? '' : value < 0 ? negative : positive}`;
    const fine = step / MINOR_LINES;
    for (let k = Math.ceil(box.south / fine); k * fine <= box.north; ++k)
      if (k % MINOR_LINES) line([box.west, k * fine], [east, k * fine], minor);
    for (let k = Math.ceil(box.west / fine); k * fine <= east; ++k)
      if (k % MINOR_LINES) line([k * fine, box.south], [k * fine, box.north], minor);
    for (let k = Math.ceil(box.south / step); k * step <= box.north + 1e-9; ++k) {
      line([box.west, k * step], [east, k * step], points);
      const [x, z] = frame.toScene(box.west, k * step);
      this.labels.push({text: degrees(k * step, 'N', 'S'), x, z, kind: 'parallel'});
    }
    for (let k = Math.ceil(box.west / step); k * step <= east + 1e-9; ++k) {
      line([k * step, box.south], [k * step, box.north], points);
      const [x, z] = frame.toScene(k * step, box.south);
      const wrapped = ((((k * step + 180) % 360) + 360) % 360) - 180;
      this.labels.push({text: degrees(wrapped, 'E', 'W'), x, z, kind: 'meridian'});
    }
    return [lines(this.onTerrain(minor), sky, 0.13), lines(this.onTerrain(points), sky, 0.42)];
  }
}

/** The flat floor: triangles from the middle to the border. */
function fan(ring: number[], frame: Frame): BufferGeometry {
  const count = ring.length / 3;
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([frame.centerX, 0, frame.centerZ, ...ring]), 3));
  geometry.setIndex(Array.from({length: count}, (_, i) => [0, 1 + i, 1 + ((i + 1) % count)]).flat());
  return geometry;
}

/** The border of the box, closed, as x, y, z of its points. */
function borderOf(frame: Frame): number[] {
  const {box} = frame;
  const east = box.west + frame.longitudeSpan;
  const corners: [number, number][] = [[box.west, box.south], [east, box.south], [east, box.north], [box.west, box.north]];
  const ring: number[] = [];
  corners.forEach((from, side) => {
    const to = corners[(side + 1) % 4];
    for (let i = 0; i < SEGMENTS; ++i) {
      const t = i / SEGMENTS;
      const [x, z] = frame.toScene(from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t);
      ring.push(x, 0, z);
    }
  });
  return ring;
}

/** The points of a closed line as pairs. */
function pairs(ring: number[]): number[] {
  const count = ring.length / 3;
  return Array.from({length: count}, (_, i) => [...ring.slice(3 * i, 3 * i + 3), ...ring.slice(3 * ((i + 1) % count), 3 * ((i + 1) % count) + 3)]).flat();
}

function painted(geometry: BufferGeometry, color: Node): Mesh {
  const material = new MeshBasicNodeMaterial({depthTest: false, depthWrite: false, side: DoubleSide});
  material.colorNode = color;
  return new Mesh(geometry, material);
}

function lines(points: number[], sky: Sky, opacity: number): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  const material = new LineBasicNodeMaterial({transparent: true, depthTest: false, depthWrite: false});
  // Seen at a grazing angle many lines fall on one pixel: they fade before that.
  const way: Node = positionWorld.sub(cameraPosition);
  const grazing = smoothstep(float(0.002), float(0.03), way.y.abs().div(way.length()));
  material.colorNode = vec4(sky.throughAir(vec3(0.97, 0.98, 1), positionWorld), grazing.mul(opacity));
  return new LineSegments(geometry, material);
}
