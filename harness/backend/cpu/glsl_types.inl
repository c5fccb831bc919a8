// GLSL's types for glsl.h, which includes this inside its namespace. Vectors are plain scalars in a row, trivially
// copyable.

using uint = unsigned int;

struct vec2;
struct vec3;
struct vec4;
struct ivec2;
struct ivec3;
struct ivec4;
struct uvec2;
struct uvec3;
struct uvec4;
struct bvec2;
struct bvec3;
struct bvec4;

// A swizzle is a view of the vector it lies in (a union), which becomes the vector of its components when it is read.
// It reads by a pointer to the scalars: any member may have been the last one written.
template <typename Vector, typename Scalar, int... components>
struct Swizzle {
    Scalar storage[1];
    operator Vector() const { return Vector(reinterpret_cast<const Scalar*>(this)[components]...); }
};

// Every swizzle of two and three components out of the first n, and the usual ones of four.
// clang-format off
#define CROSSRAY_SW2(V, S, a, b, i, j) Swizzle<V##2, S, i, j> a##b;
#define CROSSRAY_SW3(V, S, a, b, c, i, j, k) Swizzle<V##3, S, i, j, k> a##b##c;
#define CROSSRAY_SW4(V, S, a, b, c, d, i, j, k, l) Swizzle<V##4, S, i, j, k, l> a##b##c##d;

#define CROSSRAY_PAIRS_2(V, S, a, i) CROSSRAY_SW2(V, S, a, x, i, 0) CROSSRAY_SW2(V, S, a, y, i, 1)
#define CROSSRAY_PAIRS_3(V, S, a, i) CROSSRAY_PAIRS_2(V, S, a, i) CROSSRAY_SW2(V, S, a, z, i, 2)
#define CROSSRAY_PAIRS_4(V, S, a, i) CROSSRAY_PAIRS_3(V, S, a, i) CROSSRAY_SW2(V, S, a, w, i, 3)
#define CROSSRAY_TRIPLES_2(V, S, a, b, i, j) CROSSRAY_SW3(V, S, a, b, x, i, j, 0) CROSSRAY_SW3(V, S, a, b, y, i, j, 1)
#define CROSSRAY_TRIPLES_3(V, S, a, b, i, j) CROSSRAY_TRIPLES_2(V, S, a, b, i, j) CROSSRAY_SW3(V, S, a, b, z, i, j, 2)
#define CROSSRAY_TRIPLES_4(V, S, a, b, i, j) CROSSRAY_TRIPLES_3(V, S, a, b, i, j) CROSSRAY_SW3(V, S, a, b, w, i, j, 3)

#define CROSSRAY_SWIZZLES_2(V, S) \
    CROSSRAY_PAIRS_2(V, S, x, 0) CROSSRAY_PAIRS_2(V, S, y, 1) \
    CROSSRAY_TRIPLES_2(V, S, x, x, 0, 0) CROSSRAY_TRIPLES_2(V, S, x, y, 0, 1) \
    CROSSRAY_TRIPLES_2(V, S, y, x, 1, 0) CROSSRAY_TRIPLES_2(V, S, y, y, 1, 1) \
    CROSSRAY_SW4(V, S, x, y, x, y, 0, 1, 0, 1) CROSSRAY_SW4(V, S, x, x, y, y, 0, 0, 1, 1) \
    CROSSRAY_SW2(V, S, r, g, 0, 1)
#define CROSSRAY_SWIZZLES_3(V, S) \
    CROSSRAY_PAIRS_3(V, S, x, 0) CROSSRAY_PAIRS_3(V, S, y, 1) CROSSRAY_PAIRS_3(V, S, z, 2) \
    CROSSRAY_TRIPLES_3(V, S, x, x, 0, 0) CROSSRAY_TRIPLES_3(V, S, x, y, 0, 1) CROSSRAY_TRIPLES_3(V, S, x, z, 0, 2) \
    CROSSRAY_TRIPLES_3(V, S, y, x, 1, 0) CROSSRAY_TRIPLES_3(V, S, y, y, 1, 1) CROSSRAY_TRIPLES_3(V, S, y, z, 1, 2) \
    CROSSRAY_TRIPLES_3(V, S, z, x, 2, 0) CROSSRAY_TRIPLES_3(V, S, z, y, 2, 1) CROSSRAY_TRIPLES_3(V, S, z, z, 2, 2) \
    CROSSRAY_SW2(V, S, r, g, 0, 1) CROSSRAY_SW3(V, S, r, g, b, 0, 1, 2)
