// SPDX-License-Identifier: Apache-2.0
import {along, clamp, cross, directionOf, length, normalized, sub, UP, type Vec3} from './math';

/** Nearly straight up or down, where headings end. */
const STEEPEST = Math.PI / 2 - 0.002;

/** Where the camera is, where it looks, and how far ahead lies what it turns about. Angles in radians, heading clockwise from -z. */
export interface Pose {
  eye: Vec3;
  heading: number;
  pitch: number;
  reach: number;
}

export const forwardOf = (pose: Pose): Vec3 => directionOf(pose.heading, pose.pitch);
export const targetOf = (pose: Pose): Vec3 => along(pose.eye, pose.reach, forwardOf(pose));

export function poseTowards(eye: Vec3, target: Vec3): Pose {
  const way = sub(target, eye);
  const reach = length(way);
  const pitch = clamp(Math.asin(clamp(way[1] / Math.max(reach, 1e-9), -1, 1)), -STEEPEST, STEEPEST);
  return {eye, heading: Math.atan2(way[0], -way[2]), pitch, reach};
}

export function turned(pose: Pose, heading: number, pitch: number): Pose {
  return {...pose, heading: pose.heading + heading, pitch: clamp(pose.pitch + pitch, -STEEPEST, STEEPEST)};
}

/** Turned about what lies ahead, from no lower than a height. */
export function orbited(pose: Pose, heading: number, pitch: number, lowest: number): Pose {
  const target = targetOf(pose);
  const made = turned(pose, heading, pitch);
  const least = clamp((lowest - target[1]) / pose.reach, -0.999, 0.999);
  made.pitch = Math.min(made.pitch, -Math.asin(least), STEEPEST);
  made.eye = along(target, -pose.reach, forwardOf(made));
  return made;
}

/** Nearer to what lies ahead, or farther from it. */
export function zoomed(pose: Pose, factor: number, least: number, most: number): Pose {
  const reach = clamp(pose.reach * factor, least, most);
  return {...pose, reach, eye: along(targetOf(pose), -reach, forwardOf(pose))};
}

/** Moved over the ground with what lies ahead: metres to the right and away. */
export function panned(pose: Pose, right: number, away: number): Pose {
  const side = sideOf(pose);
  return {...pose, eye: along(along(pose.eye, right, side), away, cross(UP, side))};
}

/** Level, to the right. */
export function sideOf(pose: Pose): Vec3 {
  return normalized([Math.cos(pose.heading), 0, Math.sin(pose.heading)]);
}
