// The shapes of a probe's volumes, and the rule that binds two of them.
// Hooks: none. Source: Unity HDRP reflection probe documentation (2018).
#ifndef CROSSRAY_PROBE_SHAPES_GLSL
#define CROSSRAY_PROBE_SHAPES_GLSL

#include "crossray/shared/outputs.glsl"

// The numbers are those of the tracing model that a proxy of this shape gives.
const int kProbeShapeInfinite = kTracingModelProxyInfinite; // a proxy alone: no volume at all
const int kProbeShapeBox = kTracingModelProxyBox;
const int kProbeShapeSphere = kTracingModelProxySphere;

// True where a probe with this influence may have that proxy: the same shape, or no proxy volume. An influence is a box
// or a sphere; unknown numbers are refused.
bool acceptsProxyShape(int influenceShape, int proxyShape)
{
    bool isInfluence = influenceShape == kProbeShapeBox || influenceShape == kProbeShapeSphere;
    return isInfluence && (proxyShape == influenceShape || proxyShape == kProbeShapeInfinite);
}

#endif
