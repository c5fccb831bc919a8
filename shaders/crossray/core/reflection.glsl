// The reflected ray's direction.
// Hooks: none. Source: the law of reflection.
#ifndef CROSSRAY_CORE_REFLECTION_GLSL
#define CROSSRAY_CORE_REFLECTION_GLSL

#include "crossray/core/math.glsl"

// Unit direction of the mirror ray about a normal; both inputs may have any length above 0, viewDirWS points to the
// eye. A normal that faces away from the eye (normal maps) reflects as the grazing one between the two would, so that
// the ray never enters the surface as seen: straight on. An input without direction gives the zero vector.
vec3 computeReflectionDirection(vec3 normalWS, vec3 viewDirWS)
{
    vec3 n = safeNormalize(normalWS, vec3(0.0));
    vec3 v = safeNormalize(viewDirWS, vec3(0.0));
    if (dot(n, n) < 0.5 || dot(v, v) < 0.5) return vec3(0.0);
    return safeNormalize(n * (2.0 * max(dot(n, v), 0.0)) - v, -v);
}

#endif
