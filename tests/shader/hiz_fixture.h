// A depth pyramid in memory behind the hooks of project/hiz.glsl, and scenes rendered into it. For use between glsl.h
// and glsl_end.h after hiz.glsl and views.h.

struct PyramidLevel {
    ivec2 size;
    std::vector<vec2> cells;
};
struct Pyramid {
    std::vector<PyramidLevel> levels;
};

// The pyramid that the hooks read, the level that a reduction reads, and what was recorded.
static Pyramid gPyramid;
static int gFinerLevel = 0;
static int gBadReads = 0; // outside a level
static std::vector<HizStep> gSteps;

vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    if (level < 0 || level >= static_cast<int>(gPyramid.levels.size())) {
        ++gBadReads;
        return vec2(kSkyLinearDepth);
    }
    const PyramidLevel& l = gPyramid.levels[static_cast<size_t>(level)];
    if (cell.x < 0 || cell.y < 0 || cell.x >= l.size.x || cell.y >= l.size.y) {
        ++gBadReads;
        return vec2(kSkyLinearDepth);
    }
    return l.cells[static_cast<size_t>(cell.y * l.size.x + cell.x)];
}
ivec2 depthPyramidSize(int level)
{
    return gPyramid.levels[static_cast<size_t>(level)].size;
}
int depthPyramidLevelCount()
{
    return static_cast<int>(gPyramid.levels.size());
}
void recordHizStep(HizStep step)
{
    gSteps.push_back(step);
}
vec2 fetchFinerDepth(ivec2 cell)
{
    return fetchDepthPyramid(cell, gFinerLevel);
}
ivec2 finerDepthSize()
{
    return depthPyramidSize(gFinerLevel);
}

// Builds all levels from level 0 by the library's reduction.
inline void buildPyramid(ivec2 size, std::vector<vec2> texels)
{
    gPyramid.levels = {PyramidLevel{size, std::move(texels)}};
    gBadReads = 0;
    const int levels = computeDepthPyramidLevelCount(size);
    for (int level = 1; level < levels; ++level) {
        gFinerLevel = level - 1;
        PyramidLevel next{computeDepthPyramidSize(size, level), {}};
        for (int y = 0; y < next.size.y; ++y) {
            for (int x = 0; x < next.size.x; ++x)
                next.cells.push_back(reduceDepthPyramidCell(ivec2(x, y)));
        }
        gPyramid.levels.push_back(std::move(next));
    }
}

inline shaderTest::Vec toVec(vec3 v)
{
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline vec3 fromVec(shaderTest::Vec v)
{
    return vec3(static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z));
}

// The primary ray of a point of the image: origin and unit direction in world space, and metres of depth a metre of
// ray.
struct PrimaryRay {
    shaderTest::Vec origin, dir;
    double depthRate = 1;
};
inline PrimaryRay makePrimaryRay(const View& view, double x, double y)
{
    const double ndcX = x / static_cast<double>(view.imageSize.x) * 2 - 1;
    const double ndcY = 1 - y / static_cast<double>(view.imageSize.y) * 2;
    const double u = ndcX * static_cast<double>(view.slope.x), v = ndcY * static_cast<double>(view.slope.y);
    const shaderTest::Vec right = toVec(view.worldFromView[0].xyz), up = toVec(view.worldFromView[1].xyz),
                          back = toVec(view.worldFromView[2].xyz), eye = toVec(view.worldFromView[3].xyz);
    if (view.orthographic) return {eye + right * u + up * v, back * -1, 1};
    const shaderTest::Vec dir = right * u + up * v - back;
    return {eye, dir.unit(), 1 / dir.length()};
}

// What each pixel's centre sees; no value is sky.
inline std::vector<std::optional<shaderTest::SceneHit>> renderScene(const View& view,
                                                                    const std::vector<shaderTest::Shape>& scene)
{
    std::vector<std::optional<shaderTest::SceneHit>> image;
    std::vector<vec2> texels;
    const int width = static_cast<int>(view.imageSize.x), height = static_cast<int>(view.imageSize.y);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const PrimaryRay ray = makePrimaryRay(view, static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
            auto hit =
                shaderTest::cast(scene, ray.origin, ray.dir, static_cast<double>(view.nearDistance) / ray.depthRate);
            if (hit && hit->distance * ray.depthRate > static_cast<double>(view.farDistance)) hit.reset();
            image.push_back(hit);
            const Real depth = hit ? static_cast<Real>(hit->distance * ray.depthRate) : view.farDistance;
            const Real cleared = view.reversedDepth ? 0 : 1;
            texels.push_back(makeDepthPyramidTexel(view, hit ? deviceDepthFromLinear(view, depth) : cleared));
        }
    }
    buildPyramid(ivec2(width, height), std::move(texels));
    return image;
}

