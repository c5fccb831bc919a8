// Planar probes: the mirrored camera that captures what a plane reflects, and the look-up in its image.
// Hooks: none. Source: Unity HDRP planar reflection probe documentation (2018); oblique near plane: Lengyel 2005,
// written here for depths stored in [0,1], standard, reversed, and with an infinite far plane.
//
// The mirrored camera is the camera's own, seen through the plane: no up vector is needed, so that a camera that looks
// along the normal is like any other. Its handedness is reversed. Answers to the borders:
// - a camera on the plane (to 1e-4 m) or behind it: kPlanarCameraNotInFront; a plane without normal, or not finite:
//   kPlanarDegeneratePlane; a field of view that is not above 0 and below 180 degrees: kPlanarNoFieldOfView. The view
//   comes back as it was;
// - an oblique plane that the view volume never meets (the camera looks away from it): kPlanarPlaneOutOfView; the
//   projection stays;
// - an image of depths under an oblique projection holds no linear ones: linearDepthFromOblique gives them back, and
//   the far distance where nothing was drawn.
#ifndef CROSSRAY_PROBE_PLANAR_GLSL
#define CROSSRAY_PROBE_PLANAR_GLSL

#include "crossray/core/math.glsl"
#include "crossray/core/view.glsl"

const int kPlanarOk = 0;
const int kPlanarCameraNotInFront = 1;
const int kPlanarDegeneratePlane = 2;
const int kPlanarNoFieldOfView = 3;
const int kPlanarPlaneOutOfView = 4;
// Why a look-up has weight 0.
const int kPlanarOutsideImage = 5;
const int kPlanarBehindNearPlane = 6;
const int kPlanarOpposed = 7; // the capture looks the other way than the reflection
const int kPlanarDegenerateRay = 8;

const float kPlanarSmallestDistance = 1e-4; // metres from camera to plane

struct MirrorPlane {
    vec3 pointWS;
    vec3 normalWS; // any length; the mirror is seen from its side
};

struct MirroredView {
    View view;
    int status; // kPlanarOk, or why the view is the given one
};

struct ObliqueProjection {
    mat4 clipFromView;
    int status;
};

struct PlanarLookup {
    vec2 positionUV; // [0,1], v down; 0 at weight 0
    float weight;    // 0 or 1
    int status;
};

// The mirror image of all of space about the plane; the unit matrix where the plane has no normal.
mat4 makeReflectionMatrix(MirrorPlane plane)
{
    vec3 n = safeNormalize(plane.normalWS, vec3(0.0));
    vec3 point = isFinite(plane.pointWS) ? plane.pointWS : vec3(0.0);
    vec3 shift = n * (2.0 * dot(n, point));
    return mat4(vec4(vec3(1.0, 0.0, 0.0) - n * (2.0 * n.x), 0.0), vec4(vec3(0.0, 1.0, 0.0) - n * (2.0 * n.y), 0.0),
                vec4(vec3(0.0, 0.0, 1.0) - n * (2.0 * n.z), 0.0), vec4(shift, 1.0));
}

// The view that captures what the plane shows to `view`.
MirroredView makeMirroredView(View view, MirrorPlane plane)
{
    if (!hasDirection(plane.normalWS) || !isFinite(plane.pointWS)) return MirroredView(view, kPlanarDegeneratePlane);
    bool hasField = view.slope.x > 0.0 && view.slope.y > 0.0 && isFinite(view.slope);
    if (!hasField) return MirroredView(view, kPlanarNoFieldOfView);
    vec3 n = safeNormalize(plane.normalWS, vec3(0.0));
    bool inFront = dot(view.worldFromView[3].xyz - plane.pointWS, n) > kPlanarSmallestDistance;
    if (!inFront) return MirroredView(view, kPlanarCameraNotInFront);
    mat4 reflection = makeReflectionMatrix(plane);
    View mirrored = view;
    mirrored.viewFromWorld = view.viewFromWorld * reflection;
    mirrored.worldFromView = reflection * view.worldFromView;
    return MirroredView(mirrored, kPlanarOk);
}

// The field of view's slope (View.slope) for a full vertical angle in radians and width over height: the override that
// a probe may set. 0 where there is no field of view.
vec2 computeCaptureSlope(float verticalFov, float aspect)
{
    bool isField = verticalFov > 0.0 && verticalFov < kPi && aspect > 0.0 && isFinite(aspect);
    float slope = isField ? tan(0.5 * verticalFov) : 0.0;
    return isField && isFinite(slope) ? vec2(slope * aspect, slope) : vec2(0.0);
}

// The row of the projection matrix that gives clip z: what maps (positionVS, 1) to z before the division by w.
vec4 depthRow(mat4 clipFromView)
{
    return vec4(clipFromView[0].z, clipFromView[1].z, clipFromView[2].z, clipFromView[3].z);
}

mat4 withDepthRow(mat4 clipFromView, vec4 row)
{
    return mat4(vec4(clipFromView[0].xy, row.x, clipFromView[0].w), vec4(clipFromView[1].xy, row.y, clipFromView[1].w),
                vec4(clipFromView[2].xy, row.z, clipFromView[2].w), vec4(clipFromView[3].xy, row.w, clipFromView[3].w));
}

