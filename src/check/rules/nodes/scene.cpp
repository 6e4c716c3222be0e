// SPDX-License-Identifier: Apache-2.0
// Nodes that order a scene, move it and light it, by ISO/IEC 19775-1:2023. node_lists.hpp says how to read it.
#include "check/rules/nodes/node_lists.hpp"

namespace cloudgen::check {

std::string_view sceneNodes() {
  return R"list(Component Core
MetadataBoolean 1 33 metadata : X3DNode X3DMetadataObject : MFBool value
MetadataDouble 1 30 metadata : X3DNode X3DMetadataObject : MFDouble value
MetadataFloat 1 30 metadata : X3DNode X3DMetadataObject : MFFloat value
MetadataInteger 1 30 metadata : X3DNode X3DMetadataObject : MFInt32 value
MetadataSet 1 30 metadata : X3DMetadataObject : MFNode value=X3DMetadataObject
MetadataString 1 30 metadata : X3DNode X3DMetadataObject : MFString value
WorldInfo 1 20 children : X3DChildNode : MFString info, SFString title
Component Grouping
Group 1 20 children : X3DGroupingNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>
StaticGroup 3 30 children : X3DChildNode X3DBoundedObject : MFNode children=X3DChildNode!i
Switch 2 20 children : X3DGroupingNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>, SFInt32 whichChoice
Transform 1 20 children : X3DGroupingNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>, SFVec3f center, SFRotation rotation, SFVec3f scale, SFRotation scaleOrientation, SFVec3f translation
Component Navigation
Billboard 2 20 children : X3DGroupingNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>, SFVec3f axisOfRotation
Collision 2 20 children : X3DGroupingNode X3DSensorNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, SFNode proxy=X3DChildNode!i, MFNode removeChildren=X3DChildNode!>, SFTime collideTime!<
LOD 2 20 children : X3DGroupingNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>, SFVec3f center!i, SFBool forceTransitions!i, SFInt32 level_changed!<, MFFloat range!i
NavigationInfo 1 20 children : X3DBindableNode : MFFloat avatarSize, SFBool headlight, SFFloat speed, SFBool transitionComplete!<, SFTime transitionTime, MFString transitionType, MFString type, SFFloat visibilityLimit
Viewpoint 1 20 children : X3DViewpointNode : SFVec3f centerOfRotation, SFFloat fieldOfView, SFVec3f position
OrthoViewpoint 3 30 children : X3DViewpointNode : SFVec3f centerOfRotation, SFVec4f fieldOfView, SFVec3f position
ViewpointGroup 3 32 children : X3DChildNode : MFNode children=X3DViewpointNode|ViewpointGroup, SFVec3f center, SFString description, SFBool displayed, SFBool retainUserOffsets, SFVec3f size
Component Networking
Anchor 2 20 children : X3DGroupingNode X3DUrlObject : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>, MFString parameter
Inline 2 20 children : X3DChildNode X3DUrlObject : SFVec3f bboxCenter!i, SFBool bboxDisplay, SFVec3f bboxSize!i, SFBool global, SFBool visible
LoadSensor 3 30 children : X3DSensorNode : MFNode children=X3DUrlObject, SFBool isLoaded!<, SFTime loadTime!<, SFFloat progress!<, SFTime timeOut
Component EnvironmentalEffects
Background 1 20 children : X3DBackgroundNode : MFString backUrl, MFString bottomUrl, MFString frontUrl, MFString leftUrl, MFString rightUrl, MFString topUrl
Fog 2 20 children : X3DBindableNode X3DFogObject :
FogCoordinate 4 30 fogCoord : X3DNode : MFFloat depth
LocalFog 4 30 children : X3DChildNode X3DFogObject : SFBool enabled
TextureBackground 3 30 children : X3DBackgroundNode : SFNode backTexture=X3DTexture2DNode|MultiTexture, SFNode bottomTexture=X3DTexture2DNode|MultiTexture, SFNode frontTexture=X3DTexture2DNode|MultiTexture, SFNode leftTexture=X3DTexture2DNode|MultiTexture, SFNode rightTexture=X3DTexture2DNode|MultiTexture, SFNode topTexture=X3DTexture2DNode|MultiTexture
Component Lighting
DirectionalLight 1 20 children : X3DLightNode : SFVec3f direction
PointLight 2 20 children : X3DLightNode : SFVec3f attenuation, SFVec3f location, SFFloat radius
SpotLight 2 20 children : X3DLightNode : SFVec3f attenuation, SFFloat beamWidth, SFFloat cutOffAngle, SFVec3f direction, SFVec3f location, SFFloat radius
Component Time
TimeSensor 1 20 children : X3DTimeDependentNode X3DSensorNode : SFTime cycleInterval, SFTime cycleTime!<, SFFloat fraction_changed!<, SFBool loop, SFTime time!<
Component Interpolation
ColorInterpolator 2 20 children : X3DInterpolatorNode : MFColor keyValue, SFColor value_changed!<
CoordinateInterpolator 1 20 children : X3DInterpolatorNode : MFVec3f keyValue, MFVec3f value_changed!<
CoordinateInterpolator2D 3 30 children : X3DInterpolatorNode : MFVec2f keyValue, MFVec2f value_changed!<
NormalInterpolator 2 20 children : X3DInterpolatorNode : MFVec3f keyValue, MFVec3f value_changed!<
OrientationInterpolator 1 20 children : X3DInterpolatorNode : MFRotation keyValue, SFRotation value_changed!<
PositionInterpolator 1 20 children : X3DInterpolatorNode : MFVec3f keyValue, SFVec3f value_changed!<
PositionInterpolator2D 3 30 children : X3DInterpolatorNode : MFVec2f keyValue, SFVec2f value_changed!<
ScalarInterpolator 1 20 children : X3DInterpolatorNode : MFFloat keyValue, SFFloat value_changed!<
EaseInEaseOut 4 32 children : X3DChildNode : MFVec2f easeInEaseOut, MFFloat key, SFFloat modifiedFraction_changed!<, SFFloat set_fraction!>
SplinePositionInterpolator 4 32 children : X3DInterpolatorNode : SFBool closed, MFVec3f keyValue, MFVec3f keyVelocity, SFBool normalizeVelocity, SFVec3f value_changed!<
SplinePositionInterpolator2D 4 32 children : X3DInterpolatorNode : SFBool closed, MFVec2f keyValue, MFVec2f keyVelocity, SFBool normalizeVelocity, SFVec2f value_changed!<
SplineScalarInterpolator 4 32 children : X3DInterpolatorNode : SFBool closed, MFFloat keyValue, MFFloat keyVelocity, SFBool normalizeVelocity, SFFloat value_changed!<
SquadOrientationInterpolator 5 32 children : X3DInterpolatorNode : MFRotation keyValue, SFBool normalizeVelocity, SFRotation value_changed!<
Component Followers
ColorDamper 1 32 children : X3DDamperNode : SFColor initialDestination!i, SFColor initialValue!i, SFColor set_destination!>, SFColor set_value!>, SFColor value_changed!<
CoordinateDamper 1 32 children : X3DDamperNode : MFVec3f initialDestination!i, MFVec3f initialValue!i, MFVec3f set_destination!>, MFVec3f set_value!>, MFVec3f value_changed!<
OrientationDamper 1 32 children : X3DDamperNode : SFRotation initialDestination!i, SFRotation initialValue!i, SFRotation set_destination!>, SFRotation set_value!>, SFRotation value_changed!<
PositionDamper 1 32 children : X3DDamperNode : SFVec3f initialDestination!i, SFVec3f initialValue!i, SFVec3f set_destination!>, SFVec3f set_value!>, SFVec3f value_changed!<
PositionDamper2D 1 32 children : X3DDamperNode : SFVec2f initialDestination!i, SFVec2f initialValue!i, SFVec2f set_destination!>, SFVec2f set_value!>, SFVec2f value_changed!<
ScalarDamper 1 33 children : X3DDamperNode : SFFloat initialDestination!i, SFFloat initialValue!i, SFFloat set_destination!>, SFFloat set_value!>, SFFloat value_changed!<
TexCoordDamper2D 1 32 children : X3DDamperNode : MFVec2f initialDestination!i, MFVec2f initialValue!i, MFVec2f set_destination!>, MFVec2f set_value!>, MFVec2f value_changed!<
ColorChaser 1 33 children : X3DChaserNode : SFColor initialDestination!i, SFColor initialValue!i, SFColor set_destination!>, SFColor set_value!>, SFColor value_changed!<
CoordinateChaser 1 33 children : X3DChaserNode : MFVec3f initialDestination!i, MFVec3f initialValue!i, MFVec3f set_destination!>, MFVec3f set_value!>, MFVec3f value_changed!<
OrientationChaser 1 32 children : X3DChaserNode : SFRotation initialDestination!i, SFRotation initialValue!i, SFRotation set_destination!>, SFRotation set_value!>, SFRotation value_changed!<
PositionChaser 1 32 children : X3DChaserNode : SFVec3f initialDestination!i, SFVec3f initialValue!i, SFVec3f set_destination!>, SFVec3f set_value!>, SFVec3f value_changed!<
PositionChaser2D 1 32 children : X3DChaserNode : SFVec2f initialDestination!i, SFVec2f initialValue!i, SFVec2f set_destination!>, SFVec2f set_value!>, SFVec2f value_changed!<
ScalarChaser 1 32 children : X3DChaserNode : SFFloat initialDestination!i, SFFloat initialValue!i, SFFloat set_destination!>, SFFloat set_value!>, SFFloat value_changed!<
TexCoordChaser2D 1 33 children : X3DChaserNode : MFVec2f initialDestination!i, MFVec2f initialValue!i, MFVec2f set_destination!>, MFVec2f set_value!>, MFVec2f value_changed!<
Component EventUtilities
BooleanFilter 1 30 children : X3DChildNode : SFBool inputFalse!<, SFBool inputNegate!<, SFBool inputTrue!<, SFBool set_boolean!>
BooleanSequencer 1 30 children : X3DSequencerNode : MFBool keyValue, SFBool value_changed!<
BooleanToggle 1 30 children : X3DChildNode : SFBool set_boolean!>, SFBool toggle
BooleanTrigger 1 30 children : X3DChildNode : SFTime set_triggerTime!>, SFBool triggerTrue!<
IntegerSequencer 1 30 children : X3DSequencerNode : MFInt32 keyValue, SFInt32 value_changed!<
IntegerTrigger 1 30 children : X3DChildNode : SFInt32 integerKey, SFBool set_boolean!>, SFInt32 triggerValue!<
TimeTrigger 1 30 children : X3DChildNode : SFBool set_boolean!>, SFTime triggerTime!<
Component Scripting
Script 1 20 children : X3DScriptNode : SFBool directOutput!i, SFBool mustEvaluate!i
Component Layering
Layer 1 32 layers : X3DLayerNode :
LayerSet 1 32 children : X3DNode : MFNode layers=X3DLayerNode, SFInt32 activeLayer, MFInt32 order
Viewport 1 32 viewport : X3DViewportNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>, MFFloat clipBoundary
Component Layout
Layout 1 32 layout : X3DLayoutNode : MFString align, MFFloat offset, MFString offsetUnits, MFString scaleMode, MFFloat size, MFString sizeUnits
LayoutGroup 1 32 children : X3DGroupingNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, SFNode layout=X3DLayoutNode, MFNode removeChildren=X3DChildNode!>, SFNode viewport=X3DViewportNode
LayoutLayer 1 32 layers : X3DLayerNode : SFNode layout=X3DLayoutNode
ScreenFontStyle 2 32 fontStyle : X3DFontStyleNode : SFFloat pointSize
ScreenGroup 2 32 children : X3DGroupingNode : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, MFNode removeChildren=X3DChildNode!>
)list";
}

}  // namespace cloudgen::check
