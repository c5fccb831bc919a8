// Replaces: crossray/probe/cubemap_filter.glsl fetchFoldedTexel
// Fails: texels beyond the edge are clamped to the face, which on coarse levels is all of it, and the faces show.
vec3 fetchFoldedTexel(int cubemap, int face, ivec2 texel, int level, int size)
{
    return fetchProbeTexel(cubemap, face, clamp(texel, ivec2(0), ivec2(size - 1)), level);
}
