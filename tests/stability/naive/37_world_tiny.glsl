// Replaces: pass/projection.glsl answerByHiz
// Fails: the ray starts a centimetre on its way, so as not to hit its own surface; on a model of a few centimetres that is through the wall.
PixelAnswer answerByHiz(View view, RefractionExit ray)
{
    HizSettings settings =
        HizSettings(params.hizLimits.x, params.hizLimits.y, params.hizLimits.z, params.tracing.x);
    TraceResult result = traceHiz(view, ray.positionWS + ray.dirWS * 0.01, ray.dirWS, settings);
    return PixelAnswer(result.hitClass, result.reason, ray.positionWS, ray.dirWS, ray.pathLength, result.positionSS,
                       result.hitClass == kHitClassHit ? result.linearDepth : 0.0, result.iterations,
                       result.maxUsedLevel, result.intersectionKind,
                       result.hitClass == kHitClassHit ? 1.0 : 0.0);
}
