#include "harness/pass/moved_inputs.h"

#include "harness/pass/bindings.h"
#include "harness/pass/params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace crossray {

namespace {

// Places of numbers for the hash: equal fields of different parameter blocks hold equal numbers and so move alike.
enum Field : uint32_t {
    kViewFromWorld = 1,
    kWorldFromView,
    kClipFromView,
    kSlope,
    kDepthTerms,
    kWorldFromProxy,
    kMaterial,
    kAbsorption,
    kProxyCenter,
    kProxyExtents,
    kTracing,
    kLinearTracing,
    kPatches,
    kPreviousView,
    kPreviousSlope,
    kProbeBounds,
    kProbeItem = 32,   // and up to 31 more for each item
    kPlanarItem = 512, // likewise
    kImage = 1024,     // and its binding
};

// 1 or -1 for one number of one field.
double signOf(const InputMove& move, uint32_t field, uint32_t place)
{
    double sign = move.isOpposite ? -1.0 : 1.0;
    if (move.pattern == 0) return sign;
    uint64_t bits = (uint64_t{field} << 32U | place) + uint64_t{move.pattern} * 0x9E3779B97F4A7C15U;
    bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9U; // SplitMix64, Steele, Lea and Flood 2014
    bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBU;
    return ((bits >> 40U) & 1U) != 0 ? sign : -sign;
}

class Mover {
  public:
    explicit Mover(const InputMove& move) : move_(move) {}

    bool moves(InputGroup group) const { return move_.group == group || move_.group == InputGroup::kAll; }

    template <class Real>
    void number(InputGroup group, uint32_t field, uint32_t place, Real& value) const
    {
        if (!moves(group)) return;
        const auto exact = static_cast<double>(value);
        value = static_cast<Real>(exact + signOf(move_, field, place) * floatSpacing(exact));
    }

    template <class Vector>
    void vector(InputGroup group, uint32_t field, Vector& value, int first = 0, int last = 3) const
    {
        for (int i = first; i <= last; ++i)
            number(group, field, static_cast<uint32_t>(i), value[i]);
    }

    template <class Matrix>
    void matrix(InputGroup group, uint32_t field, Matrix& value) const
    {
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row)
                number(group, field, static_cast<uint32_t>(column * 4 + row), value[column][row]);
        }
    }

    // `fixed` stays as it is: it is a sign and no measurement.
    void image(InputGroup group, uint32_t binding, ImageDesc& image, double fixed) const
    {
        if (!moves(group)) return;
        for (size_t i = 0; i < image.texels.size(); ++i) {
            double& texel = image.texels[i];
            if (texel == fixed) continue;
            texel += signOf(move_, kImage + binding, static_cast<uint32_t>(i)) * floatSpacing(texel);
        }
    }

  private:
    InputMove move_;
};

template <class Params>
void movePassParams(const Mover& mover, Params& params)
{
    using enum InputGroup;
    mover.matrix(kCamera, kViewFromWorld, params.viewFromWorld);
    mover.matrix(kCamera, kWorldFromView, params.worldFromView);
    mover.matrix(kCamera, kClipFromView, params.clipFromView);
    mover.vector(kCamera, kSlope, params.imageSizeAndSlope, 2, 3);
    mover.vector(kCamera, kDepthTerms, params.depthTerms);
    mover.matrix(kSettings, kWorldFromProxy, params.worldFromProxy);
    mover.vector(kSettings, kMaterial, params.material);
    mover.vector(kSettings, kAbsorption, params.absorption);
    mover.vector(kSettings, kProxyCenter, params.proxyCenterWS);
    mover.vector(kSettings, kProxyExtents, params.proxyExtents);
    mover.vector(kSettings, kTracing, params.tracing, 0, 1);
    mover.vector(kSettings, kLinearTracing, params.linearTracing, 0, 1);
    mover.vector(kSettings, kPatches, params.patches, 0, 1);
    mover.matrix(kHistory, kPreviousView, params.previousViewFromWorld);
    mover.vector(kHistory, kPreviousSlope, params.history, 0, 1);
}

