// Replaces: pass/probe_projection.glsl findFirstProbe
// Fails: the first probe of the list is taken for all pixels, also beyond the border of its influence.
int findFirstProbe(PixelSurface surface, vec3 dirWS)
{
    return probeParams.settings.x > 0 ? 0 : -1;
}
