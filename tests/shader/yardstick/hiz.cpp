#include "tests/shader/yardstick/hiz.h"

#include <vector>

#define CROSSRAY_GLSL_PRECISION 32
#include "harness/backend/cpu/glsl.h"

#define CROSSRAY_REDUCE_DEPTH_PYRAMID
#include "crossray/project/hiz.glsl"

struct Level {
    ivec2 size;
    std::vector<vec2> cells;
};
std::vector<Level> levels;
View view;
int finerLevel = 0;
long fetches = 0;

vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ++fetches;
    const Level& l = levels[static_cast<size_t>(level)];
    return l.cells[static_cast<size_t>(cell.y) * static_cast<size_t>(l.size.x) + static_cast<size_t>(cell.x)];
}
ivec2 depthPyramidSize(int level)
{
    return levels[static_cast<size_t>(level)].size;
}
int depthPyramidLevelCount()
{
    return static_cast<int>(levels.size());
}
void recordHizStep(HizStep) {}
vec2 fetchFinerDepth(ivec2 cell)
{
    return fetchDepthPyramid(cell, finerLevel);
}
ivec2 finerDepthSize()
{
    return depthPyramidSize(finerLevel);
}

mat4 toMatrix(const std::array<double, 16>& m)
{
    mat4 matrix;
    for (int i = 0; i < 16; ++i)
        matrix[i / 4][i % 4] = static_cast<float>(m[static_cast<size_t>(i)]);
    return matrix;
}

#include "harness/backend/cpu/glsl_end.h"

using namespace crossray::cpu32;

namespace yardstick {

void setDepth(const Frame& frame, std::span<const float> linearDepth)
{
    const auto nearDistance = static_cast<float>(frame.nearDistance),
               farDistance = static_cast<float>(frame.farDistance);
    const float range = farDistance - nearDistance;
    const vec2 slope(static_cast<float>(frame.slopeX), static_cast<float>(frame.slopeY));
    view = View(toMatrix(frame.viewFromWorld), toMatrix(frame.worldFromView), mat4(1.0),
                vec2(ivec2(frame.width, frame.height)), slope, -nearDistance / range,
                farDistance * nearDistance / range, nearDistance, farDistance, false, true);
    levels = {Level{ivec2(frame.width, frame.height), {}}};
    for (float depth : linearDepth) {
        levels[0].cells.push_back(makeDepthPyramidTexel(view, depth > 0 ? deviceDepthFromLinear(view, depth) : 0));
    }
    for (int level = 1; level < computeDepthPyramidLevelCount(levels[0].size); ++level) {
        finerLevel = level - 1;
        Level next{computeDepthPyramidSize(levels[0].size, level), {}};
        for (int y = 0; y < next.size.y; ++y) {
            for (int x = 0; x < next.size.x; ++x)
                next.cells.push_back(reduceDepthPyramidCell(ivec2(x, y)));
        }
        levels.push_back(std::move(next));
    }
}

Answer trace(int x, int y, const std::array<double, 3>& dirWS, const Settings& settings)
{
    const float depth = fetchDepthPyramid(ivec2(x, y), 0).x;
    const vec3 originWS = positionWSFromSS(view, vec2(ivec2(x, y)) + vec2(0.5), depth);
    const vec3 dir(static_cast<float>(dirWS[0]), static_cast<float>(dirWS[1]), static_cast<float>(dirWS[2]));
    fetches = 0;
    const TraceResult result = traceHiz(view, originWS, dir,
                                        HizSettings(settings.minLevel, settings.maxLevel, settings.maxIterations,
                                                    static_cast<float>(settings.depthBias)));
    return {result.hitClass == kHitClassHit,
            static_cast<double>(result.positionSS.x),
            static_cast<double>(result.positionSS.y),
            static_cast<double>(result.linearDepth),
            result.iterations,
            fetches};
}

} // namespace yardstick
