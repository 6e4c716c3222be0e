// SPDX-License-Identifier: Apache-2.0
// Nodes of shapes and how they look, by ISO/IEC 19775-1:2023. node_lists.hpp says how to read it.
#include "check/rules/nodes/node_lists.hpp"

namespace cloudgen::check {

std::string_view shapeNodes() {
  return R"list(Component Shape
Appearance 1 20 appearance : X3DAppearanceNode : SFNode acousticProperties=AcousticProperties, SFNode fillProperties=FillProperties, SFNode lineProperties=LineProperties, SFNode material=X3DMaterialNode, SFNode pointProperties=PointProperties, MFNode shaders=X3DShaderNode, SFNode texture=X3DTextureNode, SFNode textureTransform=X3DTextureTransformNode, SFFloat alphaCutoff, SFString alphaMode
FillProperties 3 30 fillProperties : X3DNode : SFBool filled, SFColor hatchColor, SFInt32 hatchStyle, SFBool hatched
LineProperties 2 30 lineProperties : X3DNode : SFBool applied, SFInt32 linetype, SFFloat linewidthScaleFactor
PointProperties 5 40 pointProperties : X3DNode : SFVec3f attenuation, SFFloat pointSizeMaxValue, SFFloat pointSizeMinValue, SFFloat pointSizeScaleFactor
Material 1 20 material : X3DOneSidedMaterialNode : SFNode ambientTexture=X3DSingleTextureNode, SFNode diffuseTexture=X3DSingleTextureNode, SFNode occlusionTexture=X3DSingleTextureNode, SFNode shininessTexture=X3DSingleTextureNode, SFNode specularTexture=X3DSingleTextureNode, SFFloat ambientIntensity, SFString ambientTextureMapping, SFColor diffuseColor, SFString diffuseTextureMapping, SFFloat occlusionStrength, SFString occlusionTextureMapping, SFFloat shininess, SFString shininessTextureMapping, SFColor specularColor, SFString specularTextureMapping
TwoSidedMaterial 4 32 material : X3DMaterialNode : SFFloat ambientIntensity, SFFloat backAmbientIntensity, SFColor backDiffuseColor, SFColor backEmissiveColor, SFFloat backShininess, SFColor backSpecularColor, SFFloat backTransparency, SFColor diffuseColor, SFBool separateBackColor, SFFloat shininess, SFColor specularColor
Shape 1 20 children : X3DShapeNode :
PhysicalMaterial 2 40 material : X3DOneSidedMaterialNode : SFNode baseTexture=X3DSingleTextureNode, SFNode metallicRoughnessTexture=X3DSingleTextureNode, SFNode occlusionTexture=X3DSingleTextureNode, SFColor baseColor, SFString baseTextureMapping, SFFloat metallic, SFString metallicRoughnessTextureMapping, SFFloat occlusionStrength, SFString occlusionTextureMapping, SFFloat roughness
UnlitMaterial 1 40 material : X3DOneSidedMaterialNode :
AcousticProperties 5 40 acousticProperties : X3DNode : SFFloat absorption, SFString description, SFFloat diffuse, SFBool enabled, SFFloat refraction, SFFloat specular
Component Rendering
ClipPlane 5 32 children : X3DChildNode : SFBool enabled, SFVec4f plane
Color 1 20 color : X3DColorNode : MFColor color
ColorRGBA 1 30 color : X3DColorNode : MFColorRGBA color
Coordinate 1 20 coord : X3DCoordinateNode : MFVec3f point
CoordinateDouble 1 30 coord : X3DCoordinateNode : MFVec3d point
IndexedLineSet 1 20 geometry : X3DGeometryNode : MFNode attrib=X3DVertexAttributeNode, SFNode color=X3DColorNode, SFNode coord=X3DCoordinateNode, SFNode fogCoord=FogCoordinate, SFNode normal=X3DNormalNode, MFInt32 colorIndex!i, SFBool colorPerVertex!i, MFInt32 coordIndex!i, MFInt32 set_colorIndex!>, MFInt32 set_coordIndex!>
IndexedTriangleFanSet 3 30 geometry : X3DComposedGeometryNode : MFInt32 index!i, MFInt32 set_index!>
IndexedTriangleSet 3 30 geometry : X3DComposedGeometryNode : MFInt32 index!i, MFInt32 set_index!>
IndexedTriangleStripSet 3 30 geometry : X3DComposedGeometryNode : MFInt32 index!i, MFInt32 set_index!>
LineSet 1 30 geometry : X3DGeometryNode : MFNode attrib=X3DVertexAttributeNode, SFNode color=X3DColorNode, SFNode coord=X3DCoordinateNode, SFNode fogCoord=FogCoordinate, SFNode normal=X3DNormalNode, MFInt32 vertexCount
Normal 2 20 normal : X3DNormalNode : MFVec3f vector
PointSet 1 20 geometry : X3DGeometryNode : MFNode attrib=X3DVertexAttributeNode, SFNode color=X3DColorNode, SFNode coord=X3DCoordinateNode, SFNode fogCoord=FogCoordinate, SFNode normal=X3DNormalNode
TriangleFanSet 3 30 geometry : X3DComposedGeometryNode : MFInt32 fanCount
TriangleSet 3 30 geometry : X3DComposedGeometryNode :
TriangleStripSet 3 30 geometry : X3DComposedGeometryNode : MFInt32 stripCount
Component Geometry3D
Box 1 20 geometry : X3DGeometryNode : SFVec3f size!i, SFBool solid!i
Cone 1 20 geometry : X3DGeometryNode : SFBool bottom, SFFloat bottomRadius!i, SFFloat height!i, SFBool side, SFBool solid!i
Cylinder 1 20 geometry : X3DGeometryNode : SFBool bottom, SFFloat height!i, SFFloat radius!i, SFBool side, SFBool solid!i, SFBool top
ElevationGrid 3 20 geometry : X3DGeometryNode : MFNode attrib=X3DVertexAttributeNode, SFNode color=X3DColorNode, SFNode fogCoord=FogCoordinate, SFNode normal=X3DNormalNode, SFNode texCoord=X3DSingleTextureCoordinateNode, SFBool ccw!i, SFBool colorPerVertex!i, SFFloat creaseAngle!i, MFFloat height!i, SFBool normalPerVertex!i, MFFloat set_height!>, SFBool solid!i, SFInt32 xDimension!i, SFFloat xSpacing!i, SFInt32 zDimension!i, SFFloat zSpacing!i
Extrusion 4 20 geometry : X3DGeometryNode : SFBool beginCap!i, SFBool ccw!i, SFBool convex!i, SFFloat creaseAngle!i, MFVec2f crossSection!i, SFBool endCap!i, MFRotation orientation!i, MFVec2f scale!i, MFVec2f set_crossSection!>, MFRotation set_orientation!>, MFVec2f set_scale!>, MFVec3f set_spine!>, SFBool solid!i, MFVec3f spine!i
IndexedFaceSet 2 20 geometry : X3DComposedGeometryNode : MFInt32 colorIndex!i, SFBool convex!i, MFInt32 coordIndex!i, SFFloat creaseAngle!i, MFInt32 normalIndex!i, MFInt32 set_colorIndex!>, MFInt32 set_coordIndex!>, MFInt32 set_normalIndex!>, MFInt32 set_texCoordIndex!>, MFInt32 texCoordIndex!i
Sphere 1 20 geometry : X3DGeometryNode : SFFloat radius!i, SFBool solid!i
Component Geometry2D
Arc2D 2 30 geometry : X3DGeometryNode : SFFloat endAngle!i, SFFloat radius!i, SFFloat startAngle!i
ArcClose2D 2 30 geometry : X3DGeometryNode : SFString closureType!i, SFFloat endAngle!i, SFFloat radius!i, SFBool solid!i, SFFloat startAngle!i
Circle2D 2 30 geometry : X3DGeometryNode : SFFloat radius!i
Disk2D 2 30 geometry : X3DGeometryNode : SFFloat innerRadius!i, SFFloat outerRadius!i, SFBool solid!i
Polyline2D 1 30 geometry : X3DGeometryNode : MFVec2f lineSegments!i
Polypoint2D 1 30 geometry : X3DGeometryNode : MFVec2f point
Rectangle2D 1 30 geometry : X3DGeometryNode : SFVec2f size!i, SFBool solid!i
TriangleSet2D 1 30 geometry : X3DGeometryNode : SFBool solid!i, MFVec2f vertices
Component Text
FontStyle 1 20 fontStyle : X3DFontStyleNode : SFFloat size
Text 1 20 geometry : X3DGeometryNode : SFNode fontStyle=X3DFontStyleNode, MFFloat length, MFVec2f lineBounds!<, SFFloat maxExtent, SFVec3f origin!<, SFBool solid!i, MFString string, SFVec2f textBounds!<
Component Texturing
ImageTexture 1 20 texture : X3DTexture2DNode X3DUrlObject :
TextureProperties 2 30 textureProperties : X3DNode : SFFloat anisotropicDegree, SFColorRGBA borderColor, SFInt32 borderWidth, SFString boundaryModeR, SFString boundaryModeS, SFString boundaryModeT, SFBool generateMipMaps!i, SFString magnificationFilter, SFString minificationFilter, SFString textureCompression, SFFloat texturePriority
MovieTexture 3 20 texture : X3DSoundSourceNode X3DUrlObject : SFNode textureProperties=TextureProperties!i, SFTime duration_changed!<, SFBool loop, SFFloat pitch, SFBool repeatS!i, SFBool repeatT!i, SFFloat speed
MultiTexture 2 30 texture : X3DTextureNode : MFNode texture=X3DSingleTextureNode, SFFloat alpha, SFColor color, MFString function, MFString mode, MFString source
MultiTextureCoordinate 2 30 texCoord : X3DNode : MFNode texCoord=X3DSingleTextureCoordinateNode
MultiTextureTransform 2 30 textureTransform : X3DTextureTransformNode : MFNode textureTransform=X3DSingleTextureTransformNode
PixelTexture 1 20 texture : X3DTexture2DNode : SFImage image
TextureCoordinate 1 20 texCoord : X3DSingleTextureCoordinateNode : MFVec2f point
TextureCoordinateGenerator 2 30 texCoord : X3DSingleTextureCoordinateNode : SFString mode, MFFloat parameter
TextureTransform 1 20 textureTransform : X3DTextureTransformNode : SFVec2f center, SFFloat rotation, SFVec2f scale, SFVec2f translation
Component CubeMapTexturing
ComposedCubeMapTexture 1 31 texture : X3DTextureNode : SFNode backTexture=X3DTexture2DNode, SFNode bottomTexture=X3DTexture2DNode, SFNode frontTexture=X3DTexture2DNode, SFNode leftTexture=X3DTexture2DNode, SFNode rightTexture=X3DTexture2DNode, SFNode topTexture=X3DTexture2DNode
GeneratedCubeMapTexture 3 30 texture : X3DTextureNode : SFNode textureProperties=TextureProperties!i, SFInt32 size!i, SFString update
ImageCubeMapTexture 2 30 texture : X3DTextureNode X3DUrlObject : SFNode textureProperties=TextureProperties!i
Component Texturing3D
ComposedTexture3D 1 31 texture : X3DTexture3DNode : MFNode texture=X3DTexture2DNode
ImageTexture3D 2 31 texture : X3DTexture3DNode X3DUrlObject :
PixelTexture3D 1 31 texture : X3DTexture3DNode : MFInt32 image
TextureCoordinate3D 1 31 texCoord : X3DSingleTextureCoordinateNode : MFVec3f point
TextureCoordinate4D 1 31 texCoord : X3DSingleTextureCoordinateNode : MFVec4f point
TextureTransformMatrix3D 1 31 textureTransform : X3DTextureTransformNode : SFMatrix4f matrix
TextureTransform3D 1 31 textureTransform : X3DTextureTransformNode : SFVec3f center, SFRotation rotation, SFVec3f scale, SFVec3f translation
Component TextureProjector
TextureProjector 2 40 children : X3DTextureProjectorNode : SFFloat fieldOfView, SFVec3f upVector
TextureProjectorParallel 2 40 children : X3DTextureProjectorNode : SFVec4f fieldOfView
Component Shaders
ComposedShader 1 30 shaders : X3DShaderNode X3DProgrammableShaderObject : MFNode parts=ShaderPart, SFBool activate!>, SFBool isSelected!<, SFBool isValid!<, SFString language!i
FloatVertexAttribute 1 30 attrib : X3DVertexAttributeNode : SFInt32 numComponents!i, MFFloat value
Matrix3VertexAttribute 1 30 attrib : X3DVertexAttributeNode : MFMatrix3f value
Matrix4VertexAttribute 1 30 attrib : X3DVertexAttributeNode : MFMatrix4f value
PackagedShader 1 30 shaders : X3DShaderNode X3DProgrammableShaderObject : SFBool activate!>, SFTime autoRefresh, SFTime autoRefreshTimeLimit, SFString description, SFBool isSelected!<, SFBool isValid!<, SFString language!i, SFBool load, MFString url
ProgramShader 1 30 shaders : X3DShaderNode : MFNode programs=ShaderProgram, SFBool activate!>, SFBool isSelected!<, SFBool isValid!<, SFString language!i
ShaderPart 1 30 parts : X3DNodeMixedContent :
ShaderProgram 1 30 programs : X3DNodeMixedContent X3DProgrammableShaderObject :
Component NURBS
Contour2D 4 30 trimmingContour : X3DNode : MFNode addChildren=NurbsCurve2D|ContourPolyline2D!>, MFNode children=NurbsCurve2D|ContourPolyline2D, MFNode removeChildren=NurbsCurve2D|ContourPolyline2D!>
ContourPolyline2D 3 30 children : X3DNurbsControlCurveNode :
NurbsCurve 1 30 geometry : X3DParametricGeometryNode : SFNode controlPoint=Coordinate|CoordinateDouble, SFBool closed!i, MFDouble knot!i, SFInt32 order!i, SFInt32 tessellation, MFDouble weight
NurbsCurve2D 3 30 children : X3DNurbsControlCurveNode : SFBool closed!i, MFDouble knot!i, SFInt32 order!i, SFInt32 tessellation, MFDouble weight
NurbsOrientationInterpolator 1 30 children : X3DChildNode : SFNode controlPoint=Coordinate|CoordinateDouble, MFDouble knot, SFInt32 order, SFFloat set_fraction!>, SFRotation value_changed!<, MFDouble weight
NurbsPatchSurface 1 30 geometry : X3DNurbsSurfaceGeometryNode :
NurbsPositionInterpolator 1 30 children : X3DChildNode : SFNode controlPoint=Coordinate|CoordinateDouble, MFDouble knot, SFInt32 order, SFFloat set_fraction!>, SFVec3f value_changed!<, MFDouble weight
NurbsSet 2 30 children : X3DChildNode X3DBoundedObject : MFNode addGeometry=X3DParametricGeometryNode!>, MFNode geometry=X3DParametricGeometryNode, MFNode removeGeometry=X3DParametricGeometryNode!>, SFFloat tessellationScale
NurbsSurfaceInterpolator 1 30 children : X3DChildNode : SFNode controlPoint=Coordinate|CoordinateDouble, SFVec3f normal_changed!<, SFVec3f position_changed!<, SFVec2f set_fraction!>, SFInt32 uDimension!i, MFDouble uKnot!i, SFInt32 uOrder!i, SFInt32 vDimension!i, MFDouble vKnot!i, SFInt32 vOrder!i, MFDouble weight
NurbsSweptSurface 3 30 geometry : X3DParametricGeometryNode : SFNode crossSectionCurve=X3DNurbsControlCurveNode, SFNode trajectoryCurve=NurbsCurve, SFBool ccw!i, SFBool solid!i
NurbsSwungSurface 3 30 geometry : X3DParametricGeometryNode : SFNode profileCurve=X3DNurbsControlCurveNode, SFNode trajectoryCurve=X3DNurbsControlCurveNode, SFBool ccw!i, SFBool solid!i
NurbsTextureCoordinate 1 30 texCoord : X3DNode : MFVec2f controlPoint, SFInt32 uDimension!i, MFDouble uKnot!i, SFInt32 uOrder!i, SFInt32 vDimension!i, MFDouble vKnot!i, SFInt32 vOrder!i, MFDouble weight
NurbsTrimmedSurface 4 30 geometry : X3DNurbsSurfaceGeometryNode : MFNode addTrimmingContour=Contour2D!>, MFNode removeTrimmingContour=Contour2D!>, MFNode trimmingContour=Contour2D
Component CADGeometry
CADAssembly 2 31 children : X3DGroupingNode X3DProductStructureChildNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>
CADFace 2 31 children : X3DProductStructureChildNode X3DBoundedObject : SFNode shape=Shape|LOD|Transform
CADLayer 2 31 children : X3DGroupingNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>, SFString name
CADPart 2 31 children : X3DProductStructureChildNode X3DGroupingNode : MFNode addChildren=CADFace!>, MFNode children=CADFace, MFNode removeChildren=CADFace!>, SFVec3f center, SFRotation rotation, SFVec3f scale, SFRotation scaleOrientation, SFVec3f translation
IndexedQuadSet 1 31 geometry : X3DComposedGeometryNode : MFInt32 index!i, MFInt32 set_index!>
QuadSet 1 31 geometry : X3DComposedGeometryNode :
)list";
}

}  // namespace cloudgen::check
