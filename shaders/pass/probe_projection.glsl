// Projection on the proxy of the first probe that counts at the pixel, in the order in which probes are asked; where none does, on
// the sky's, which is infinite. Hooks: those of pass/probe_tier.glsl.
#ifndef PASS_PROBE_PROJECTION_GLSL
#define PASS_PROBE_PROJECTION_GLSL

#include "pass/probe_tier.glsl"
#include "pass/projection.glsl"

// Its place in the block, or -1.
int findFirstProbe(PixelSurface surface, vec3 dirWS)
{
    int first = -1;
    int count = min(probeParams.settings.x, CROSSRAY_MAX_PROBES);
    for (int index = 0; index < count && first < 0; ++index) {
        float weight =
            computeProbeWeight(loadProbeInfluence(index), surface.positionWS, surface.normalWS, dirWS).weight;
        first = choose(weight > 0.0, index, -1);
    }
    return first;
}

// A tracing model of crossray/shared/outputs.glsl: shapes of proxies have the numbers of theirs.
int findProxyModel(PixelSurface surface, vec3 dirWS)
{
    int first = findFirstProbe(surface, dirWS);
    return first < 0 ? kTracingModelProxyInfinite : probeParams.items[first].kind.y;
}

PixelAnswer answerByProbeProxy(View view, PixelSurface surface, RefractionExit ray)
{
    int first = findFirstProbe(surface, ray.dirWS);
    ProxyHit hit = projectProxyInfinite(ray.positionWS, ray.dirWS);
    if (first >= 0) hit = projectProbeProxy(ray.positionWS, ray.dirWS, loadProbeProxy(first));
    return answerOfProxyHit(view, ray, hit);
}

#endif
