// SPDX-License-Identifier: Apache-2.0
// The light of a pack under a sun that moves, as src/runtime/lighting.cpp has it.
import {displayValue} from '../color';
import {along, clamp, dot, scale, turnedAboutUp, type Vec3} from '../math';
import {daylightUnder, directionTo, type Daylight, type SunPlace} from './daylight';
import {HARMONICS, harmonicsOf} from './harmonics';
import {YAW_STEPS, type PackView} from './pack_view';
import {SkyTable} from './sky_table';

const RESPONSE_BYTES = 36;
const luminance = (color: Vec3): number => dot(color, [0.2126, 0.7152, 0.0722]);

/** Display values of linear ones in 0..1, in 4096 steps: the curve is asked for often. */
const DISPLAY = Uint8Array.from({length: 4097}, (_, i) => Math.round(255 * displayValue(i / 4096)));
const displayByte = (linear: number): number => DISPLAY[Math.round(4096 * clamp(linear, 0, 1))];

/** What an archetype is lit by. */
interface Lamp {
  sun: Vec3;
  ambient: Vec3;
  exposure: number;
  face: number;
  lift: number;
}

/** Puffs are lit when they are first asked for after the sun has moved: of a wide sky few archetypes are in view. */
export class Lighting {
  /** Red, green, blue, and what is added when one looks towards the sun (255 is the sun's colour), per puff and heading. */
  colors: Uint8Array;
  direction: Vec3 = [0, 1, 0];
  daylight: Daylight;
  sky: SkyTable;
  /** Per archetype: factors of a cloud's colour in the shadow of others, sun and other light apart. */
  readonly dimmings: {sun: Vec3; other: Vec3}[] = [];
  private readonly rows: Int32Array;
  /** Which setting of the sun a row was lit by. */
  private readonly litFor: Uint32Array;
  private setting = 0;
  private readonly lamps: Lamp[] = [];

  constructor(private readonly pack: PackView) {
    this.litFor = new Uint32Array(pack.archetypes.length * YAW_STEPS);
    this.rows = new Int32Array(pack.archetypes.length * YAW_STEPS).fill(-1);
    let colors = 0;
    for (let i = 0; i < pack.clouds.count; ++i) {
      const archetype = pack.clouds.archetype(i);
      const row = archetype * YAW_STEPS + pack.clouds.yawStep(i);
      if (this.rows[row] >= 0) continue;
      const info = pack.archetypes[archetype];
      this.rows[row] = colors;
      colors += info.endPuff - info.firstPuff;
    }
    this.colors = new Uint8Array(4 * colors);
    this.daylight = daylightUnder(pack.root, 45);
    this.sky = new SkyTable(this.daylight, this.direction);
  }

  /** The colour of puff p is at 4 times this plus p less the first puff of the archetype. */
  firstColor(archetype: number, yawStep: number): number {
    const row = archetype * YAW_STEPS + yawStep;
    if (this.litFor[row] !== this.setting) {
      this.litFor[row] = this.setting;
      this.lightRow(archetype, yawStep, this.rows[row]);
    }
    return this.rows[row];
  }

  sunColor(archetype: number): Vec3 {
    return this.daylight.suns[this.pack.archetypes[archetype].sunHeight];
  }

  setSun(sun: SunPlace): void {
    ++this.setting;
    this.direction = directionTo(sun);
    this.daylight = daylightUnder(this.pack.root, sun.elevationDegrees);
    this.sky = new SkyTable(this.daylight, this.direction);
    const tone = this.pack.root.tone()!;
    const lift = Math.pow(Math.max(this.direction[1], this.pack.root.liftLowest()), -this.pack.root.liftPower());
    this.pack.archetypes.forEach((_, archetype) => {
      const sunColor = this.sunColor(archetype);
      const skyShare = tone.skyWithoutSun() + Math.min(1, luminance(sunColor)) * (tone.skyAtNoon() - tone.skyWithoutSun());
      const ambient = scale(this.daylight.ambient, skyShare);
      this.dimmings[archetype] = {
        sun: scale(sunColor, tone.meanSun()),
        other: along(scale(ambient, tone.meanSky()), tone.meanGround(), this.daylight.bounce),
      };
      const white = luminance(along(ambient, tone.whiteSun(), sunColor)) + 1e-6;
      const exposure = Math.min(tone.white() / white, tone.mostExposure());
      const face = (exposure * white) / tone.white();
      this.lamps[archetype] = {sun: sunColor, ambient, exposure, face, lift};
    });
  }