template <class Params>
void movePyramidParams(const Mover& mover, Params& params)
{
    mover.vector(InputGroup::kCamera, kDepthTerms, params.depthTerms);
}

template <class Params>
void moveSurfaceParams(const Mover& mover, Params& params)
{
    using enum InputGroup;
    mover.matrix(kCamera, kViewFromWorld, params.viewFromWorld);
    mover.vector(kCamera, kSlope, params.imageSizeAndSlope, 2, 3);
    mover.vector(kCamera, kDepthTerms, params.depthTerms);
    mover.vector(kSettings, kPatches, params.patches, 0, 1);
}

template <class Params>
void moveProbeParams(const Mover& mover, Params& params)
{
    constexpr InputGroup kGroup = InputGroup::kProbes;
    mover.vector(kGroup, kProbeBounds, params.skyUpWS, 0, 2);
    mover.vector(kGroup, kProbeBounds + 1, params.objectMinWS, 0, 2);
    mover.vector(kGroup, kProbeBounds + 2, params.objectMaxWS, 0, 2);
    uint32_t field = kProbeItem;
    for (auto& item : params.items) {
        mover.matrix(kGroup, field++, item.worldFromInfluence);
        mover.matrix(kGroup, field++, item.worldFromProxy);
        for (auto* vector :
             {&item.influenceCenterWS, &item.influenceExtents, &item.blendPositive, &item.blendNegative,
              &item.blendNormalPositive, &item.blendNormalNegative, &item.facePositive, &item.faceNegative,
              &item.proxyCenterWS, &item.proxyExtents, &item.capturePositionWS, &item.boxMinWS, &item.decode})
            mover.vector(kGroup, field++, *vector);
        mover.vector(kGroup, field++, item.boxMaxWS, 0, 2); // w is the importance, which is compared for equality
        mover.vector(kGroup, field++, item.lookUp, 0, 0);   // y and z are flags
    }
}

template <class Params>
void movePlanarParams(const Mover& mover, Params& params)
{
    uint32_t field = kPlanarItem;
    for (auto& item : params.items) {
        mover.vector(InputGroup::kProbes, field++, item.pointWS, 0, 2);
        mover.vector(InputGroup::kProbes, field++, item.normalWS, 0, 2);
        mover.vector(InputGroup::kProbes, field++, item.field, 0, 1); // z is a flag
    }
}

template <class Params, class Move>
void rewrite(std::vector<std::byte>& bytes, const Move& move)
{
    Params params;
    std::memcpy(&params, bytes.data(), sizeof(Params));
    move(params);
    std::memcpy(bytes.data(), &params, sizeof(Params));
}

// By the pass that reads it: each has a block of its own at the same binding.
void moveParams(const Mover& mover, const std::string& entry, Precision precision, std::vector<std::byte>& bytes)
{
    const auto apply = [&]<class Params32, class Params64>(const auto& move) {
        if (precision == Precision::kFloat) {
            rewrite<Params32>(bytes, move);
        } else {
            rewrite<Params64>(bytes, move);
        }
    };
    if (entry == "entry/surface_pyramid.comp") {
        apply.operator()<layout32::SurfaceParams, layout64::SurfaceParams>(
            [&](auto& params) { moveSurfaceParams(mover, params); });
    } else if (entry == "entry/depth_pyramid.comp" || entry == "entry/color_pyramid.comp") {
        apply.operator()<layout32::PyramidParams, layout64::PyramidParams>(
            [&](auto& params) { movePyramidParams(mover, params); });
    } else {
        apply.operator()<layout32::PassParams, layout64::PassParams>(
            [&](auto& params) { movePassParams(mover, params); });
    }
}

