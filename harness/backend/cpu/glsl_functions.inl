// GLSL's built-in functions for glsl.h, which includes this inside its namespace: overloads over GLM's that deduce no
// type, so that `normalize(v.xyz)` converts its argument and `max(x, 0.0)` finds one type.

#define CROSSRAY_VECTORS(M, ...) M(vec2, __VA_ARGS__) M(vec3, __VA_ARGS__) M(vec4, __VA_ARGS__)
#define CROSSRAY_FLOATS(M, ...) M(float, __VA_ARGS__) CROSSRAY_VECTORS(M, __VA_ARGS__)
#define CROSSRAY_INTS(M, ...) M(int, __VA_ARGS__) M(ivec2, __VA_ARGS__) M(ivec3, __VA_ARGS__) M(ivec4, __VA_ARGS__)
#define CROSSRAY_UINTS(M, ...) M(uint, __VA_ARGS__) M(uvec2, __VA_ARGS__) M(uvec3, __VA_ARGS__) M(uvec4, __VA_ARGS__)

// One argument.
#define CROSSRAY_UNARY(T, f) CROSSRAY_LAZY T f(const T& x) { return glm::f(x); }
CROSSRAY_FLOATS(CROSSRAY_UNARY, radians)
CROSSRAY_FLOATS(CROSSRAY_UNARY, degrees)
CROSSRAY_FLOATS(CROSSRAY_UNARY, sin)
CROSSRAY_FLOATS(CROSSRAY_UNARY, cos)
CROSSRAY_FLOATS(CROSSRAY_UNARY, tan)
CROSSRAY_FLOATS(CROSSRAY_UNARY, asin)
CROSSRAY_FLOATS(CROSSRAY_UNARY, acos)
CROSSRAY_FLOATS(CROSSRAY_UNARY, atan)
CROSSRAY_FLOATS(CROSSRAY_UNARY, exp)
CROSSRAY_FLOATS(CROSSRAY_UNARY, log)
CROSSRAY_FLOATS(CROSSRAY_UNARY, exp2)
CROSSRAY_FLOATS(CROSSRAY_UNARY, log2)
CROSSRAY_FLOATS(CROSSRAY_UNARY, sqrt)
CROSSRAY_FLOATS(CROSSRAY_UNARY, inversesqrt)
CROSSRAY_FLOATS(CROSSRAY_UNARY, abs)
CROSSRAY_INTS(CROSSRAY_UNARY, abs)
CROSSRAY_FLOATS(CROSSRAY_UNARY, sign)
CROSSRAY_INTS(CROSSRAY_UNARY, sign)
CROSSRAY_FLOATS(CROSSRAY_UNARY, floor)
CROSSRAY_FLOATS(CROSSRAY_UNARY, ceil)
CROSSRAY_FLOATS(CROSSRAY_UNARY, trunc)
CROSSRAY_FLOATS(CROSSRAY_UNARY, round)
CROSSRAY_FLOATS(CROSSRAY_UNARY, roundEven)
CROSSRAY_FLOATS(CROSSRAY_UNARY, fract)
CROSSRAY_VECTORS(CROSSRAY_UNARY, normalize)
#undef CROSSRAY_UNARY

// Two arguments of one type. min and max by GLSL's formulas: a NaN takes the branch that the formula takes.
#define CROSSRAY_BINARY(T, f) CROSSRAY_LAZY T f(const T& x, const T& y) { return glm::f(x, y); }
CROSSRAY_FLOATS(CROSSRAY_BINARY, atan)
CROSSRAY_FLOATS(CROSSRAY_BINARY, pow)
CROSSRAY_FLOATS(CROSSRAY_BINARY, mod)
CROSSRAY_FLOATS(CROSSRAY_BINARY, min)
CROSSRAY_INTS(CROSSRAY_BINARY, min)
CROSSRAY_UINTS(CROSSRAY_BINARY, min)
CROSSRAY_FLOATS(CROSSRAY_BINARY, max)
CROSSRAY_INTS(CROSSRAY_BINARY, max)
CROSSRAY_UINTS(CROSSRAY_BINARY, max)
CROSSRAY_FLOATS(CROSSRAY_BINARY, step)
CROSSRAY_VECTORS(CROSSRAY_BINARY, reflect)
CROSSRAY_LAZY vec3 cross(const vec3& a, const vec3& b) { return glm::cross(a, b); }
#undef CROSSRAY_BINARY

