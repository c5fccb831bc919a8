// GLSL's built-in functions for glsl.h, which includes this inside its namespace: GLSL 4.50 chapter 8, by its formulas
// where it gives one (min, max, clamp, step: so that a NaN takes the branch that the formula takes).

// Scalars.
inline float radians(float x)
{
    return x * 0.017453292519943295;
}
inline float degrees(float x)
{
    return x * 57.29577951308232;
}
inline float sin(float x)
{
    return std::sin(x);
}
inline float cos(float x)
{
    return std::cos(x);
}
inline float tan(float x)
{
    return std::tan(x);
}
inline float asin(float x)
{
    return std::asin(x);
}
inline float acos(float x)
{
    return std::acos(x);
}
inline float atan(float x)
{
    return std::atan(x);
}
inline float atan(float y, float x)
{
    return std::atan2(y, x);
}
inline float exp(float x)
{
    return std::exp(x);
}
inline float log(float x)
{
    return std::log(x);
}
inline float exp2(float x)
{
    return std::exp2(x);
}
inline float log2(float x)
{
    return std::log2(x);
}
inline float sqrt(float x)
{
    return std::sqrt(x);
}
inline float inversesqrt(float x)
{
    return 1.0 / std::sqrt(x);
}
inline float abs(float x)
{
    return std::fabs(x);
}
inline int abs(int x)
{
    return x < 0 ? -x : x;
}
inline float sign(float x)
{
    return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}
