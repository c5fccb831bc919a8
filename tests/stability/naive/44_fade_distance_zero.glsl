// Replaces: crossray/hierarchy/screen_weight.glsl computeScreenRamp
// Fails: the inverse of a distance of 0 is sent as 0, and the weight is 0 on the whole screen.
float computeScreenRamp(float coordinate, float distance, int form)
{
    float inverseDistance = distance > 0.0 ? 1.0 / distance : 0.0;
    float inside = min(coordinate, 1.0 - coordinate);
    float ramp = clamp(inside * inverseDistance * (form == kScreenWeightSmoothToday ? 2.0 : 1.0), 0.0, 1.0);
    return form == kScreenWeightLinear ? ramp : ramp * ramp * (3.0 - 2.0 * ramp);
}
