// Visits every pixel that the ray crosses, border by border (Amanatides and Woo 1987). In a pixel the ray has a range of depths:
// where that meets the surface, which is depthBias thick, it is a hit. What lies under the plane on which the ray starts is left
// alone, since the ray runs above it.
OwnHit traceOwn(OwnRay ray)
{
    OwnPath path = ownPath(ray);
    if (!path.exists) return ownEnd(path.endReason, path.startSS);
    vec3 startNormalWS = ownNormalWS(ray.pixel);
    ivec2 pixel = ray.pixel;
    ivec2 toward = ivec2(sign(path.deltaSS));
    vec2 share = abs(1.0 / path.deltaSS); // of the way: a pixel along x, along y
    vec2 border = (vec2(pixel + max(toward, ivec2(0))) - path.startSS) / path.deltaSS; // where the ray crosses the next one
    float enter = 0.0;
    bool isHidden = false;
    for (int i = 0; i < ray.maxIterations && enter < 1.0; ++i) {
        float leave = min(min(border.x, border.y), 1.0);
        if (pixel != ray.pixel) {
            float surface = ownLinearDepth(pixel);
            float first = ownPathDepth(path, enter);
            float last = ownPathDepth(path, leave);
            vec3 seenWS = ownPositionWS(vec2(pixel) + 0.5, surface);
            bool isAbove = dot(seenWS - ray.originWS, startNormalWS) > 1e-4 * surface;
            bool isReached = max(first, last) >= surface && isAbove;
            bool isPassed = min(first, last) > surface + ray.depthBias;
            if (isReached && !isPassed) {
                float inside = first == last ? 0.0 : (1.0 / surface - 1.0 / first) / (1.0 / last - 1.0 / first);
                return ownHit(ownPathSS(path, mix(enter, leave, clamp(inside, 0.0, 1.0))), surface);
            }
            isHidden = isHidden || isPassed;
        }
        bool isAlongX = border.x < border.y;
        pixel += isAlongX ? ivec2(toward.x, 0) : ivec2(0, toward.y);
        border += isAlongX ? vec2(share.x, 0.0) : vec2(0.0, share.y);
        enter = leave;
    }
    if (enter < 1.0) return ownEnd(kHitReasonIterationCap, ownPathSS(path, enter));
    return ownEnd(isHidden ? kHitReasonBehindSurface : path.endReason, ownPathSS(path, 1.0));
}
