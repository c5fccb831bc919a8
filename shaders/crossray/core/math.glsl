// Small maths that the whole library stands on: answers that stay finite where GLSL leaves them open.
// Hooks: none. Source: the definitions themselves.
//
// Comparisons are written so that a NaN makes them false and the false branch is the defended one: some compilers turn
// `!(a < b)` into `a >= b`, which is no longer true for a NaN.
#ifndef CROSSRAY_CORE_MATH_GLSL
#define CROSSRAY_CORE_MATH_GLSL

const float kPi = 3.14159265358979324;
// Metres. What stands for "infinitely far": the largest half-float, so that it survives 16-bit targets.
const float kFarAway = 65504.0;
// Vectors shorter or longer than these have no direction here: squares of scaled components neither vanish nor
// overflow.
const float kShortestVector = 1e-30;
const float kLongestVector = 1e30;

// yes where the condition holds, else no. Both are computed, and no branch comes of it: drivers' compilers slow down
// with the number of basic blocks, and `condition ? f() : g()`, `a() && b()` and early returns are blocks.
float choose(bool condition, float yes, float no)
{
    return condition ? yes : no;
}

int choose(bool condition, int yes, int no)
{
    return condition ? yes : no;
}

vec2 choose(bool condition, vec2 yes, vec2 no)
{
    return condition ? yes : no;
}

vec3 choose(bool condition, vec3 yes, vec3 no)
{
    return condition ? yes : no;
}

ivec2 choose(bool condition, ivec2 yes, ivec2 no)
{
    return condition ? yes : no;
}

// x clamped to [0,1]; a NaN gives 0.
float saturate(float x)
{
    float atMostOne = min(x, 1.0);
    return x > 0.0 ? atMostOne : 0.0;
}

vec2 saturate(vec2 v)
{
    return vec2(saturate(v.x), saturate(v.y));
}

vec3 saturate(vec3 v)
{
    return vec3(saturate(v.x), saturate(v.y), saturate(v.z));
}

// True for a number: neither NaN nor infinite nor beyond 1e37; of a vector the magnitudes together. They are compared as
// one number: Mesa 22.3 turns what hangs on `all(lessThan(...))` round into what hangs on `any` of `>=`, which is false
// for a NaN.
bool isFinite(float x)
{
    return abs(x) < 1e37;
}

bool isFinite(vec2 v)
{
    return abs(v.x) + abs(v.y) < 1e37;
}

bool isFinite(vec3 v)
{
    return abs(v.x) + abs(v.y) + abs(v.z) < 1e37;
}

bool isFinite(vec4 v)
{
    return abs(v.x) + abs(v.y) + abs(v.z) + abs(v.w) < 1e37;
}

// x where it is finite, else the fallback.
float finiteOr(float x, float fallback)
{
    return isFinite(x) ? x : fallback;
}

// Sum of the absolute components: NaN and infinity come through, and it is 0 only for the zero vector.
float sumOfMagnitudes(vec3 v)
{
    return abs(v.x) + abs(v.y) + abs(v.z);
}

// True where safeNormalize finds a direction.
bool hasDirection(vec3 v)
{
    float size = sumOfMagnitudes(v);
    bool isLongEnough = size > kShortestVector;
    bool isShortEnough = size < kLongestVector;
    return isLongEnough && isShortEnough;
}

// v scaled to length 1. The fallback (unit, or whatever the caller wants to see) answers for zero, NaN, infinite, and
// vectors outside 1e-30 to 1e30. Lengths whose squares leave the range of a float (1e-25, 1e25) are no problem.
vec3 safeNormalize(vec3 v, vec3 fallback)
{
    bool usable = hasDirection(v);
    vec3 scaled = v / choose(usable, sumOfMagnitudes(v), 1.0);
    return choose(usable, scaled * inversesqrt(dot(scaled, scaled)), fallback);
}

// a / b, and the fallback where that is no finite number (b = 0 among others).
float safeDivide(float a, float b, float fallback)
{
    bool isDivisor = abs(b) > 0.0;
    float quotient = a / choose(isDivisor, b, 1.0);
    bool isNumber = isFinite(quotient);
    return isDivisor && isNumber ? quotient : fallback;
}

// x, moved away from 0 by keeping at least `smallest` (> 0) of magnitude; -0 and +0 become +smallest, NaN too.
float awayFromZero(float x, float smallest)
{
    float sided = choose(x < 0.0, -smallest, smallest);
    return abs(x) >= smallest ? x : sided;
}

float minComponent(vec3 v)
{
    return min(v.x, min(v.y, v.z));
}

float maxComponent(vec3 v)
{
    return max(v.x, max(v.y, v.z));
}

// The cubic S(x) = x*x*(3 - 2x) over x clamped to [0,1].
float smoothRamp(float x)
{
    float t = saturate(x);
    return t * t * (3.0 - 2.0 * t);
}

#endif
