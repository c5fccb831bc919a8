// A floor before a wall, a furnished room, and the camera that looks into it: scenes for the tracers' tests. For use
// after glsl_end.h, with views.h and scene.h before it.

using Shapes = std::vector<shaderTest::Shape>;

constexpr Real kHalfFov = Real(0.5235987755982988); // 30 degrees

inline Shapes floorAndWall()
{
    return {plane({0, -1, 0}, {0, 1, 0}), plane({0, 0, -8}, {0, 0, 1})};
}
inline Shapes room()
{
    Shapes shapes = floorAndWall();
    shapes.push_back(plane({-4, 0, 0}, {1, 0, 0}));
    shapes.push_back(box({1, -0.5, -5}, {0.5, 0.5, 0.5}));
    shapes.push_back(sphere({-1, 0, -4}, 0.6));
    shapes.push_back(box({0.3, 0, -3}, {0.03, 1, 0.03}));
    return shapes;
}
inline View roomView(int width, int height, int depth = 1, bool orthographic = false)
{
    return makeView(vec2(ivec2(width, height)), orthographic ? Real(2.5) : kHalfFov, Real(0.1), 100, depth,
                    orthographic, vec3(0, Real(0.3), 1), Real(0.1), Real(-0.15));
}
