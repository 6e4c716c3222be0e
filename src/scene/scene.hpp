// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "base/frame.hpp"
#include "base/genus.hpp"
#include "base/height_field.hpp"
#include "base/time.hpp"
#include "light/puff_light.hpp"
#include "light/response.hpp"
#include "light/shadow.hpp"
#include "light/sky.hpp"
#include "shape/blending.hpp"
#include "shape/puff.hpp"

namespace cloudgen::scene {

/// Yaw is quantised so that light is computed once an archetype and heading: 16 steps of 22.5 degrees.
inline constexpr int kYawSteps = 16;

/// A cloud shape that many clouds share, in metres at scale 1: origin at the middle of the base, y up, wind
/// along +x.
struct Archetype {
  std::string name;  ///< unique in the scene, a valid XML name: "Cu_3_2_1"
  base::Genus genus{};
  std::vector<shape::Puff> puffs;           ///< ordered by section
  std::vector<std::uint32_t> sectionStart;  ///< puffs of section s: [sectionStart[s], sectionStart[s+1])
  shape::Bounds bounds;
  float widthMeters = 0, depthMeters = 0;  ///< nominal, at scale 1
  float opticalDepth = 0;                  ///< vertical, mean over the nominal footprint, at factor 1
  float covering = shape::kCoveringAmongMany,
        farCovering =
            shape::kCoveringAmongMany;  ///< of its puffs, and of
                                        ///< its far puffs, drawn as blended blobs: shape::widenedAcross
  std::vector<shape::Puff> farPuffs;    ///< the same cloud as a handful of puffs (at most 8), for far levels
  shape::Puff onePuff;                  ///< the same cloud as one puff that covers as much ground
  light::CloudResponse response;        ///< how its puffs answer to any light, one a puff
};

/// The light on an archetype under one heading of it: one entry a puff (and one a far puff).
struct LitArchetype {
  std::uint32_t archetype = 0;
  int yawStep = 0;
  std::vector<light::PuffLight> puffs, farPuffs;
  light::PuffLight onePuff;
};

/// A cloud: an archetype, moved, turned (about y, counter-clockwise seen from above: +x towards -z) and
/// scaled.
struct Instance {
  std::uint32_t lit = 0;  ///< index in Scene::lit
  glm::vec3 position{0};  ///< of the archetype's origin, in the scene frame
  float scale = 1;
  float opticalDepthFactor =
      1;  ///< multiplies extinction * scale^-1, so that optical depth is the archetype's times this
  float sunlight = 1;  ///< share of the sun that other clouds above let through to it
};

/// Where an instance is at a moment, against its place in the scene.
struct Moment {
  glm::vec3 shift{0};
  float growth = 1;    ///< on its scale; more than 0
  float presence = 1;  ///< on its optical depth: 0 where it is not there
};

/// The moments of an instance at the entries of Scene::keySeconds from `firstKey` on, linear between them.
/// Before and after it is not there.
struct Motion {
  std::uint32_t firstKey = 0;
  std::vector<Moment> moments;
};

/// Where a cloud comes from; parallel to Scene::instances.
struct CloudRecord {
  std::uint64_t id = 0;  ///< stable: cell, layer (8 bits) and number in the layer (24 bits)
  base::Genus genus{};
  std::string rule;
  std::uint32_t cell = 0;
  double longitudeDegrees = 0, latitudeDegrees = 0;
  float baseMeters = 0, topMeters = 0, opticalDepth = 0;
  std::uint16_t layer = 0;  ///< of the cell, counted upwards
};

struct Provenance {
  std::vector<std::string> files;
  std::string format, model;
  std::string run;  ///< ISO time, or empty
};

/// The one intermediate representation. Writers see nothing else. Everything in the scene frame
/// (base::LocalFrame).
struct Scene {
  base::LocalFrame frame;
  base::UtcTime validTime;
  light::Sun sun;
  light::Sky sky;
  std::uint64_t seed = 0;
  Provenance provenance;
  std::vector<Archetype> archetypes;
  std::vector<LitArchetype> lit;
  std::vector<Instance> instances;
  std::vector<CloudRecord> clouds;
  float groundHeightMeters = 0;    ///< lowest ground, and all of it where the terrain is empty
  base::HeightField terrain;       ///< its border lies at groundHeightMeters
  light::ShadowPlane shadows;      ///< of all clouds, where they fall on the ground
  std::vector<double> keySeconds;  ///< of a sky that moves: from validTime on, ascending; else empty
  std::vector<double> timeSeconds;  ///< those of keySeconds that are times of the forecast
  std::vector<Motion> motions;     ///< one an instance, or none
};

/// Number of puffs that are drawn when every instance is drawn in full.
std::uint64_t drawnPuffs(const Scene& scene);

/// The puff of an instance in the scene frame: centre, deviations, rotation, extinction.
shape::Puff placed(const Scene& scene, const Instance& instance, const shape::Puff& puff);

/// The instances as they stand at a time of a sky that moves, those that are not there with an optical depth
/// of 0. Times before the first key and after the last are taken there.
std::vector<Instance> instancesAt(const Scene& scene, double seconds);

/// The scene of a time of a sky that moves: it stands still, without the clouds that are not there. Light as at first.
Scene standingAt(const Scene& scene, double seconds);

/// Yaw of a step, radians.
float yawRadians(int yawStep);

/// The box around an instance, whatever its heading, scene frame.
shape::Bounds boundsOf(const Scene& scene, const Instance& instance);

/// Height of the ground at a place of the scene frame, metres.
float groundAt(const Scene& scene, double x, double z);

/// Level ground under the scene's box, as a lattice of so many cells a side.
base::HeightField flatGround(const Scene& scene, int cells);

/// The top of the highest cloud, metres; 0 without clouds.
float highestTop(const Scene& scene);

/// One square of the ground and the instances whose origin stands on it.
struct Tile {
  int column = 0, row = 0;
  glm::vec3 lower{0}, upper{0};          ///< box around the tile's clouds
  std::vector<std::uint32_t> instances;  ///< ascending
};

/// Splits the ground into squares of the given side; only tiles with clouds, row by row from the north-west.
std::vector<Tile> tilesOf(const Scene& scene, float sideMeters);

/// The most tiles that a scene is cut into where a format keeps its clouds by tile.
inline constexpr std::size_t kMostTiles = 16;

/// Squares of one size, a quarter of the scene's extent or larger, so that there are at most kMostTiles.
std::vector<Tile> tilesOf(const Scene& scene);

}  // namespace cloudgen::scene
