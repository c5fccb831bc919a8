// GLM as GLSL: with swizzle members, in a namespace of its own. Most of the time that a unit of the shader library takes to
// compile goes here, so the tests have it precompiled.
#pragma once

// Swizzle members and what they need change GLM's classes, so this GLM lives in a namespace of its own: two forms of one
// class in one program would break the one-definition rule.
#ifdef GLM_VERSION
#error "include harness/backend/cpu/glsl.h before anything that includes GLM"
#endif
#define GLM_FORCE_INTRINSICS // GLM offers swizzle members only with it; vectors stay plain scalars in a row
#define GLM_FORCE_SWIZZLE
#define glm crossray_glm
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#include <glm/glm.hpp>
#pragma GCC diagnostic pop

// Makes the classes here, with all their swizzles, and not in each unit that uses a vector.
static_assert(sizeof(glm::vec2) + sizeof(glm::vec3) + sizeof(glm::vec4) == 9 * sizeof(float));
static_assert(sizeof(glm::dvec2) + sizeof(glm::dvec3) + sizeof(glm::dvec4) == 9 * sizeof(double));
static_assert(sizeof(glm::ivec2) + sizeof(glm::ivec3) + sizeof(glm::ivec4) == 9 * sizeof(int));
