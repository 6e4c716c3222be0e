// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/quad_shape.hpp"

namespace cloudgen::writer {
namespace {

/// A few thousand metres need no tenths.
int decimalsFor(const QuadMesh& mesh) {
  float reach = 0;
  for (const Quad& quad : mesh.quads)
    reach = std::max({reach, std::abs(quad.center.x), std::abs(quad.center.z)});
  return reach > 5000 ? 0 : 1;
}

float rounded(float value, int decimals) {
  const float steps = std::pow(10.0f, static_cast<float>(decimals));
  return std::round(value * steps) / steps;
}

constexpr int kColorDecimals = 3, kAlphaDecimals = 5;
/// What is denser is opaque to the eye, and alpha says no more how dense it is.
constexpr float kOpaqueOpticalDepth = 5;

/// As many decimals as tell how much shines through a dense quad.
float writtenAlpha(float alpha) {
  const int nines = alpha < 1 ? static_cast<int>(-std::log10(1 - alpha)) : kAlphaDecimals;
  return rounded(alpha, std::min(kColorDecimals + nines, kAlphaDecimals));
}

bool isOpaque(const Quad& quad) {
  return quad.opticalDepth > kOpaqueOpticalDepth && -std::expm1(-quad.opticalDepth) <= quad.color.a;
}

void append(std::vector<float>& out, const glm::vec3& v) { out.insert(out.end(), {v.x, v.y, v.z}); }

}  // namespace

void QuadShapes::write(base::Genus genus, const QuadMesh& mesh) {
  if (mesh.faces.empty()) return;
  const std::string name(base::abbreviation(genus));
  shapes({"Look_" + name, "Sprites_" + name, atlas(genus).file}, mesh);
}

void QuadShapes::writePictures(const std::string& look, const std::string& texture, const QuadMesh& mesh) {
  shapes({"Look_" + look, "Pictures_" + look, texture}, mesh);
}

void QuadShapes::shapes(const Look& look, const QuadMesh& mesh) {
  const std::span<const std::uint32_t> faces(mesh.faces);
  for (std::size_t i = 0; i < faces.size(); i += kFacesPerShape)
    shape(look, mesh, faces.subspan(i, std::min(kFacesPerShape, faces.size() - i)));
}

void QuadShapes::texture(const Look& look) {
  if (!defined_.insert(look.textureName).second)
    return nodes_.use("ImageTexture", "texture", look.textureName);
  nodes_.open("ImageTexture", "texture", look.textureName);
  nodes_.strings("url", std::vector<std::string>{"textures/" + look.file});
  nodes_.close();
}

void QuadShapes::appearance(const Look& look) {
  if (!defined_.insert(look.name).second) return nodes_.use("Appearance", "appearance", look.name);
  nodes_.open("Appearance", "appearance", look.name);
  texture(look);
  nodes_.close();
}

void QuadShapes::shape(const Look& look, const QuadMesh& mesh, std::span<const std::uint32_t> faces) {
  const bool vrml97 = nodes_.encoding() == Encoding::Vrml97;
  std::vector<float> points, textureBoxes, colors, opticalDepths;
  bool hasOpaque = false;
  std::vector<std::int32_t> indices, first(mesh.quads.size(), -1);
  for (const std::uint32_t face : faces) {
    const Quad& quad = mesh.quads[face / 2];
    std::int32_t& start = first[face / 2];
    if (start < 0) {
      start = static_cast<std::int32_t>(points.size() / 3);
      const glm::vec4& box = quad.textureBox;
      hasOpaque = hasOpaque || isOpaque(quad);
      // Alpha says of an opaque quad neither how dense the puff is nor how far it reaches within the quad.
      opticalDepths.push_back(isOpaque(quad) ? quad.opticalDepth : 0.0f);
      opticalDepths.push_back(isOpaque(quad) ? 1 / quad.widening : 1.0f);
      append(points, quad.center - quad.right - quad.up);
      append(points, quad.center + quad.right - quad.up);
      append(points, quad.center + quad.right + quad.up);
      append(points, quad.center - quad.right + quad.up);
      textureBoxes.insert(textureBoxes.end(), {box.x, box.y, box.z, box.y, box.z, box.w, box.x, box.w});
      for (int corner = 0; corner < 4; ++corner) {
        for (int c = 0; c < 3; ++c) colors.push_back(rounded(quad.color[c], kColorDecimals));
        if (!vrml97) colors.push_back(writtenAlpha(quad.color.a));
      }
    }
    const std::int32_t s = start;
    if (vrml97 && face % 2 == 0) indices.insert(indices.end(), {s, s + 1, s + 2, s + 3, -1});
    if (vrml97 && face % 2 == 1) indices.insert(indices.end(), {s, s + 3, s + 2, s + 1, -1});
    if (!vrml97 && face % 2 == 0) indices.insert(indices.end(), {s, s + 1, s + 2, s, s + 2, s + 3});
    if (!vrml97 && face % 2 == 1) indices.insert(indices.end(), {s, s + 2, s + 1, s, s + 3, s + 2});
  }

  nodes_.open("Shape");
  appearance(look);
  nodes_.open(vrml97 ? "IndexedFaceSet" : "IndexedTriangleSet", "geometry");
  nodes_.integers(vrml97 ? "coordIndex" : "index", indices);
  if (hasOpaque && !vrml97) {
    nodes_.open("MetadataFloat", "metadata");
    nodes_.string("name", "optical_depth narrowing");
    nodes_.numbers("value", opticalDepths, 2, 2);
    nodes_.close();
  }
  if (!vrml97 || std::ranges::any_of(colors, [](float channel) { return channel < 1; })) {
    nodes_.open(vrml97 ? "Color" : "ColorRGBA", "color");
    nodes_.numbers("color", colors, vrml97 ? 3 : 4, vrml97 ? kColorDecimals : kAlphaDecimals);
    nodes_.close();
  }
  nodes_.open("TextureCoordinate", "texCoord");
  nodes_.numbers("point", textureBoxes, 2, 4);
  nodes_.close();
  nodes_.open("Coordinate", "coord");
  nodes_.numbers("point", points, 3, decimalsFor(mesh));
  nodes_.close();
  nodes_.close();
  nodes_.close();
}

}  // namespace cloudgen::writer
