// Small scenes of planes, boxes and spheres for the tracer tests, cast in double: what the depth buffer shows and what
// a ray really meets. Shares no code with the shaders.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace shaderTest {

struct Vec {
    double x = 0, y = 0, z = 0;
    Vec operator+(const Vec& b) const { return {x + b.x, y + b.y, z + b.z}; }
    Vec operator-(const Vec& b) const { return {x - b.x, y - b.y, z - b.z}; }
    Vec operator*(double s) const { return {x * s, y * s, z * s}; }
    double dot(const Vec& b) const { return x * b.x + y * b.y + z * b.z; }
    double length() const { return std::sqrt(dot(*this)); }
    Vec unit() const { return *this * (1 / length()); }
};

struct SceneHit {
    double distance = 0;
    Vec position, normal; // normal towards the ray's origin
};

struct Shape {
    enum class Kind { kPlane, kBox, kSphere } kind = Kind::kPlane;
    Vec center;
    Vec size; // plane: normal; box: half extents; sphere: x is the radius
};

inline Shape plane(Vec point, Vec normal)
{
    return {Shape::Kind::kPlane, point, normal.unit()};
}
inline Shape box(Vec center, Vec half)
{
    return {Shape::Kind::kBox, center, half};
}
inline Shape sphere(Vec center, double radius)
{
    return {Shape::Kind::kSphere, center, {radius, 0, 0}};
}

inline std::optional<SceneHit> castShape(const Shape& shape, Vec origin, Vec dir, double minimum)
{
    const Vec o = origin - shape.center;
    if (shape.kind == Shape::Kind::kPlane) {
        const double rate = dir.dot(shape.size);
        if (rate == 0) return std::nullopt;
        const double t = -o.dot(shape.size) / rate;
        if (!(t > minimum)) return std::nullopt;
        return SceneHit{t, origin + dir * t, shape.size * (rate > 0 ? -1 : 1)};
    }
    if (shape.kind == Shape::Kind::kSphere) {
        const double b = o.dot(dir);
        const double d = b * b - (o.dot(o) - shape.size.x * shape.size.x);
        if (d < 0) return std::nullopt;
        for (double t : {-b - std::sqrt(d), -b + std::sqrt(d)}) {
            if (t > minimum) {
                const Vec p = origin + dir * t;
                Vec n = (p - shape.center).unit();
                return SceneHit{t, p, n * (n.dot(dir) > 0 ? -1 : 1)};
            }
        }
        return std::nullopt;
    }
    const std::array<double, 3> from{o.x, o.y, o.z}, to{dir.x, dir.y, dir.z},
        half{shape.size.x, shape.size.y, shape.size.z};
    std::optional<SceneHit> best;
    for (size_t axis = 0; axis < 3; ++axis) {
        for (double side : {-1.0, 1.0}) {
            if (to[axis] == 0) continue;
            const double t = (side * half[axis] - from[axis]) / to[axis];
            if (!(t > minimum) || (best && t >= best->distance)) continue;
            bool inside = true;
            for (size_t other = 0; other < 3; ++other) {
                if (other != axis && std::fabs(from[other] + to[other] * t) > half[other]) inside = false;
            }
            if (!inside) continue;
            std::array<double, 3> n{};
            n[axis] = to[axis] > 0 ? -1 : 1;
            best = SceneHit{t, origin + dir * t, {n[0], n[1], n[2]}};
        }
    }
    return best;
}

inline std::optional<SceneHit> cast(const std::vector<Shape>& scene, Vec origin, Vec dir, double minimum = 1e-9)
{
    std::optional<SceneHit> best;
    for (const Shape& shape : scene) {
        auto hit = castShape(shape, origin, dir, minimum);
        if (hit && (!best || hit->distance < best->distance)) best = hit;
    }
    return best;
}

} // namespace shaderTest
