// SPDX-License-Identifier: Apache-2.0
import {Vector3} from 'three/webgpu';
import {Fn, cameraPosition, dot, exp, float, max, mix, normalWorldGeometry, pow, smoothstep, uniform, vec3, vec4} from 'three/tsl';
import {displayColor} from './color';
import type {SceneData} from './scene_data';

// Clear air: half of the contrast is gone after about 150 km at sea level, and air thins by 1/e in 8 km.
const AIR_EXTINCTION_PER_METER = 1 / 220_000;
const AIR_SCALE_HEIGHT_METERS = 8_000;

/** Node values of the type system of TSL are not told apart here. */
// eslint-disable-next-line @typescript-eslint/no-explicit-any
export type Node = any;

/** The clear sky: a dome to draw behind everything, and the air between the camera and what it sees. */
export class Sky {
  readonly horizon: Vector3;
  /** Colour of the dome in the direction that is drawn. */
  readonly dome: Node;
  /** World heights are this many times the true ones. */
  readonly exaggeration = uniform(1);

  constructor(data: SceneData) {
    this.horizon = displayColor(data.sky.horizon);
    const horizon = uniform(this.horizon);
    const zenith = uniform(displayColor(data.sky.zenith));
    const sunColor = uniform(displayColor(data.sun.color));
    const sun = uniform(new Vector3(...data.sun.direction).normalize());

    this.dome = Fn(() => {
      const direction = normalWorldGeometry;
      const height = max(direction.y, 0);
      const blue = mix(zenith, horizon, exp(height.mul(-3.5)));
      const towardsSun = max(dot(direction, sun), 0);
      const glow = pow(towardsSun, 6).mul(0.1).add(pow(towardsSun, 90).mul(0.28));
      // The sun's half degree is widened to one, as film and eye do by glare.
      const disc = smoothstep(float(0.99986), float(0.99996), towardsSun);
      const lit = mix(blue, sunColor, glow);
      return vec4(mix(lit, vec3(1, 1, 1), disc), 1);
    })();
  }

  /** The colour after the air between it and the camera; `position` in world metres. */
  throughAir(color: Node, position: Node): Node {
    const way = position.sub(cameraPosition);
    const lower = max(position.y.div(this.exaggeration), 0).div(AIR_SCALE_HEIGHT_METERS);
    const upper = max(cameraPosition.y.div(this.exaggeration), 0).div(AIR_SCALE_HEIGHT_METERS);
    // Mean density along a straight line through an exponential atmosphere; at one height it is the density there.
    const rise = upper.sub(lower);
    const safeRise = rise.abs().lessThan(0.001).select(float(0.001), rise);
    const mean = exp(lower.negate()).sub(exp(lower.add(safeRise).negate())).div(safeRise);
    const depth = way.length().mul(AIR_EXTINCTION_PER_METER).mul(mean);
    return mix(uniform(this.horizon), color, exp(depth.negate()));
  }
}
