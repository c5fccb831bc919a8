// Asks everything that a tracer may ask, of a scene whose answers are known: a mirror that faces the camera 4 m away. Confidence is
// the share of the answers that are right.
float right(bool isRight) { return isRight ? 1.0 : 0.0; }

bool isNear(float value, float expected) { return abs(value - expected) <= 1e-5 * max(1.0, abs(expected)); }

OwnHit traceOwn(OwnRay ray)
{
    vec2 centerSS = vec2(ray.pixel) + 0.5;
    float found = right(isNear(ownLinearDepth(ray.pixel), 4.0)); // read 1
    found += right(ownLinearDepth(ivec2(-1, 0)) >= kNoSurfaceDepth); // 2: outside the image
    found += right(ownHasSurface(ray.pixel)); // 3
    found += right(!ownHasSurface(ray.imageSize)); // 4
    found += right(isNear(distance(ownNormalWS(ray.pixel), vec3(0.0, 0.0, 1.0)), 0.0)); // 5
    found += right(ownLevelCount() == 5 && ownLevelSize(4) == ivec2(1) && ownLevelSize(1) == ivec2(8, 6));
    vec2 range = ownDepthRange(ivec2(0), 4); // 6
    found += right(isNear(range.x, 4.0) && isNear(range.y, 4.0));
    vec3 seenWS = ownPositionWS(centerSS, 4.0);
    found += right(isNear(distance(seenWS, ray.originWS), 0.0));
    ScreenPosition seen = ownProject(seenWS);
    found += right(isNear(distance(seen.positionSS, centerSS), 0.0) && seen.inFront && isNear(seen.linearDepth, 4.0));
    found += right(!ownProject(vec3(0.0, 0.0, 1.0)).inFront);
    OwnPath path = ownPath(ray);
    found += right(path.exists && isNear(distance(ownPathSS(path, 0.0), centerSS), 0.0));
    found += right(isNear(ownPathDepth(path, 0.0), 4.0) && path.endReason == kHitReasonOffScreen);
    vec2 endSS = ownPathSS(path, 1.0);
    vec2 fromBorder = min(abs(endSS), abs(endSS - vec2(ray.imageSize)));
    found += right(isNear(min(fromBorder.x, fromBorder.y), 0.0));
    found += right(isNear(ray.depthBias, 0.25) && ray.maxIterations == 7 && ray.imageSize == ivec2(16, 12));
    return OwnHit(kHitClassHit, kHitReasonNone, centerSS, 4.0, found / 14.0);
}