// A mirror ray from the surface that a pixel sees, the way a pass starts it: from the depth buffer's position.
struct MirrorRay {
    vec3 origin, dir;
    std::optional<shaderTest::SceneHit> truth;
    vec2 truthSS;
    Real truthDepth = 0;
    bool answerable = false; // the true hit is the nearest thing at its place on screen, and faces the camera
};
inline MirrorRay makeMirrorRay(const View& view, const std::vector<shaderTest::Shape>& scene,
                               const shaderTest::SceneHit& seen, int x, int y)
{
    using shaderTest::Vec;
    const PrimaryRay primary = makePrimaryRay(view, static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
    const Vec dir = primary.dir - seen.normal * (2 * primary.dir.dot(seen.normal));
    MirrorRay ray;
    const Real depth = fetchDepthPyramid(ivec2(x, y), 0).x;
    ray.origin =
        positionWSFromSS(view, vec2(static_cast<Real>(x) + Real(0.5), static_cast<Real>(y) + Real(0.5)), depth);
    ray.dir = fromVec(dir);
    ray.truth = shaderTest::cast(scene, seen.position, dir, 1e-6);
    if (!ray.truth) return ray;
    const ScreenPosition p = projectWSToSS(view, fromVec(ray.truth->position));
    ray.truthSS = p.positionSS;
    ray.truthDepth = p.linearDepth;
    if (!p.inFront || !isOnScreen(view, p.positionSS) || p.linearDepth < view.nearDistance) return ray;
    const PrimaryRay look =
        makePrimaryRay(view, static_cast<double>(p.positionSS.x), static_cast<double>(p.positionSS.y));
    const auto visible = shaderTest::cast(scene, look.origin, look.dir, 1e-6);
    ray.answerable = visible && (visible->position - ray.truth->position).length() < 1e-4 * (1 + visible->distance) &&
                     visible->normal.dot(ray.truth->normal) > 0.999;
    return ray;
}

// How the tracer did on all mirror rays of a scene.
struct TraceCensus {
    int rays = 0, answerable = 0, found = 0, hits = 0, rightHits = 0, falseHits = 0;
    double worstDepthError = 0; // relative, over the found
    double sumIterations = 0;
    int capped = 0;
    double recall() const { return answerable ? static_cast<double>(found) / answerable : 1; }
    double precision() const { return hits ? static_cast<double>(rightHits) / hits : 1; }
    double falseShare() const { return rays > answerable ? static_cast<double>(falseHits) / (rays - answerable) : 0; }
};
inline TraceCensus traceScene(const View& view, const std::vector<shaderTest::Shape>& scene,
                              const HizSettings& settings, Real tolerancePixels = 2, int stride = 1)
{
    const auto image = renderScene(view, scene);
    TraceCensus census;
    const int width = static_cast<int>(view.imageSize.x), height = static_cast<int>(view.imageSize.y);
    for (int y = 0; y < height; y += stride) {
        for (int x = 0; x < width; x += stride) {
            const auto& seen = image[static_cast<size_t>(y * width + x)];
            if (!seen) continue;
            const MirrorRay ray = makeMirrorRay(view, scene, *seen, x, y);
            gSteps.clear();
            const TraceResult result = traceHiz(view, ray.origin, ray.dir, settings);
            ++census.rays;
            census.sumIterations += result.iterations;
            census.capped += result.reason == kHitReasonIterationCap;
            census.answerable += ray.answerable;
            const bool hit = result.hitClass == kHitClassHit;
            const bool right = hit && ray.truth && length(result.positionSS - ray.truthSS) <= tolerancePixels;
            census.hits += hit;
            census.rightHits += right && ray.answerable;
            census.falseHits += hit && !ray.answerable;
            if (right && ray.answerable) {
                ++census.found;
                const double error = std::fabs(static_cast<double>(result.linearDepth / ray.truthDepth) - 1);
                census.worstDepthError = std::max(census.worstDepthError, error);
            }
        }
    }
    return census;
}