// A vector and a scalar.
#define CROSSRAY_WITH_SCALAR(T, f, S) CROSSRAY_LAZY T f(const T& x, S y) { return glm::f(x, T(y)); }
CROSSRAY_VECTORS(CROSSRAY_WITH_SCALAR, mod, float)
CROSSRAY_VECTORS(CROSSRAY_WITH_SCALAR, min, float)
CROSSRAY_VECTORS(CROSSRAY_WITH_SCALAR, max, float)
#define CROSSRAY_WITH_INT(T, f, S) CROSSRAY_LAZY T f(const T& x, S y) { return glm::f(x, T(y)); }
CROSSRAY_WITH_INT(ivec2, min, int)
CROSSRAY_WITH_INT(ivec3, min, int)
CROSSRAY_WITH_INT(ivec4, min, int)
CROSSRAY_WITH_INT(ivec2, max, int)
CROSSRAY_WITH_INT(ivec3, max, int)
CROSSRAY_WITH_INT(ivec4, max, int)
#undef CROSSRAY_WITH_INT
#undef CROSSRAY_WITH_SCALAR
#define CROSSRAY_STEP(T, ...) CROSSRAY_LAZY T step(float edge, const T& x) { return glm::step(T(edge), x); }
CROSSRAY_VECTORS(CROSSRAY_STEP, )
#undef CROSSRAY_STEP

// Three arguments.
#define CROSSRAY_TERNARY(T, f) CROSSRAY_LAZY T f(const T& x, const T& y, const T& z) { return glm::f(x, y, z); }
CROSSRAY_FLOATS(CROSSRAY_TERNARY, clamp)
CROSSRAY_INTS(CROSSRAY_TERNARY, clamp)
CROSSRAY_UINTS(CROSSRAY_TERNARY, clamp)
CROSSRAY_FLOATS(CROSSRAY_TERNARY, mix)
CROSSRAY_FLOATS(CROSSRAY_TERNARY, smoothstep)
#undef CROSSRAY_TERNARY
#define CROSSRAY_SCALAR_ENDS(T, ...)                                                                                   \
    CROSSRAY_LAZY T clamp(const T& x, float low, float high) { return glm::clamp(x, T(low), T(high)); }                       \
    CROSSRAY_LAZY T smoothstep(float low, float high, const T& x) { return glm::smoothstep(T(low), T(high), x); }             \
    CROSSRAY_LAZY T mix(const T& x, const T& y, float a) { return glm::mix(x, y, T(a)); }                                     \
    CROSSRAY_LAZY T refract(const T& i, const T& n, float eta) { return glm::refract(i, n, eta); }                            \
    CROSSRAY_LAZY T faceforward(const T& n, const T& i, const T& nRef) { return glm::faceforward(n, i, nRef); }
CROSSRAY_VECTORS(CROSSRAY_SCALAR_ENDS, )
#undef CROSSRAY_SCALAR_ENDS
CROSSRAY_LAZY ivec2 clamp(const ivec2& x, int low, int high) { return glm::clamp(x, low, high); }
CROSSRAY_LAZY ivec3 clamp(const ivec3& x, int low, int high) { return glm::clamp(x, low, high); }
CROSSRAY_LAZY float mix(float x, float y, bool a) { return a ? y : x; }
CROSSRAY_LAZY int mix(int x, int y, bool a) { return a ? y : x; }
CROSSRAY_LAZY uint mix(uint x, uint y, bool a) { return a ? y : x; }
CROSSRAY_LAZY vec2 mix(const vec2& x, const vec2& y, const bvec2& a) { return glm::mix(x, y, a); }
CROSSRAY_LAZY vec3 mix(const vec3& x, const vec3& y, const bvec3& a) { return glm::mix(x, y, a); }
CROSSRAY_LAZY vec4 mix(const vec4& x, const vec4& y, const bvec4& a) { return glm::mix(x, y, a); }
CROSSRAY_LAZY float fma(float a, float b, float c) { return std::fma(a, b, c); }

// Vectors to scalars.
#define CROSSRAY_TO_SCALAR(T, ...)                                                                                     \
    CROSSRAY_LAZY float dot(const T& x, const T& y) { return glm::dot(x, y); }                                                \
    CROSSRAY_LAZY float length(const T& x) { return glm::length(x); }                                                         \
    CROSSRAY_LAZY float distance(const T& x, const T& y) { return glm::distance(x, y); }
