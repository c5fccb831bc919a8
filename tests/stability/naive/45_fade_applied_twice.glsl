// Replaces: pass/pixel_color.glsl computeScreenColor
// Fails: the colour is faded here and the hierarchy fades it again, so that a dark frame stands where the next tier comes in.
ScreenColor computeScreenColor(View view, PixelSurface surface, PixelAnswer answer)
{
    if (answer.hitClass != kHitClassHit) return noScreenColor();
    float weight = computeScreenWeight(answer.positionSS / view.imageSize, params.tracing.y, kScreenWeightForm);
    ColorPlace place = chooseColorPlace(surface, answer);
    vec3 color = isOnScreen(view, place.positionSS) ? fetchColorAt(place.positionSS) : vec3(0.0, 0.0, 0.0);
    return ScreenColor(color * weight, weight, vec2(0.0, 0.0), 0.0);
}