#define CROSSRAY_SWIZZLES_4(V, S) \
    CROSSRAY_PAIRS_4(V, S, x, 0) CROSSRAY_PAIRS_4(V, S, y, 1) CROSSRAY_PAIRS_4(V, S, z, 2) CROSSRAY_PAIRS_4(V, S, w, 3) \
    CROSSRAY_TRIPLES_4(V, S, x, x, 0, 0) CROSSRAY_TRIPLES_4(V, S, x, y, 0, 1) CROSSRAY_TRIPLES_4(V, S, x, z, 0, 2) \
    CROSSRAY_TRIPLES_4(V, S, x, w, 0, 3) CROSSRAY_TRIPLES_4(V, S, y, x, 1, 0) CROSSRAY_TRIPLES_4(V, S, y, y, 1, 1) \
    CROSSRAY_TRIPLES_4(V, S, y, z, 1, 2) CROSSRAY_TRIPLES_4(V, S, y, w, 1, 3) CROSSRAY_TRIPLES_4(V, S, z, x, 2, 0) \
    CROSSRAY_TRIPLES_4(V, S, z, y, 2, 1) CROSSRAY_TRIPLES_4(V, S, z, z, 2, 2) CROSSRAY_TRIPLES_4(V, S, z, w, 2, 3) \
    CROSSRAY_TRIPLES_4(V, S, w, x, 3, 0) CROSSRAY_TRIPLES_4(V, S, w, y, 3, 1) CROSSRAY_TRIPLES_4(V, S, w, z, 3, 2) \
    CROSSRAY_TRIPLES_4(V, S, w, w, 3, 3) \
    CROSSRAY_SW4(V, S, x, y, z, w, 0, 1, 2, 3) CROSSRAY_SW4(V, S, w, z, y, x, 3, 2, 1, 0) \
    CROSSRAY_SW4(V, S, x, x, x, x, 0, 0, 0, 0) CROSSRAY_SW4(V, S, y, y, y, y, 1, 1, 1, 1) \
    CROSSRAY_SW4(V, S, z, z, z, z, 2, 2, 2, 2) CROSSRAY_SW4(V, S, w, w, w, w, 3, 3, 3, 3) \
    CROSSRAY_SW2(V, S, r, g, 0, 1) CROSSRAY_SW3(V, S, r, g, b, 0, 1, 2) CROSSRAY_SW4(V, S, r, g, b, a, 0, 1, 2, 3)
// clang-format on