CROSSRAY_VECTORS(CROSSRAY_TO_SCALAR, )
#undef CROSSRAY_TO_SCALAR
CROSSRAY_LAZY float dot(float x, float y) { return x * y; }

// Comparisons.
#define CROSSRAY_COMPARE(T, B, f) CROSSRAY_LAZY B f(const T& x, const T& y) { return glm::f(x, y); }
#define CROSSRAY_COMPARISON(f)                                                                                         \
    CROSSRAY_COMPARE(vec2, bvec2, f) CROSSRAY_COMPARE(vec3, bvec3, f) CROSSRAY_COMPARE(vec4, bvec4, f)                 \
    CROSSRAY_COMPARE(ivec2, bvec2, f) CROSSRAY_COMPARE(ivec3, bvec3, f) CROSSRAY_COMPARE(ivec4, bvec4, f)
CROSSRAY_COMPARISON(lessThan)
CROSSRAY_COMPARISON(lessThanEqual)
CROSSRAY_COMPARISON(greaterThan)
CROSSRAY_COMPARISON(greaterThanEqual)
CROSSRAY_COMPARISON(equal)
CROSSRAY_COMPARISON(notEqual)
#undef CROSSRAY_COMPARISON
#undef CROSSRAY_COMPARE
CROSSRAY_LAZY bool any(const bvec2& v) { return glm::any(v); }
CROSSRAY_LAZY bool any(const bvec3& v) { return glm::any(v); }
CROSSRAY_LAZY bool any(const bvec4& v) { return glm::any(v); }
CROSSRAY_LAZY bool all(const bvec2& v) { return glm::all(v); }
CROSSRAY_LAZY bool all(const bvec3& v) { return glm::all(v); }
CROSSRAY_LAZY bool all(const bvec4& v) { return glm::all(v); }
CROSSRAY_LAZY bool isnan(float x) { return std::isnan(x); }
CROSSRAY_LAZY bool isinf(float x) { return std::isinf(x); }
CROSSRAY_LAZY bvec2 isnan(const vec2& v) { return glm::isnan(v); }
CROSSRAY_LAZY bvec3 isnan(const vec3& v) { return glm::isnan(v); }
CROSSRAY_LAZY bvec4 isnan(const vec4& v) { return glm::isnan(v); }
CROSSRAY_LAZY bvec2 isinf(const vec2& v) { return glm::isinf(v); }
CROSSRAY_LAZY bvec3 isinf(const vec3& v) { return glm::isinf(v); }
CROSSRAY_LAZY bvec4 isinf(const vec4& v) { return glm::isinf(v); }

// Bits.
CROSSRAY_LAZY int bitCount(uint x) { return std::popcount(x); }
CROSSRAY_LAZY int bitCount(int x) { return std::popcount(static_cast<uint>(x)); }
CROSSRAY_LAZY int findMSB(uint x) { return glm::findMSB(x); }
CROSSRAY_LAZY int findLSB(uint x) { return glm::findLSB(x); }
#if CROSSRAY_GLSL_PRECISION == 32
CROSSRAY_LAZY int floatBitsToInt(float x) { return glm::floatBitsToInt(x); }
CROSSRAY_LAZY uint floatBitsToUint(float x) { return glm::floatBitsToUint(x); }
CROSSRAY_LAZY float intBitsToFloat(int x) { return glm::intBitsToFloat(x); }
CROSSRAY_LAZY float uintBitsToFloat(uint x) { return glm::uintBitsToFloat(x); }
#endif

// Matrices.
CROSSRAY_LAZY mat3 transpose(const mat3& m) { return glm::transpose(m); }
CROSSRAY_LAZY mat4 transpose(const mat4& m) { return glm::transpose(m); }
CROSSRAY_LAZY mat3 inverse(const mat3& m) { return glm::inverse(m); }
CROSSRAY_LAZY mat4 inverse(const mat4& m) { return glm::inverse(m); }
CROSSRAY_LAZY float determinant(const mat3& m) { return glm::determinant(m); }
CROSSRAY_LAZY float determinant(const mat4& m) { return glm::determinant(m); }

#undef CROSSRAY_VECTORS
#undef CROSSRAY_FLOATS
#undef CROSSRAY_INTS
#undef CROSSRAY_UINTS
