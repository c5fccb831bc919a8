// Replaces: crossray/probe/box_projection.glsl computeBoxProjectionDivision
// Fails: a component of +0 picks the face at the minimum, minus infinity away, and that is the smallest distance.
BoxProjection computeBoxProjectionDivision(vec3 positionWS, vec3 dirWS, ProbeBox box)
{
    vec3 toMax = (box.maxWS - positionWS) / dirWS;
    vec3 toMin = (box.minWS - positionWS) / dirWS;
    vec3 ahead = vec3(dirWS.x > 0.0 ? toMax.x : toMin.x, dirWS.y > 0.0 ? toMax.y : toMin.y,
                      dirWS.z > 0.0 ? toMax.z : toMin.z);
    float distance = min(min(ahead.x, ahead.y), ahead.z);
    return BoxProjection(normalize(positionWS + dirWS * distance - box.capturePositionWS.xyz), distance, true);
}