  private lightRow(index: number, yaw: number, firstColor: number): void {
    const {sun, ambient, exposure, face, lift} = this.lamps[index];
    const {root, responses, levelTops} = this.pack;
    const info = this.pack.archetypes[index];
    const archetype = root.archetypes(index)!;
    const tone = root.tone()!;
    const harmonics = harmonicsOf(turnedAboutUp(this.direction, (-2 * Math.PI * yaw) / YAW_STEPS));
    const weights = harmonics.map((value, i) => (value * archetype.sunScale(i)!) / 127);
    const forward = harmonics.map((value, i) => (value * archetype.forwardScale(i)!) / 127);
    const [sunLeast, sunMost, forwardMost, archetypeBeam] = [archetype.sunLeast(), archetype.sunMost(), archetype.forwardMost(), archetype.beam()];
    const [contrast, knee, room, mostForward] = [tone.contrast() - 1, tone.knee(), tone.room(), tone.mostForward()];
    const bounce = this.daylight.bounce;
    const first = info.firstPuff;
    const count = info.endPuff - first;
    const linear = new Float32Array(3 * count);
    const out = 4 * firstColor;
    const mean = [0, 0, 0];
    let meanWeight = 0;
    for (let i = 0; i < count; ++i) {
      const at = RESPONSE_BYTES * (first + i);
      let answer = 0;
      let beam = 0;
      for (let k = 0; k < HARMONICS; ++k) {
        answer += responses[at + k] * weights[k];
        beam += responses[at + HARMONICS + k] * forward[k];
      }
      const top = levelTops[first + i] / 255;
      answer = (1 + top * (lift - 1)) * clamp(answer, sunLeast, sunMost);
      const unit = (byte: number) => (responses[at + byte] & 255) / 255;
      const [skySeen, groundSeen, seen, weight] = [unit(32), unit(33), unit(34), unit(35)];
      let r = exposure * (sun[0] * answer + ambient[0] * skySeen + bounce[0] * groundSeen);
      let g = exposure * (sun[1] * answer + ambient[1] * skySeen + bounce[1] * groundSeen);
      let b = exposure * (sun[2] * answer + ambient[2] * skySeen + bounce[2] * groundSeen);
      // The tone curve of the schema.
      let gain = Math.pow((0.2126 * r + 0.7152 * g + 0.0722 * b) / face, contrast);
      const most = gain * Math.max(r, g, b);
      if (most > knee) gain *= (knee + room * (1 - Math.exp((knee - most) / room))) / most;
      r *= gain;
      g *= gain;
      b *= gain;
      linear[3 * i] = r;
      linear[3 * i + 1] = g;
      linear[3 * i + 2] = b;
      mean[0] += weight * r;
      mean[1] += weight * g;
      mean[2] += weight * b;
      meanWeight += weight;
      const lining = clamp(clamp(beam, 0, forwardMost) + exposure * archetypeBeam * answer, 0, mostForward);
      this.colors[out + 4 * i + 3] = Math.round(clamp(255 * seen * lining, 0, 255));
    }
    for (let i = 0; i < count; ++i) {
      const seen = meanWeight > 0 ? (responses[RESPONSE_BYTES * (first + i) + 34] & 255) / 255 : 1;
      for (let k = 0; k < 3; ++k) {
        const common = meanWeight > 0 ? mean[k] / meanWeight : 0;
        this.colors[out + 4 * i + k] = displayByte(common + seen * (linear[3 * i + k] - common));
      }
    }
  }
}
