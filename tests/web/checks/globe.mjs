// SPDX-License-Identifier: Apache-2.0
import {similarity} from '../lib/similarity.mjs';
import {picture} from './drawing.mjs';

/** On the globe what is level where the viewer is differs from what is level in the scene: a pixel or two. */
const LEAST_SIMILARITY = 0.93;

/** From its first viewpoint, in degrees, the scene on the globe looks as from that of the scene in metres. */
export async function looksTheSameOnTheGlobe({globe, plane}, picturePath) {
  const seen = async (address, name) => (await picture(address, `${picturePath}.${name}`, {settleMilliseconds: 2000})).full;
  const alike = similarity(await seen(globe, 'globe'), await seen(plane, 'plane'));
  if (!(alike >= LEAST_SIMILARITY)) throw new Error(`a structural similarity of ${alike.toFixed(3)}, at least ${LEAST_SIMILARITY} is expected`);
  return `similarity ${alike.toFixed(3)}`;
}