// One family of vectors: V names it ("", "i", "u", "b" + "vec"), S is its scalar, O1..O3 are the other families; the
// conversions from those are defined below, once all are complete.
#define CROSSRAY_VECTORS(V, S, O1, O2, O3)                                                                             \
    struct V##2                                                                                                        \
    {                                                                                                                  \
        union {                                                                                                        \
            struct {                                                                                                   \
                S x, y;                                                                                                \
            };                                                                                                         \
            struct {                                                                                                   \
                S r, g;                                                                                                \
            };                                                                                                         \
            CROSSRAY_SWIZZLES_2(V, S)                                                                                  \
        };                                                                                                             \
        V##2() = default;                                                                                              \
        explicit V##2(S s) : x(s), y(s) {}                                                                             \
        V##2(S x_, S y_) : x(x_), y(y_) {}                                                                             \
        explicit V##2(const V##3 & v);                                                                                 \
        explicit V##2(const V##4 & v);                                                                                 \
        explicit V##2(const O1##2 & v);                                                                                \
        explicit V##2(const O2##2 & v);                                                                                \
        explicit V##2(const O3##2 & v);                                                                                \
        S& operator[](int i)                                                                                           \
        {                                                                                                              \
            return reinterpret_cast<S*>(this)[i];                                                                      \
        }                                                                                                              \
        S operator[](int i) const                                                                                      \
        {                                                                                                              \
            return reinterpret_cast<const S*>(this)[i];                                                                \
        }                                                                                                              \
    };                                                                                                                 \
    struct V##3                                                                                                        \
    {                                                                                                                  \
        union {                                                                                                        \
            struct {                                                                                                   \
                S x, y, z;                                                                                             \
            };                                                                                                         \
            struct {                                                                                                   \
                S r, g, b;                                                                                             \
            };                                                                                                         \
            CROSSRAY_SWIZZLES_3(V, S)                                                                                  \
        };                                                                                                             \
        V##3() = default;                                                                                              \
        explicit V##3(S s) : x(s), y(s), z(s) {}                                                                       \
        V##3(S x_, S y_, S z_) : x(x_), y(y_), z(z_) {}                                                                \
        V##3(const V##2 & v, S z_) : x(v.x), y(v.y), z(z_) {}                                                          \
        V##3(S x_, const V##2 & v) : x(x_), y(v.x), z(v.y) {}                                                          \
        explicit V##3(const V##4 & v);                                                                                 \
        explicit V##3(const O1##3 & v);                                                                                \
        explicit V##3(const O2##3 & v);                                                                                \
        explicit V##3(const O3##3 & v);                                                                                \
        S& operator[](int i)                                                                                           \
        {                                                                                                              \
            return reinterpret_cast<S*>(this)[i];                                                                      \
        }                                                                                                              \
        S operator[](int i) const                                                                                      \
        {                                                                                                              \
            return reinterpret_cast<const S*>(this)[i];                                                                \
        }                                                                                                              \
    };                                                                                                                 \
    struct V##4                                                                                                        \
    {                                                                                                                  \
        union {                                                                                                        \
            struct {                                                                                                   \
                S x, y, z, w;                                                                                          \
            };                                                                                                         \
            struct {                                                                                                   \
                S r, g, b, a;                                                                                          \
            };                                                                                                         \
            CROSSRAY_SWIZZLES_4(V, S)                                                                                  \
        };                                                                                                             \
        V##4() = default;                                                                                              \
        explicit V##4(S s) : x(s), y(s), z(s), w(s) {}                                                                 \
        V##4(S x_, S y_, S z_, S w_) : x(x_), y(y_), z(z_), w(w_) {}                                                   \
        V##4(const V##3 & v, S w_) : x(v.x), y(v.y), z(v.z), w(w_) {}                                                  \
        V##4(S x_, const V##3 & v) : x(x_), y(v.x), z(v.y), w(v.z) {}                                                  \
        V##4(const V##2 & u, const V##2 & v) : x(u.x), y(u.y), z(v.x), w(v.y) {}                                       \
        V##4(const V##2 & v, S z_, S w_) : x(v.x), y(v.y), z(z_), w(w_) {}                                             \
        V##4(S x_, S y_, const V##2 & v) : x(x_), y(y_), z(v.x), w(v.y) {}                                             \
        explicit V##4(const O1##4 & v);                                                                                \
        explicit V##4(const O2##4 & v);                                                                                \
        explicit V##4(const O3##4 & v);                                                                                \
        S& operator[](int i)                                                                                           \
        {                                                                                                              \
            return reinterpret_cast<S*>(this)[i];                                                                      \
        }                                                                                                              \
        S operator[](int i) const                                                                                      \
        {                                                                                                              \
            return reinterpret_cast<const S*>(this)[i];                                                                \
        }                                                                                                              \
    };                                                                                                                 \
    inline V##2 ::V##2(const V##3 & v) : x(v.x), y(v.y) {}                                                             \
    inline V##2 ::V##2(const V##4 & v) : x(v.x), y(v.y) {}                                                             \
    inline V##3 ::V##3(const V##4 & v) : x(v.x), y(v.y), z(v.z) {}                                                     \
    inline bool operator==(const V##2 & a, const V##2 & b)                                                             \
    {                                                                                                                  \
        return a.x == b.x && a.y == b.y;                                                                               \
    }                                                                                                                  \
    inline bool operator==(const V##3 & a, const V##3 & b)                                                             \
    {                                                                                                                  \
        return a.x == b.x && a.y == b.y && a.z == b.z;                                                                 \
    }                                                                                                                  \
    inline bool operator==(const V##4 & a, const V##4 & b)                                                             \
    {                                                                                                                  \
        return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;                                                   \
    }

CROSSRAY_VECTORS(vec, float, ivec, uvec, bvec)
CROSSRAY_VECTORS(ivec, int, vec, uvec, bvec)
CROSSRAY_VECTORS(uvec, uint, vec, ivec, bvec)
CROSSRAY_VECTORS(bvec, bool, vec, ivec, uvec)

#define CROSSRAY_CONVERT(V, S, O)                                                                                      \
    inline V##2 ::V##2(const O##2 & v) : x(static_cast<S>(v.x)), y(static_cast<S>(v.y)) {}                             \
    inline V##3 ::V##3(const O##3 & v) : x(static_cast<S>(v.x)), y(static_cast<S>(v.y)), z(static_cast<S>(v.z)) {}     \
    inline V##4 ::V##4(const O##4 & v)                                                                                 \
        : x(static_cast<S>(v.x)), y(static_cast<S>(v.y)), z(static_cast<S>(v.z)), w(static_cast<S>(v.w))               \
    {                                                                                                                  \
    }
CROSSRAY_CONVERT(vec, float, ivec)
CROSSRAY_CONVERT(vec, float, uvec)
CROSSRAY_CONVERT(vec, float, bvec)
CROSSRAY_CONVERT(ivec, int, vec)
CROSSRAY_CONVERT(ivec, int, uvec)
CROSSRAY_CONVERT(ivec, int, bvec)
CROSSRAY_CONVERT(uvec, uint, vec)
CROSSRAY_CONVERT(uvec, uint, ivec)
CROSSRAY_CONVERT(uvec, uint, bvec)
CROSSRAY_CONVERT(bvec, bool, vec)
CROSSRAY_CONVERT(bvec, bool, ivec)
CROSSRAY_CONVERT(bvec, bool, uvec)

// Componentwise operators of vector and vector, vector and scalar, and their assigning forms.
#define CROSSRAY_BINARY(V, S, op)                                                                                      \
    inline V##2 operator op(const V##2 & a, const V##2 & b)                                                            \
    {                                                                                                                  \
        return V##2(a.x op b.x, a.y op b.y);                                                                           \
    }                                                                                                                  \
    inline V##3 operator op(const V##3 & a, const V##3 & b)                                                            \
    {                                                                                                                  \
        return V##3(a.x op b.x, a.y op b.y, a.z op b.z);                                                               \
    }                                                                                                                  \
    inline V##4 operator op(const V##4 & a, const V##4 & b)                                                            \
    {                                                                                                                  \
        return V##4(a.x op b.x, a.y op b.y, a.z op b.z, a.w op b.w);                                                   \
    }                                                                                                                  \
    inline V##2 operator op(const V##2 & a, S b)                                                                       \
    {                                                                                                                  \
        return a op V##2(b);                                                                                           \
    }                                                                                                                  \
    inline V##3 operator op(const V##3 & a, S b)                                                                       \
    {                                                                                                                  \
        return a op V##3(b);                                                                                           \
    }                                                                                                                  \
    inline V##4 operator op(const V##4 & a, S b)                                                                       \
    {                                                                                                                  \
        return a op V##4(b);                                                                                           \
    }                                                                                                                  \
    inline V##2 operator op(S a, const V##2 & b)                                                                       \
    {                                                                                                                  \
        return V##2(a)op b;                                                                                            \
    }                                                                                                                  \
    inline V##3 operator op(S a, const V##3 & b)                                                                       \
    {                                                                                                                  \
        return V##3(a)op b;                                                                                            \
    }                                                                                                                  \
    inline V##4 operator op(S a, const V##4 & b)                                                                       \
    {                                                                                                                  \
        return V##4(a)op b;                                                                                            \
    }                                                                                                                  \
    inline V##2 & operator op##=(V##2 & a, const V##2 & b)                                                             \
    {                                                                                                                  \
        return a = a op b;                                                                                             \
    }                                                                                                                  \
    inline V##3 & operator op##=(V##3 & a, const V##3 & b)                                                             \
    {                                                                                                                  \
        return a = a op b;                                                                                             \
    }                                                                                                                  \
    inline V##4 & operator op##=(V##4 & a, const V##4 & b)                                                             \
    {                                                                                                                  \
        return a = a op b;                                                                                             \
    }                                                                                                                  \
    inline V##2 & operator op##=(V##2 & a, S b)                                                                        \
    {                                                                                                                  \
        return a = a op b;                                                                                             \
    }                                                                                                                  \
    inline V##3 & operator op##=(V##3 & a, S b)                                                                        \
    {                                                                                                                  \
        return a = a op b;                                                                                             \
    }                                                                                                                  \
    inline V##4 & operator op##=(V##4 & a, S b)                                                                        \
    {                                                                                                                  \
        return a = a op b;                                                                                             \
    }
#define CROSSRAY_ARITHMETIC(V, S)                                                                                      \
    CROSSRAY_BINARY(V, S, +)                                                                                           \
    CROSSRAY_BINARY(V, S, -)                                                                                           \
    CROSSRAY_BINARY(V, S, *)                                                                                           \
    CROSSRAY_BINARY(V, S, /)
#define CROSSRAY_NEGATE(V)                                                                                             \
    inline V##2 operator-(const V##2 & a)                                                                              \
    {                                                                                                                  \
        return V##2(-a.x, -a.y);                                                                                       \
    }                                                                                                                  \
    inline V##3 operator-(const V##3 & a)                                                                              \
    {                                                                                                                  \
        return V##3(-a.x, -a.y, -a.z);                                                                                 \
    }                                                                                                                  \
    inline V##4 operator-(const V##4 & a)                                                                              \
    {                                                                                                                  \
        return V##4(-a.x, -a.y, -a.z, -a.w);                                                                           \
    }
#define CROSSRAY_BITS(V, S)                                                                                            \
    CROSSRAY_BINARY(V, S, %)                                                                                           \
    CROSSRAY_BINARY(V, S, &)                                                                                           \
    CROSSRAY_BINARY(V, S, |)                                                                                           \
    CROSSRAY_BINARY(V, S, ^)                                                                                           \
    CROSSRAY_BINARY(V, S, <<)                                                                                          \
    CROSSRAY_BINARY(V, S, >>)
CROSSRAY_ARITHMETIC(vec, float)
CROSSRAY_ARITHMETIC(ivec, int)
CROSSRAY_ARITHMETIC(uvec, uint)
CROSSRAY_NEGATE(vec)
CROSSRAY_NEGATE(ivec)
CROSSRAY_BITS(ivec, int)
CROSSRAY_BITS(uvec, uint)

// Matrices: columns, as in GLSL.
struct mat4;
struct mat3 {
    vec3 columns[3];
    mat3() = default;
    explicit mat3(float s) : columns{vec3(s, 0, 0), vec3(0, s, 0), vec3(0, 0, s)} {}
    mat3(const vec3& a, const vec3& b, const vec3& c) : columns{a, b, c} {}
    mat3(float a, float b, float c, float d, float e, float f, float g, float h, float i)
        : columns{vec3(a, b, c), vec3(d, e, f), vec3(g, h, i)}
    {
    }
    explicit mat3(const mat4& m);
    vec3& operator[](int i) { return columns[i]; }
    const vec3& operator[](int i) const { return columns[i]; }
};
struct mat4 {
    vec4 columns[4];
    mat4() = default;
    explicit mat4(float s) : columns{vec4(s, 0, 0, 0), vec4(0, s, 0, 0), vec4(0, 0, s, 0), vec4(0, 0, 0, s)} {}
    mat4(const vec4& a, const vec4& b, const vec4& c, const vec4& d) : columns{a, b, c, d} {}
    explicit mat4(const mat3& m) : columns{vec4(m[0], 0), vec4(m[1], 0), vec4(m[2], 0), vec4(0, 0, 0, 1)} {}
    vec4& operator[](int i) { return columns[i]; }
    const vec4& operator[](int i) const { return columns[i]; }
};
inline mat3::mat3(const mat4& m) : columns{m[0].xyz, m[1].xyz, m[2].xyz} {}

inline vec3 operator*(const mat3& m, const vec3& v)
{
    return m[0] * v.x + m[1] * v.y + m[2] * v.z;
}
inline vec4 operator*(const mat4& m, const vec4& v)
{
    return m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3] * v.w;
}
inline mat3 operator*(const mat3& a, const mat3& b)
{
    return mat3(a * b[0], a * b[1], a * b[2]);
}
inline mat4 operator*(const mat4& a, const mat4& b)
{
    return mat4(a * b[0], a * b[1], a * b[2], a * b[3]);
}
inline mat3 operator*(const mat3& m, float s)
{
    return mat3(m[0] * s, m[1] * s, m[2] * s);
}
inline mat4 operator*(const mat4& m, float s)
{
    return mat4(m[0] * s, m[1] * s, m[2] * s, m[3] * s);
}
inline mat3 operator*(float s, const mat3& m)
{
    return m * s;
}
inline mat4 operator*(float s, const mat4& m)
{
    return m * s;
}