// The mirrored view's projection with its near plane on the mirror, so that nothing behind the mirror is captured. The
// far plane turns with it: it passes through the corner of the view volume that is farthest from the mirror.
ObliqueProjection makeObliqueProjection(View mirroredView, MirrorPlane plane)
{
    mat4 clip = mirroredView.clipFromView;
    if (!hasDirection(plane.normalWS) || !isFinite(plane.pointWS))
        return ObliqueProjection(clip, kPlanarDegeneratePlane);
    // In view space: dot(plane, (p, 1)) is the distance in front of the mirror.
    vec3 nWS = safeNormalize(plane.normalWS, vec3(0.0)); // before the turn, which may make the shortest too short
    vec3 nVS = directionVSFromWS(mirroredView, nWS);
    vec3 pointVS = positionVSFromWS(mirroredView, plane.pointWS);
    vec4 planeVS = vec4(nVS, -dot(nVS, pointVS));
    bool isBehind = planeVS.w < -kPlanarSmallestDistance; // where the eye of a mirrored camera is
    if (!isBehind) return ObliqueProjection(clip, kPlanarCameraNotInFront);
    // The far corner on the mirror's front side, as a homogeneous point: at infinity where the far plane is.
    vec2 side = vec2(nVS.x < 0.0 ? -1.0 : 1.0, nVS.y < 0.0 ? -1.0 : 1.0) * mirroredView.slope;
    bool isEndless = mirroredView.farDistance >= kFarAway;
    float inverseFar = isEndless ? 0.0 : 1.0 / mirroredView.farDistance;
    vec4 corner = mirroredView.orthographic ? vec4(side, -mirroredView.farDistance, 1.0) : vec4(side, -1.0, inverseFar);
    float reach = dot(planeVS, corner);
    bool isSeen = reach > 1e-12;
    if (!isSeen) return ObliqueProjection(clip, kPlanarPlaneOutOfView);
    vec4 scaled = planeVS / reach; // the corner has clip w 1, in both kinds of projection
    vec4 rowW = mirroredView.orthographic ? vec4(0.0, 0.0, 0.0, 1.0) : vec4(0.0, 0.0, -1.0, 0.0);
    vec4 row = mirroredView.reversedDepth ? rowW - scaled : scaled;
    return ObliqueProjection(withDepthRow(clip, row), kPlanarOk);
}

// Metres along the view axis for a depth stored under an oblique projection, at a position in NDC. In (0, farDistance];
// farDistance for cleared, NaN and impossible values.
float linearDepthFromOblique(View mirroredView, mat4 obliqueClipFromView, vec2 positionNDC, float deviceDepth)
{
    vec4 row = depthRow(obliqueClipFromView);
    vec2 offset = positionNDC * mirroredView.slope;
    float across = row.x * offset.x + row.y * offset.y;
    float fromPerspective = safeDivide(row.w, deviceDepth - (across - row.z), mirroredView.farDistance);
    float fromOrthographic = safeDivide(across + row.w - deviceDepth, row.z, mirroredView.farDistance);
    float linearDepth = mirroredView.orthographic ? fromOrthographic : fromPerspective;
    bool isSurface = linearDepth > 0.0 && !isClearedDepth(mirroredView, deviceDepth);
    return isSurface ? min(linearDepth, mirroredView.farDistance) : mirroredView.farDistance;
}

// Where the capture shows a world position, for a reflection in that direction. `clipFromView` is the capture's,
// oblique or not. Weight 0: not in front of the capture's eye or of its near plane, outside its image (borders belong
// to it), a capture whose forward axis opposes the reflection (a right angle does not), or a degenerate input. The far
// plane is no bound: an oblique one is nowhere in particular.
PlanarLookup lookUpPlanar(View capture, mat4 clipFromView, vec3 positionWS, vec3 reflectionDirWS)
{
    if (!hasDirection(reflectionDirWS) || !isFinite(positionWS))
        return PlanarLookup(vec2(0.0), 0.0, kPlanarDegenerateRay);
    vec3 forwardWS = -capture.worldFromView[2].xyz;
    if (dot(safeNormalize(reflectionDirWS, vec3(0.0)), forwardWS) < 0.0) {
        return PlanarLookup(vec2(0.0), 0.0, kPlanarOpposed);
    }
    vec4 clip = clipFromView * vec4(positionVSFromWS(capture, positionWS), 1.0);
    float beyondNear = capture.reversedDepth ? clip.w - clip.z : clip.z;
    bool inFront = clip.w > 0.0 && beyondNear >= 0.0;
    if (!inFront) return PlanarLookup(vec2(0.0), 0.0, kPlanarBehindNearPlane);
    vec2 positionUV = vec2(0.5) + vec2(0.5, -0.5) * clip.xy / clip.w;
    bool inImage = positionUV.x >= 0.0 && positionUV.x <= 1.0 && positionUV.y >= 0.0 && positionUV.y <= 1.0;
    if (!inImage) return PlanarLookup(vec2(0.0), 0.0, kPlanarOutsideImage);
    return PlanarLookup(positionUV, 1.0, kPlanarOk);
}

// The cosine between the mirror's normal and a surface's: 1 where the probe can show what the surface reflects, and
// what a diagnosis asks. 0 where either has no direction.
float computeMirrorAlignment(MirrorPlane plane, vec3 surfaceNormalWS)
{
    return dot(safeNormalize(plane.normalWS, vec3(0.0)), safeNormalize(surfaceNormalWS, vec3(0.0)));
}

#endif
