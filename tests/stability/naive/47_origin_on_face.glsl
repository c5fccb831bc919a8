// Replaces: crossray/project/proxy.glsl intersectSlab
// Fails: in a face, 0 times the infinite inverse of 0 is NaN, and it decides the smallest of the distances.
vec2 intersectSlab(float origin, float dir, float extent)
{
    float inverse = 1.0 / dir;
    float a = (-extent - origin) * inverse;
    float b = (extent - origin) * inverse;
    return vec2(min(a, b), max(a, b));
}
