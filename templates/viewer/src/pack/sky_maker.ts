// SPDX-License-Identifier: Apache-2.0
import type {Camera} from '../camera';
import type {Vec3} from '../math';
import type {SunPlace} from './daylight';
import {groundSunlight, type Area} from './ground_shadow';
import {Lighting} from './lighting';
import {PackView} from './pack_view';
import {cloudAlong, type Picked} from './pick';
import {QuadMaker, type Shape} from './quads';
import {Selection, sortedByKey, type CloudSet, type Detail} from './selection';
import {Timeline, type Moment} from './timeline';

/** Which clouds are shown: genera by abbreviation, and levels by the height of the base. */
export interface Layers {
  hiddenGenera: string[];
  hiddenLevels: string[];
}

export interface ListOrder {
  camera: Camera;
  marginRadians: number;
  marginMeters: number;
  detail: Detail;
  shape: Shape;
}

export interface List {
  buffer: ArrayBuffer;
  /** See Quads. */
  motions: ArrayBuffer | null;
  /** What time it shows. */
  moment: Moment;
  /** Puffs, the farthest first. */
  count: number;
  fillPixels: number;
  /** Clouds that are in view, and the distance of the nearest. */
  clouds: number;
  nearestMeters: number;
  milliseconds: number;
}

export const LEVEL_NAMES = ['low', 'middle', 'high'] as const;
export type LevelName = (typeof LEVEL_NAMES)[number];

/** Low below 2 km, high from 6 km on, by the base. */
export function levelOf(baseMeters: number): LevelName {
  return baseMeters < 2000 ? 'low' : baseMeters < 6000 ? 'middle' : 'high';
}

/** The sky of a pack, off the screen: what a worker holds. */
export class SkyMaker {
  readonly pack: PackView;
  readonly lighting: Lighting;
  private readonly timeline: Timeline;
  /** Levels of detail are remembered apart for the moving view and the one at rest. */
  private readonly selections: Record<Shape, Selection>;
  private readonly quads: QuadMaker;
  private readonly set: CloudSet;

  constructor(bytes: ArrayBuffer) {
    this.pack = PackView.open(bytes);
    this.lighting = new Lighting(this.pack);
    this.timeline = new Timeline(this.pack);
    this.selections = {triangles: new Selection(this.pack), quads: new Selection(this.pack)};
    this.quads = new QuadMaker(this.pack, this.lighting);
    this.set = {
      clouds: this.timeline.clouds,
      velocities: this.timeline.velocities,
      slackMeters: this.timeline.slackMeters,
      hidden: new Uint8Array(this.pack.clouds.count),
      exaggeration: 1,
    };
  }

  setSun(sun: SunPlace): void {
    this.lighting.setSun(sun);
    this.quads.lightChanged();
  }

  setTime(seconds: number): void {
    this.timeline.setTime(seconds);
  }

  setExaggeration(factor: number): void {
    this.set.exaggeration = factor;
  }

  setLayers({hiddenGenera, hiddenLevels}: Layers): void {
    const {pack} = this;
    for (let i = 0; i < pack.clouds.count; ++i) {
      const genus = pack.archetypes[pack.clouds.archetype(i)].genus;
      const base = pack.record(i)?.baseMeters ?? pack.clouds.floats[6 * i + 1];
      this.set.hidden[i] = hiddenGenera.includes(genus) || hiddenLevels.includes(levelOf(base)) ? 1 : 0;
    }
  }

  list(order: ListOrder): List {
    const start = performance.now();
    const selection = this.selections[order.shape];
    selection.select(this.set, order.camera, order.marginRadians, order.marginMeters, order.detail);
    const sorted = sortedByKey(selection.keys, selection.count);
    return {
      ...this.quads.quadsOf(selection, sorted, this.set, order.camera, order.shape),
      moment: this.timeline.now,
      clouds: selection.cloudCount,
      nearestMeters: selection.nearestMeters,
      milliseconds: performance.now() - start,
    };
  }

  sunlight(area: Area): Uint8Array<ArrayBuffer> {
    return groundSunlight(this.pack, this.set, area, this.lighting.direction);
  }

  pick(eye: Vec3, ray: Vec3): Picked | null {
    return cloudAlong(this.pack, this.set, eye, ray);
  }
}