void moveBuffer(const Mover& mover, const Binding& binding, const std::string& entry, Precision precision,
                BufferDesc& buffer)
{
    const bool isFloat = precision == Precision::kFloat;
    const auto probes = [&](auto& params) { moveProbeParams(mover, params); };
    const auto planar = [&](auto& params) { movePlanarParams(mover, params); };
    if (binding.binding == kParamsBinding) {
        moveParams(mover, entry, precision, buffer.bytes);
    } else if (binding.binding == kProbeParamsBinding) {
        isFloat ? rewrite<layout32::ProbeParams>(buffer.bytes, probes)
                : rewrite<layout64::ProbeParams>(buffer.bytes, probes);
    } else if (binding.binding == kPlanarParamsBinding) {
        isFloat ? rewrite<layout32::PlanarParams>(buffer.bytes, planar)
                : rewrite<layout64::PlanarParams>(buffer.bytes, planar);
    }
}

// The depth that says that nothing is there. A reversed one is 0, which has no last place.
double clearedDepth(const Case& testCase)
{
    return testCase.camera.depthConvention == DepthConvention::kStandard ? 1.0 : 0.0;
}

void moveImage(const Mover& mover, const Case& testCase, uint32_t binding, ImageDesc& image)
{
    using enum InputGroup;
    if (binding == kDepthBinding) mover.image(kDepth, binding, image, clearedDepth(testCase));
    if (binding == kNormalBinding) mover.image(kNormal, binding, image, 0.0);
    if (binding == kThicknessBinding) mover.image(kSettings, binding, image, 0.0);
    if (binding == kMotionBinding) mover.image(kHistory, binding, image, 0.0);
}

} // namespace

std::string_view nameOf(InputGroup group)
{
    constexpr std::array<std::string_view, kInputGroups> kNames{
        "nothing", "depth", "normal", "camera", "settings", "probes", "previous frame", "all inputs at once"};
    return kNames[static_cast<size_t>(group)];
}

double floatSpacing(double value)
{
    if (value == 0.0 || !std::isfinite(value)) return 0.0;
    const float magnitude = std::fabs(static_cast<float>(value));
    if (!std::isfinite(magnitude)) return 0.0;
    const float next = std::nextafter(magnitude, std::numeric_limits<float>::infinity());
    return std::isfinite(next) ? static_cast<double>(next) - static_cast<double>(magnitude) : 0.0;
}

std::vector<InputMove> listInputMoves(const Case& testCase)
{
    std::vector<InputGroup> groups{InputGroup::kDepth, InputGroup::kNormal, InputGroup::kCamera, InputGroup::kSettings};
    if (!testCase.probes.empty()) groups.push_back(InputGroup::kProbes);
    if (testCase.history) groups.push_back(InputGroup::kHistory);
    std::vector<InputMove> moves;
    for (const InputGroup group : groups) {
        for (const uint32_t pattern : {0U, 1U})
            moves.insert(moves.end(), {{group, pattern, false}, {group, pattern, true}});
    }
    // What no group brings about alone, several may together; more patterns find more of it.
    for (const uint32_t pattern : {2U, 3U, 4U})
        moves.insert(moves.end(), {{InputGroup::kAll, pattern, false}, {InputGroup::kAll, pattern, true}});
    return moves;
}

Job moveInputs(const Case& testCase, const Job& job, Precision precision, const InputMove& move)
{
    Job moved = job;
    const Mover mover(move);
    std::vector<bool> isImageDone(job.images.size()), isBufferDone(job.buffers.size());
    for (const DispatchDesc& dispatch : job.dispatches) {
        const std::string& entry = job.programs[dispatch.program].entry;
        for (const Binding& binding : dispatch.bindings) {
            const bool isImage = binding.what == Binding::What::kImage;
            std::vector<bool>::reference done = isImage ? isImageDone[binding.index] : isBufferDone[binding.index];
            if (done) continue;
            done = true;
            if (isImage) {
                moveImage(mover, testCase, binding.binding, moved.images[binding.index]);
            } else {
                moveBuffer(mover, binding, entry, precision, moved.buffers[binding.index]);
            }
        }
    }
    return moved;
}

} // namespace crossray