inline int sign(int x)
{
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}
inline float floor(float x)
{
    return std::floor(x);
}
inline float ceil(float x)
{
    return std::ceil(x);
}
inline float trunc(float x)
{
    return std::trunc(x);
}
inline float round(float x)
{
    return std::round(x);
}
inline float roundEven(float x)
{
    return std::nearbyint(x);
}
inline float fract(float x)
{
    return x - std::floor(x);
}
inline float pow(float x, float y)
{
    return std::pow(x, y);
}
inline float mod(float x, float y)
{
    return x - y * std::floor(x / y);
}
inline float min(float x, float y)
{
    return y < x ? y : x;
}
inline int min(int x, int y)
{
    return y < x ? y : x;
}
inline uint min(uint x, uint y)
{
    return y < x ? y : x;
}
inline float max(float x, float y)
{
    return x < y ? y : x;
}
inline int max(int x, int y)
{
    return x < y ? y : x;
}
inline uint max(uint x, uint y)
{
    return x < y ? y : x;
}
inline float clamp(float x, float lo, float hi)
{
    return min(max(x, lo), hi);
}
inline int clamp(int x, int lo, int hi)
{
    return min(max(x, lo), hi);
}
inline uint clamp(uint x, uint lo, uint hi)
{
    return min(max(x, lo), hi);
}
inline float mix(float x, float y, float a)
{
    return x * (1.0 - a) + y * a;
}
inline float mix(float x, float y, bool a)
{
    return a ? y : x;
}
inline int mix(int x, int y, bool a)
{
    return a ? y : x;
}
inline uint mix(uint x, uint y, bool a)
{
    return a ? y : x;
}
inline float step(float edge, float x)
{
    return x < edge ? 0.0 : 1.0;
}
inline float smoothstep(float edge0, float edge1, float x)
{
    float t = clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
inline float fma(float a, float b, float c)
{
    return std::fma(a, b, c);
}
inline bool isnan(float x)
{
    return std::isnan(x);
}
inline bool isinf(float x)
{
    return std::isinf(x);
}
inline int bitCount(uint x)
{
    return std::popcount(x);
}
inline int bitCount(int x)
{
    return std::popcount(static_cast<uint>(x));
}
inline int findMSB(uint x)
{
    return 31 - std::countl_zero(x);
}
inline int findLSB(uint x)
{
    return x == 0u ? -1 : std::countr_zero(x);
}
#if CROSSRAY_GLSL_PRECISION == 32
inline int floatBitsToInt(float x)
{
    return std::bit_cast<int>(x);
}
inline uint floatBitsToUint(float x)
{
    return std::bit_cast<uint>(x);
}
inline float intBitsToFloat(int x)
{
    return std::bit_cast<float>(x);
}
inline float uintBitsToFloat(uint x)
{
    return std::bit_cast<float>(x);
}
#endif

// The same on each component: f(T), f(T, T), f(T, scalar) and so on; R is the family of the result.
#define CROSSRAY_MAP_1(R, f, V)                                                                                        \
    inline R##2 f(const V##2 & a)                                                                                      \
    {                                                                                                                  \
        return R##2(f(a.x), f(a.y));                                                                                   \
    }                                                                                                                  \
    inline R##3 f(const V##3 & a)                                                                                      \
    {                                                                                                                  \
        return R##3(f(a.x), f(a.y), f(a.z));                                                                           \
    }                                                                                                                  \
    inline R##4 f(const V##4 & a)                                                                                      \
    {                                                                                                                  \
        return R##4(f(a.x), f(a.y), f(a.z), f(a.w));                                                                   \
    }
#define CROSSRAY_MAP_2(f, V)                                                                                           \
    inline V##2 f(const V##2 & a, const V##2 & b)                                                                      \
    {                                                                                                                  \
        return V##2(f(a.x, b.x), f(a.y, b.y));                                                                         \
    }                                                                                                                  \
    inline V##3 f(const V##3 & a, const V##3 & b)                                                                      \
    {                                                                                                                  \
        return V##3(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z));                                                            \
    }                                                                                                                  \
    inline V##4 f(const V##4 & a, const V##4 & b)                                                                      \
    {                                                                                                                  \
        return V##4(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z), f(a.w, b.w));                                               \
    }
#define CROSSRAY_MAP_2_SCALAR(f, V, S)                                                                                 \
    CROSSRAY_MAP_2(f, V)                                                                                               \
    inline V##2 f(const V##2 & a, S b)                                                                                 \
    {                                                                                                                  \
        return f(a, V##2(b));                                                                                          \
    }                                                                                                                  \
    inline V##3 f(const V##3 & a, S b)                                                                                 \
    {                                                                                                                  \
        return f(a, V##3(b));                                                                                          \
    }                                                                                                                  \
    inline V##4 f(const V##4 & a, S b)                                                                                 \
    {                                                                                                                  \
        return f(a, V##4(b));                                                                                          \
    }
#define CROSSRAY_MAP_3(f, V, C)                                                                                        \
    inline V##2 f(const V##2 & a, const V##2 & b, const C##2 & c)                                                      \
    {                                                                                                                  \
        return V##2(f(a.x, b.x, c.x), f(a.y, b.y, c.y));                                                               \
    }                                                                                                                  \
    inline V##3 f(const V##3 & a, const V##3 & b, const C##3 & c)                                                      \
    {                                                                                                                  \
        return V##3(f(a.x, b.x, c.x), f(a.y, b.y, c.y), f(a.z, b.z, c.z));                                             \
    }                                                                                                                  \
    inline V##4 f(const V##4 & a, const V##4 & b, const C##4 & c)                                                      \
    {                                                                                                                  \
        return V##4(f(a.x, b.x, c.x), f(a.y, b.y, c.y), f(a.z, b.z, c.z), f(a.w, b.w, c.w));                           \
    }
#define CROSSRAY_CLAMP_SCALAR(V, S)                                                                                    \
    inline V##2 clamp(const V##2 & a, S lo, S hi)                                                                      \
    {                                                                                                                  \
        return clamp(a, V##2(lo), V##2(hi));                                                                           \
    }                                                                                                                  \
    inline V##3 clamp(const V##3 & a, S lo, S hi)                                                                      \
    {                                                                                                                  \
        return clamp(a, V##3(lo), V##3(hi));                                                                           \
    }                                                                                                                  \
    inline V##4 clamp(const V##4 & a, S lo, S hi)                                                                      \
    {                                                                                                                  \
        return clamp(a, V##4(lo), V##4(hi));                                                                           \
    }

CROSSRAY_MAP_1(vec, radians, vec)
CROSSRAY_MAP_1(vec, degrees, vec)
CROSSRAY_MAP_1(vec, sin, vec)
CROSSRAY_MAP_1(vec, cos, vec)
CROSSRAY_MAP_1(vec, tan, vec)
CROSSRAY_MAP_1(vec, asin, vec)
CROSSRAY_MAP_1(vec, acos, vec)
CROSSRAY_MAP_1(vec, atan, vec)
CROSSRAY_MAP_1(vec, exp, vec)
CROSSRAY_MAP_1(vec, log, vec)
CROSSRAY_MAP_1(vec, exp2, vec)
CROSSRAY_MAP_1(vec, log2, vec)
CROSSRAY_MAP_1(vec, sqrt, vec)
CROSSRAY_MAP_1(vec, inversesqrt, vec)
CROSSRAY_MAP_1(vec, abs, vec)
CROSSRAY_MAP_1(ivec, abs, ivec)
CROSSRAY_MAP_1(vec, sign, vec)
CROSSRAY_MAP_1(ivec, sign, ivec)
CROSSRAY_MAP_1(vec, floor, vec)
CROSSRAY_MAP_1(vec, ceil, vec)
CROSSRAY_MAP_1(vec, trunc, vec)
CROSSRAY_MAP_1(vec, round, vec)
CROSSRAY_MAP_1(vec, roundEven, vec)
CROSSRAY_MAP_1(vec, fract, vec)
CROSSRAY_MAP_1(bvec, isnan, vec)
CROSSRAY_MAP_1(bvec, isinf, vec)
CROSSRAY_MAP_2(atan, vec)
CROSSRAY_MAP_2(pow, vec)
CROSSRAY_MAP_2_SCALAR(mod, vec, float)
CROSSRAY_MAP_2_SCALAR(min, vec, float)
CROSSRAY_MAP_2_SCALAR(min, ivec, int)
CROSSRAY_MAP_2_SCALAR(min, uvec, uint)
CROSSRAY_MAP_2_SCALAR(max, vec, float)
CROSSRAY_MAP_2_SCALAR(max, ivec, int)
CROSSRAY_MAP_2_SCALAR(max, uvec, uint)
CROSSRAY_MAP_2(step, vec)
CROSSRAY_MAP_3(clamp, vec, vec)
CROSSRAY_MAP_3(clamp, ivec, ivec)
CROSSRAY_MAP_3(clamp, uvec, uvec)
CROSSRAY_CLAMP_SCALAR(vec, float)
CROSSRAY_CLAMP_SCALAR(ivec, int)
CROSSRAY_CLAMP_SCALAR(uvec, uint)
CROSSRAY_MAP_3(mix, vec, vec)
CROSSRAY_MAP_3(mix, vec, bvec)
CROSSRAY_MAP_3(mix, ivec, bvec)
CROSSRAY_MAP_3(smoothstep, vec, vec)
inline vec2 mix(const vec2& a, const vec2& b, float t)
{
    return mix(a, b, vec2(t));
}
inline vec3 mix(const vec3& a, const vec3& b, float t)
{
    return mix(a, b, vec3(t));
}
inline vec4 mix(const vec4& a, const vec4& b, float t)
{
    return mix(a, b, vec4(t));
}
inline vec2 step(float edge, const vec2& v)
{
    return step(vec2(edge), v);
}
inline vec3 step(float edge, const vec3& v)
{
    return step(vec3(edge), v);
}
inline vec4 step(float edge, const vec4& v)
{
    return step(vec4(edge), v);
}
inline vec2 smoothstep(float e0, float e1, const vec2& v)
{
    return smoothstep(vec2(e0), vec2(e1), v);
}
inline vec3 smoothstep(float e0, float e1, const vec3& v)
{
    return smoothstep(vec3(e0), vec3(e1), v);
}
inline vec4 smoothstep(float e0, float e1, const vec4& v)
{
    return smoothstep(vec4(e0), vec4(e1), v);
}

// Comparisons of vectors.
#define CROSSRAY_COMPARE(f, op, V)                                                                                     \
    inline bvec2 f(const V##2 & a, const V##2 & b)                                                                     \
    {                                                                                                                  \
        return bvec2(a.x op b.x, a.y op b.y);                                                                          \
    }                                                                                                                  \
    inline bvec3 f(const V##3 & a, const V##3 & b)                                                                     \
    {                                                                                                                  \
        return bvec3(a.x op b.x, a.y op b.y, a.z op b.z);                                                              \
    }                                                                                                                  \
    inline bvec4 f(const V##4 & a, const V##4 & b)                                                                     \
    {                                                                                                                  \
        return bvec4(a.x op b.x, a.y op b.y, a.z op b.z, a.w op b.w);                                                  \
    }
#define CROSSRAY_COMPARISONS(V)                                                                                        \
    CROSSRAY_COMPARE(lessThan, <, V)                                                                                   \
    CROSSRAY_COMPARE(lessThanEqual, <=, V)                                                                             \
    CROSSRAY_COMPARE(greaterThan, >, V)                                                                                \
    CROSSRAY_COMPARE(greaterThanEqual, >=, V)                                                                          \
    CROSSRAY_COMPARE(equal, ==, V)                                                                                     \
    CROSSRAY_COMPARE(notEqual, !=, V)
CROSSRAY_COMPARISONS(vec)
CROSSRAY_COMPARISONS(ivec)
CROSSRAY_COMPARISONS(uvec)
CROSSRAY_COMPARE(equal, ==, bvec)
CROSSRAY_COMPARE(notEqual, !=, bvec)
inline bool any(const bvec2& v)
{
    return v.x || v.y;
}
inline bool any(const bvec3& v)
{
    return v.x || v.y || v.z;
}
inline bool any(const bvec4& v)
{
    return v.x || v.y || v.z || v.w;
}
inline bool all(const bvec2& v)
{
    return v.x && v.y;
}
inline bool all(const bvec3& v)
{
    return v.x && v.y && v.z;
}
inline bool all(const bvec4& v)
{
    return v.x && v.y && v.z && v.w;
}

// Geometry.
inline float dot(float a, float b)
{
    return a * b;
}
inline float dot(const vec2& a, const vec2& b)
{
    return a.x * b.x + a.y * b.y;
}
inline float dot(const vec3& a, const vec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline float dot(const vec4& a, const vec4& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
inline vec3 cross(const vec3& a, const vec3& b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
#define CROSSRAY_GEOMETRY(T)                                                                                           \
    inline float length(const T& v)                                                                                    \
    {                                                                                                                  \
        return sqrt(dot(v, v));                                                                                        \
    }                                                                                                                  \
    inline float distance(const T& a, const T& b)                                                                      \
    {                                                                                                                  \
        return length(a - b);                                                                                          \
    }                                                                                                                  \
    inline T normalize(const T& v)                                                                                     \
    {                                                                                                                  \
        return v / length(v);                                                                                          \
    }                                                                                                                  \
    inline T faceforward(const T& n, const T& i, const T& nRef)                                                        \
    {                                                                                                                  \
        return dot(nRef, i) < 0.0 ? n : -n;                                                                            \
    }                                                                                                                  \
    inline T reflect(const T& i, const T& n)                                                                           \
    {                                                                                                                  \
        return i - n * (2.0 * dot(n, i));                                                                              \
    }                                                                                                                  \
    inline T refract(const T& i, const T& n, float eta)                                                                \
    {                                                                                                                  \
        float ni = dot(n, i);                                                                                          \
        float k = 1.0 - eta * eta * (1.0 - ni * ni);                                                                   \
        return k < 0.0 ? T(0.0) : i * eta - n * (eta * ni + sqrt(k));                                                  \
    }
CROSSRAY_GEOMETRY(vec2)
CROSSRAY_GEOMETRY(vec3)
CROSSRAY_GEOMETRY(vec4)

// Matrices.
inline mat3 transpose(const mat3& m)
{
    return mat3(m[0].x, m[1].x, m[2].x, m[0].y, m[1].y, m[2].y, m[0].z, m[1].z, m[2].z);
}
inline mat4 transpose(const mat4& m)
{
    return mat4(vec4(m[0].x, m[1].x, m[2].x, m[3].x), vec4(m[0].y, m[1].y, m[2].y, m[3].y),
                vec4(m[0].z, m[1].z, m[2].z, m[3].z), vec4(m[0].w, m[1].w, m[2].w, m[3].w));
}
inline vec3 operator*(const vec3& v, const mat3& m)
{
    return vec3(dot(v, m[0]), dot(v, m[1]), dot(v, m[2]));
}
inline vec4 operator*(const vec4& v, const mat4& m)
{
    return vec4(dot(v, m[0]), dot(v, m[1]), dot(v, m[2]), dot(v, m[3]));
}
inline float determinant(const mat3& m)
{
    return dot(m[0], cross(m[1], m[2]));
}
inline mat3 inverse(const mat3& m)
{
    vec3 r0 = cross(m[1], m[2]);
    vec3 r1 = cross(m[2], m[0]);
    vec3 r2 = cross(m[0], m[1]);
    return transpose(mat3(r0, r1, r2)) * (1.0 / dot(m[0], r0));
}
