// Replaces: crossray/probe/urp.glsl computeUrpSkyWeight
// Fails: from 0.99 on the sky gets nothing, and weights are scaled only where they exceed 1: the remainder is nobody's.
float computeUrpSkyWeight(float total, int profile)
{
    return total > kUrpFull ? 0.0 : 1.0 - total;
}
