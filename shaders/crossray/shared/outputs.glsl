// The numbers that shaders and harness share: what a shader can write, how a ray can end, and why.
// Hooks: none. Source: harness/base/outputs.h, which a test holds against this file.
#ifndef CROSSRAY_SHARED_OUTPUTS_GLSL
#define CROSSRAY_SHARED_OUTPUTS_GLSL

// Output ids.
const int kOutputColor = 0;
const int kOutputRayDirWS = 1;
const int kOutputHitDepth = 2;
const int kOutputHitSuccess = 3;
const int kOutputHitReason = 4;
const int kOutputTracingModel = 5;
const int kOutputPositionNDC = 6;
const int kOutputRayDirNDC = 7;
const int kOutputIterationCount = 8;
const int kOutputMaxUsedMipLevel = 9;
const int kOutputIntersectionKind = 10;
const int kOutputHitWeight = 11;
const int kOutputSampledColor = 12;
const int kOutputHitPositionSS = 13;
const int kOutputPathLength = 14;
const int kOutputRayOriginWS = 15;
const int kOutputTierWeights = 16;
const int kOutputProbeWeights = 17;
const int kOutputProbeDirWS = 18;
const int kOutputProbeMipLevel = 19;
const int kOutputConfidence = 20;
const int kOutputPlanarUV = 21;
const int kOutputPlanarStatus = 22;
const int kOutputTransmittance = 23;
const int kOutputColorMipLevel = 24;
const int kOutputHistoryUV = 25;
const int kOutputFetchCount = 26;
const int kOutputCount = 27;

// Hit classes: the values of HitSuccess.
const int kHitClassNoRaycast = 0;
const int kHitClassHit = 1;
const int kHitClassMiss = 2;
const int kHitClassUnknown = 3; // the screen cannot know

// Hit reasons: the values of HitReason. None comes with a hit or with no ray asked for.
const int kHitReasonNone = 0;
const int kHitReasonIterationCap = 1;     // unknown: the march was cut short
const int kHitReasonOffScreen = 2;        // unknown: the ray left the image
const int kHitReasonBehindSurface = 3;    // unknown: the ray left the image while a surface hid it
const int kHitReasonNearPlane = 4;        // unknown: the ray passed the near plane towards the eye
const int kHitReasonBehindCamera = 5;     // miss: the hit is not in front of the camera
const int kHitReasonNoProxyHit = 6;       // miss: the ray does not meet the proxy
const int kHitReasonSky = 7;              // miss: the ray ran out of the scene (beyond the far plane)
const int kHitReasonNoRefractedRay = 8;   // no raycast: total internal reflection
const int kHitReasonDegenerateRay = 9;    // no raycast: zero, NaN or infinite origin or direction
const int kHitReasonDegenerateInput = 10; // no raycast: a parameter without meaning (index of refraction, thickness)
const int kHitReasonCount = 11;

// Tracing models: the values of TracingModel.
const int kTracingModelNone = 0;
const int kTracingModelProxyInfinite = 1;
const int kTracingModelProxyBox = 2;
const int kTracingModelProxySphere = 3;
const int kTracingModelHiz = 4;
const int kTracingModelLinear = 5;
const int kTracingModelPatches = 6;
const int kTracingModelProxyProbe = 7; // asked for; a pixel's model is that of the proxy which it found
const int kTracingModelOwn = 8;        // a person's own tracer

// Intersection kinds: the values of IntersectionKind.
const int kIntersectionNone = 0;  // the ray crossed the cell without meeting anything
const int kIntersectionCell = 1;  // the ray may meet something in this cell: look finer
const int kIntersectionDepth = 2; // the ray met the depth of this cell

// Refraction models.
const int kRefractionNone = 0;
const int kRefractionSphere = 1;
const int kRefractionBox = 2;
const int kRefractionThin = 3;

// What a refracting surface reflects.
const int kFresnelNone = 0;
const int kFresnelExact = 1;
const int kFresnelSchlick = 2;

// Forms of the screen weight.
const int kScreenWeightLinear = 0;
const int kScreenWeightSmooth2018 = 1;
const int kScreenWeightSmoothToday = 2;

#endif
