// Replaces: pass/projection.glsl answerByLinear
// Fails: "it leaves the image some time" is the only bound, and the driver stops the loop before.
PixelAnswer answerByLinear(View view, RefractionExit ray)
{
    LinearSettings settings = LinearSettings(params.linearTracing.x, params.linearLimits.x, 1 << 30,
                                             params.linearTracing.y, params.linearLimits.z);
    LinearResult result = traceLinear(view, ray.positionWS, ray.dirWS, settings);
    return PixelAnswer(result.hitClass, result.reason, ray.positionWS, ray.dirWS, ray.pathLength, result.positionSS,
                       result.hitClass == kHitClassHit ? result.linearDepth : 0.0, result.iterations, 0,
                       result.intersectionKind, result.hitClass == kHitClassHit ? 1.0 : 0.0);
}
