// Replaces: pass/pixel_color.glsl chooseColorPlace
// Fails: the colour is read where the ray ended, also where that stands in front of the glass.
ColorPlace chooseColorPlace(PixelSurface surface, PixelAnswer answer)
{
    return ColorPlace(answer.positionSS, answer.linearDepth);
}
