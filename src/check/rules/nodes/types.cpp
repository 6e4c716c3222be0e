// SPDX-License-Identifier: Apache-2.0
// The abstract types that nodes derive from, by ISO/IEC 19775-1:2023. node_lists.hpp says how to read it.
#include "check/rules/nodes/node_lists.hpp"

namespace cloudgen::check {

std::string_view abstractTypes() {
  return R"list(X3DNode : : SFNode metadata=X3DMetadataObject
X3DAppearanceNode : X3DNode :
X3DChildNode : X3DNode :
X3DBindableNode : X3DChildNode : SFTime bindTime!<, SFBool isBound!<, SFBool set_bind!>
X3DBackgroundNode : X3DBindableNode : MFFloat groundAngle, MFColor groundColor, MFFloat skyAngle, MFColor skyColor, SFFloat transparency
X3DBoundedObject : : SFNode metadata=X3DMetadataObject, SFVec3f bboxCenter!i, SFBool bboxDisplay, SFVec3f bboxSize!i, SFBool visible
X3DColorNode : X3DNode :
X3DGeometryNode : X3DNode :
X3DComposedGeometryNode : X3DGeometryNode : MFNode attrib=X3DVertexAttributeNode, SFNode color=X3DColorNode, SFNode coord=X3DCoordinateNode, SFNode fogCoord=FogCoordinate, SFNode normal=X3DNormalNode, SFNode texCoord=X3DSingleTextureCoordinateNode|MultiTextureCoordinate, SFBool ccw!i, SFBool colorPerVertex!i, SFBool normalPerVertex!i, SFBool solid!i
X3DCoordinateNode : X3DNode :
X3DSensorNode : X3DChildNode : SFString description, SFBool enabled, SFBool isActive!<
X3DPointingDeviceSensorNode : X3DSensorNode : SFBool isOver!<
X3DDragSensorNode : X3DPointingDeviceSensorNode : SFBool autoOffset, SFVec3f trackPoint_changed!<
X3DEnvironmentalSensorNode : X3DSensorNode : SFTime enterTime!<, SFTime exitTime!<, SFVec3f size
X3DTextureNode : X3DNode : SFString description
X3DFogObject : : SFNode metadata=X3DMetadataObject, SFColor color, SFString fogType, SFFloat visibilityRange
X3DFontStyleNode : X3DNode : MFString family, SFBool horizontal, MFString justify, SFString language, SFBool leftToRight, SFFloat spacing, SFString style, SFBool topToBottom
X3DGroupingNode : X3DChildNode X3DBoundedObject :
X3DInterpolatorNode : X3DChildNode : MFFloat key, SFFloat set_fraction!>
X3DLightNode : X3DChildNode : SFFloat ambientIntensity, SFColor color, SFBool global, SFFloat intensity, SFBool on, SFFloat shadowIntensity, SFBool shadows
X3DMaterialNode : X3DNode : SFColor emissiveColor, SFFloat transparency
X3DMetadataObject : : SFNode metadata=X3DMetadataObject, SFString name, SFString reference
X3DUrlObject : : SFNode metadata=X3DMetadataObject, SFTime autoRefresh, SFTime autoRefreshTimeLimit, SFString description, SFBool load, MFString url
X3DNodeMixedContent : X3DNode X3DUrlObject : SFString type!i
X3DScriptNode : X3DChildNode X3DUrlObject :
X3DNormalNode : X3DNode :
X3DNurbsControlCurveNode : X3DNode : MFVec2d controlPoint
X3DParametricGeometryNode : X3DGeometryNode :
X3DNurbsSurfaceGeometryNode : X3DParametricGeometryNode : SFNode controlPoint=Coordinate|CoordinateDouble, SFNode texCoord=X3DSingleTextureCoordinateNode|NurbsTextureCoordinate, SFBool solid!i, SFBool uClosed!i, SFInt32 uDimension!i, MFDouble uKnot!i, SFInt32 uOrder!i, SFInt32 uTessellation, SFBool vClosed!i, SFInt32 vDimension!i, MFDouble vKnot!i, SFInt32 vOrder!i, SFInt32 vTessellation, MFDouble weight
X3DProductStructureChildNode : X3DChildNode : SFVec3f bboxCenter!i, SFBool bboxDisplay, SFVec3f bboxSize!i, SFString name, SFBool visible
X3DProgrammableShaderObject : : SFNode metadata=X3DMetadataObject
X3DSequencerNode : X3DChildNode : MFFloat key, SFBool next!>, SFBool previous!>, SFFloat set_fraction!>
X3DShaderNode : X3DNode :
X3DShapeNode : X3DChildNode X3DBoundedObject : SFNode appearance=X3DAppearanceNode, SFNode geometry=X3DGeometryNode, SFBool castShadow
X3DSoundNode : X3DChildNode : SFString description, SFBool enabled
X3DSoundChannelNode : X3DSoundNode : MFNode children=Analyser|AudioClip|AudioDestination|BiquadFilter|BufferAudioSource|ChannelMerger|ChannelSelector|ChannelSplitter|Convolver|Delay|DynamicsCompressor|Gain|ListenerPointSource|MicrophoneSource|MovieTexture|OscillatorSource|Sound|SpatialSound|StreamAudioDestination|StreamAudioSource|WaveShaper, SFInt32 channelCount, SFString channelCountMode, SFString channelInterpretation, SFFloat gain
X3DSoundDestinationNode : X3DSoundNode : MFNode children=Analyser|AudioClip|AudioDestination|BiquadFilter|BufferAudioSource|ChannelMerger|ChannelSelector|ChannelSplitter|Convolver|Delay|DynamicsCompressor|Gain|ListenerPointSource|MicrophoneSource|MovieTexture|OscillatorSource|Sound|SpatialSound|StreamAudioDestination|StreamAudioSource|WaveShaper, SFInt32 channelCount, SFString channelCountMode, SFString channelInterpretation, SFFloat gain, SFBool isActive!<, SFString mediaDeviceID
X3DTimeDependentNode : X3DChildNode : SFString description, SFTime elapsedTime!<, SFBool enabled, SFBool isActive!<, SFBool isPaused!<, SFTime pauseTime, SFTime resumeTime, SFTime startTime, SFTime stopTime
X3DSoundProcessingNode : X3DTimeDependentNode X3DSoundNode : MFNode children=Analyser|AudioClip|AudioDestination|BiquadFilter|BufferAudioSource|ChannelMerger|ChannelSelector|ChannelSplitter|Convolver|Delay|DynamicsCompressor|Gain|ListenerPointSource|MicrophoneSource|MovieTexture|OscillatorSource|Sound|SpatialSound|StreamAudioDestination|StreamAudioSource|WaveShaper, SFInt32 channelCount, SFString channelCountMode, SFString channelInterpretation, SFFloat gain, SFTime tailTime
X3DSoundSourceNode : X3DTimeDependentNode X3DSoundNode : SFFloat gain
X3DSingleTextureNode : X3DTextureNode : SFNode textureProperties=TextureProperties!i, SFBool repeatS!i, SFBool repeatT!i
X3DTexture2DNode : X3DSingleTextureNode :
X3DTexture3DNode : X3DTextureNode : SFNode textureProperties=TextureProperties!i, SFBool repeatR!i, SFBool repeatS!i, SFBool repeatT!i
X3DTextureTransformNode : X3DNode :
X3DSingleTextureCoordinateNode : X3DNode : SFString mapping
X3DTouchSensorNode : X3DPointingDeviceSensorNode : SFVec3f hitNormal_changed!<, SFVec3f hitPoint_changed!<, SFVec2f hitTexCoord_changed!<, SFTime touchTime!<
X3DVertexAttributeNode : X3DNode : SFString name!i
X3DViewpointNode : X3DBindableNode : SFNode navigationInfo=NavigationInfo, SFString description, SFFloat farDistance, SFBool jump, SFFloat nearDistance, SFRotation orientation, SFBool retainUserOffsets, SFBool viewAll
X3DPickableObject : : MFNode addChildren=X3DChildNode!>, MFNode children=X3DChildNode, SFNode metadata=X3DMetadataObject, MFNode removeChildren=X3DChildNode!>, MFString objectType, SFBool pickable, SFBool visible
X3DLayerNode : X3DNode X3DPickableObject : SFNode viewport=X3DViewportNode
X3DViewportNode : X3DGroupingNode :
X3DLayoutNode : X3DChildNode :
X3DNBodyCollidableNode : X3DChildNode X3DBoundedObject : SFBool enabled, SFRotation rotation, SFVec3f translation
X3DNBodyCollisionSpaceNode : X3DNode X3DBoundedObject :
X3DRigidJointNode : X3DNode : SFNode body1=RigidBody, SFNode body2=RigidBody, MFString forceOutput
X3DPickSensorNode : X3DSensorNode : MFNode pickTarget=X3DGroupingNode|X3DShapeNode|Inline, MFNode pickedGeometry=X3DChildNode!<, SFNode pickingGeometry=X3DGeometryNode, SFString intersectionType!i, SFString matchCriterion, MFString objectType, SFString sortOrder!i
X3DFollowerNode : X3DChildNode : SFBool isActive!<
X3DChaserNode : X3DFollowerNode : SFTime duration!i
X3DDamperNode : X3DFollowerNode : SFInt32 order!i, SFTime tau, SFFloat tolerance
X3DParticleEmitterNode : X3DNode : SFFloat mass, SFBool on, SFFloat speed, SFFloat surfaceArea, SFFloat variation
X3DParticlePhysicsModelNode : X3DNode : SFBool enabled
X3DVolumeRenderStyleNode : X3DNode : SFBool enabled
X3DComposableVolumeRenderStyleNode : X3DVolumeRenderStyleNode :
X3DVolumeDataNode : X3DChildNode X3DBoundedObject : SFNode voxels=X3DTexture3DNode, SFVec3f dimensions
X3DTextureProjectorNode : X3DLightNode : SFNode texture=X3DTexture2DNode, SFFloat aspectRatio!<, SFString description, SFVec3f direction, SFFloat farDistance, SFVec3f location, SFFloat nearDistance
X3DOneSidedMaterialNode : X3DMaterialNode : SFNode emissiveTexture=X3DSingleTextureNode, SFNode normalTexture=X3DSingleTextureNode, SFString emissiveTextureMapping, SFFloat normalScale, SFString normalTextureMapping
)list";
}

}  // namespace cloudgen::check
