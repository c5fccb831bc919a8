// The tier of planar probes: each has captured what its mirror plane shows to the camera, and answers where a reflection ends inside
// that image. They are asked before the standard probes. Hooks: fetchPlanarAtlas, and the blocks probeParams and planarParams.
#ifndef PASS_PLANAR_TIER_GLSL
#define PASS_PLANAR_TIER_GLSL

#include "crossray/hierarchy/weights.glsl"
#include "crossray/probe/influence.glsl"
#include "crossray/probe/parallax.glsl"
#include "crossray/probe/planar.glsl"
#include "crossray/probe/roughness.glsl"
#include "crossray/shared/planar_params.glsl"
#include "pass/pixel_surface.glsl"
#include "pass/probe_tier.glsl"

// What PlanarStatus says where no planar probe's influence reaches; the other values are those of crossray/probe/planar.glsl.
const int kPlanarNotAsked = 9;

MirrorPlane loadMirrorPlane(int planar)
{
    return MirrorPlane(planarParams.items[planar].pointWS.xyz, planarParams.items[planar].normalWS.xyz);
}

// The camera with the capture's own field of view, where it has one.
View loadCaptureView(View view, int planar)
{
    vec4 field = planarParams.items[planar].field;
    bool isOwn = field.z > 0.5;
    vec2 slope = choose(isOwn, computeCaptureSlope(field.x, field.y), view.slope);
    vec2 scale = vec2(safeDivide(1.0, slope.x, 0.0), safeDivide(1.0, slope.y, 0.0));
    View capture = view;
    capture.slope = slope;
    capture.clipFromView = mat4(vec4(scale.x, 0.0, 0.0, 0.0), vec4(0.0, scale.y, 0.0, 0.0), view.clipFromView[2],
                                view.clipFromView[3]);
    return capture;
}

vec3 fetchPlanarTexel(ivec4 image, ivec2 texel)
{
    ivec2 inside = clamp(texel, ivec2(0, 0), ivec2(image.y - 1, image.z - 1));
    return fetchPlanarAtlas(ivec2(inside.x, image.x + inside.y));
}

vec3 samplePlanarImage(int planar, vec2 positionUV)
{
    ivec4 image = planarParams.items[planar].image;
    vec2 at = positionUV * vec2(float(image.y), float(image.z));
    vec2 start = choose(image.w == 1, at - vec2(0.5), floor(at));
    vec2 part = start - floor(start);
    ivec2 first = ivec2(floor(start));
    vec3 above = mix(fetchPlanarTexel(image, first), fetchPlanarTexel(image, first + ivec2(1, 0)), part.x);
    vec3 below =
        mix(fetchPlanarTexel(image, first + ivec2(0, 1)), fetchPlanarTexel(image, first + ivec2(1, 1)), part.x);
    return mix(above, below, part.y);
}

// Where a planar probe's image shows the end of a ray. `item` is its place in probeParams, `planar` that in planarParams.
PlanarLookup findInPlanarImage(View view, int item, int planar, vec3 originWS, vec3 dirWS)
{
    MirrorPlane plane = loadMirrorPlane(planar);
    MirroredView mirrored = makeMirroredView(loadCaptureView(view, planar), plane);
    ObliqueProjection projection = makeObliqueProjection(mirrored.view, plane);
    ParallaxRay seen =
        computeParallax(originWS, dirWS, loadProbeProxy(item), probeParams.items[item].capturePositionWS.xyz);
    vec3 endWS = originWS + safeNormalize(dirWS, vec3(0.0)) * seen.distance;
    PlanarLookup found = lookUpPlanar(mirrored.view, projection.clipFromView, endWS, dirWS);
    int captured = choose(mirrored.status == kPlanarOk, projection.status, mirrored.status);
    bool isThere = captured == kPlanarOk;
    return PlanarLookup(choose(isThere, found.positionUV, vec2(0.0)), choose(isThere, found.weight, 0.0),
                        choose(isThere, found.status, captured));
}

struct PlanarTier {
    float hierarchyWeight; // of all tiers up to here
    float weight;          // of all planar probes
    vec3 color;            // what they show, each times its weight
    vec4 weights;          // what those of the case's first four probes got that are planar
    PlanarLookup first;    // of the first whose influence reaches the pixel
};

PlanarTier askPlanarProbes(View view, PixelSurface surface, vec3 originWS, vec3 dirWS, float hierarchyWeight)
{
    PlanarTier tier =
        PlanarTier(hierarchyWeight, 0.0, vec3(0.0), vec4(0.0), PlanarLookup(vec2(0.0), 0.0, kPlanarNotAsked));
    int count = min(planarParams.settings.x, CROSSRAY_MAX_PROBES);
    for (int planar = 0; planar < count; ++planar) {
        int item = planarParams.settings.y + planar;
        float influence =
            computeProbeWeight(loadProbeInfluence(item), surface.positionWS, surface.normalWS, dirWS).weight;
        if (influence > 0.0) {
            PlanarLookup found = findInPlanarImage(view, item, planar, originWS, dirWS);
            TierWeight added = addTier(tier.hierarchyWeight, influence * found.weight);
            vec3 color = multiplyProbeColor(samplePlanarImage(planar, found.positionUV),
                                            probeParams.items[item].influenceExtents.w);
            bool isFirst = tier.first.status == kPlanarNotAsked;
            PlanarLookup first =
                PlanarLookup(choose(isFirst, found.positionUV, tier.first.positionUV),
                             choose(isFirst, found.weight, tier.first.weight), choose(isFirst, found.status, tier.first.status));
            tier = PlanarTier(added.hierarchyWeight, tier.weight + added.weight, tier.color + color * added.weight,
                              tier.weights + weightOfProbe(probeParams.items[item].kind.z, added.weight), first);
        }
    }
    return tier;
}

#endif
