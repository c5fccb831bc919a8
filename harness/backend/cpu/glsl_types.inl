// GLSL's names for GLM's types in one precision, and the operators that GLM's templates cannot deduce from a swizzle
// (`v.xy / 2.0`). glsl.h includes this inside its namespace.

using uint = unsigned int;

using vec2 = glm::vec<2, float>;
using vec3 = glm::vec<3, float>;
using vec4 = glm::vec<4, float>;
using ivec2 = glm::vec<2, int>;
using ivec3 = glm::vec<3, int>;
using ivec4 = glm::vec<4, int>;
using uvec2 = glm::vec<2, uint>;
using uvec3 = glm::vec<3, uint>;
using uvec4 = glm::vec<4, uint>;
using bvec2 = glm::vec<2, bool>;
using bvec3 = glm::vec<3, bool>;
using bvec4 = glm::vec<4, bool>;
using mat3 = glm::mat<3, 3, float>;
using mat4 = glm::mat<4, 4, float>;

// GLM's operators deduce their arguments' type; these do not, so that a swizzle converts to its vector.
#define CROSSRAY_OPERATOR(V, S, op)                                                                                    \
    CROSSRAY_LAZY V operator op(const V& a, const V& b) { return glm::operator op(a, b); }                                    \
    CROSSRAY_LAZY V operator op(const V& a, S b) { return glm::operator op(a, b); }                                           \
    CROSSRAY_LAZY V operator op(S a, const V& b) { return glm::operator op(a, b); }
#define CROSSRAY_ARITHMETIC(V, S)                                                                                      \
    CROSSRAY_OPERATOR(V, S, +)                                                                                         \
    CROSSRAY_OPERATOR(V, S, -)                                                                                         \
    CROSSRAY_OPERATOR(V, S, *)                                                                                         \
    CROSSRAY_OPERATOR(V, S, /)
CROSSRAY_ARITHMETIC(vec2, float)
CROSSRAY_ARITHMETIC(vec3, float)
CROSSRAY_ARITHMETIC(vec4, float)
CROSSRAY_ARITHMETIC(ivec2, int)
CROSSRAY_ARITHMETIC(ivec3, int)
CROSSRAY_ARITHMETIC(ivec4, int)
CROSSRAY_ARITHMETIC(uvec2, uint)
CROSSRAY_ARITHMETIC(uvec3, uint)
CROSSRAY_ARITHMETIC(uvec4, uint)
#undef CROSSRAY_ARITHMETIC
#undef CROSSRAY_OPERATOR

#define CROSSRAY_VECTOR(V)                                                                                             \
    CROSSRAY_LAZY V operator-(const V& a) { return glm::operator-(a); }                                                       \
    CROSSRAY_LAZY bool operator==(const V& a, const V& b) { return glm::operator==(a, b); }                                   \
    CROSSRAY_LAZY bool operator!=(const V& a, const V& b) { return glm::operator!=(a, b); }
CROSSRAY_VECTOR(vec2)
CROSSRAY_VECTOR(vec3)
CROSSRAY_VECTOR(vec4)
CROSSRAY_VECTOR(ivec2)
CROSSRAY_VECTOR(ivec3)
CROSSRAY_VECTOR(ivec4)
#undef CROSSRAY_VECTOR

CROSSRAY_LAZY vec3 operator*(const mat3& m, const vec3& v) { return glm::operator*(m, v); }
CROSSRAY_LAZY vec3 operator*(const vec3& v, const mat3& m) { return glm::operator*(v, m); }
CROSSRAY_LAZY vec4 operator*(const mat4& m, const vec4& v) { return glm::operator*(m, v); }
CROSSRAY_LAZY vec4 operator*(const vec4& v, const mat4& m) { return glm::operator*(v, m); }
