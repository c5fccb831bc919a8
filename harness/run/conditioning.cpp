#include "harness/run/conditioning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace crossray {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What an output is measured against at the least: a component that happens to be near zero has no finer truth than the
// vector that it belongs to.
double scaleOf(const OutputInfo& output, const Camera& camera)
{
    if (output.unit == "px") return std::max(camera.width, camera.height);
    if (output.unit == "m") return camera.nearDistance;
    return 1.0;
}

bool isZero(std::span<const double> values)
{
    return std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; });
}

// Raises `plane` to the move of each pixel, and notes the group where that was the largest so far.
void raise(const OutputInfo& output, const Camera& camera, const Plane& before, const Plane& after, InputGroup group,
           Plane& plane, Plane* cause)
{
    const auto channels = static_cast<size_t>(before.channels);
    for (size_t pixel = 0; pixel < before.pixelCount(); ++pixel) {
        const double move =
            measureMove(output, camera, &before.values[pixel * channels], &after.values[pixel * channels]);
        if (move <= plane.values[pixel]) continue;
        plane.values[pixel] = move;
        if (cause != nullptr) cause->values[pixel] = static_cast<double>(group);
    }
}

} // namespace

const OutputConditioning* Conditioning::find(std::string_view output) const
{
    const auto found = std::find_if(outputs.begin(), outputs.end(),
                                    [&](const OutputConditioning& each) { return each.output == output; });
    return found == outputs.end() ? nullptr : &*found;
}

double measureMove(const OutputInfo& output, const Camera& camera, const double* before, const double* after)
{
    const std::span<const double> from(before, static_cast<size_t>(output.channels));
    const std::span<const double> to(after, static_cast<size_t>(output.channels));
    if (std::equal(from.begin(), from.end(), to.begin())) return 0.0;
    if (output.type == OutputType::kHitClass || output.type == OutputType::kCount) return kInfinity;
    double difference = 0.0, magnitude = scaleOf(output, camera);
    for (size_t i = 0; i < from.size(); ++i) {
        if (std::isnan(from[i]) && std::isnan(to[i])) continue;
        if (from[i] == to[i]) continue;
        if (!std::isfinite(from[i]) || !std::isfinite(to[i])) return kInfinity;
        difference = std::max(difference, std::fabs(to[i] - from[i]));
    }
    for (const double value : from) {
        if (std::isfinite(value)) magnitude = std::max(magnitude, std::fabs(value));
    }
    // "None" is a depth or a direction of exactly zero.
    const bool knowsNone = output.type == OutputType::kDirection || output.type == OutputType::kDepth;
    if (knowsNone && isZero(from) != isZero(to)) return kInfinity;
    return difference / floatSpacing(magnitude);
}

const Conditioning& LazyConditioning::get()
{
    const std::lock_guard lock(mutex_);
    if (!made_) made_ = measure_();
    return *made_;
}

const Conditioning* LazyConditioning::known() const
{
    const std::lock_guard lock(mutex_);
    return made_ ? &*made_ : nullptr;
}

namespace {

Conditioning measureAll(const Case& testCase, const Job& floatJob, const Job& doubleJob, const AskCpu& ask)
{
    Conditioning conditioning;
    const std::vector<Plane> floats = ask("cpu32", floatJob), doubles = ask("cpu64", doubleJob);
    const Camera& camera = testCase.camera;
    for (size_t i = 0; i < testCase.outputs.size(); ++i) {
        const Plane none({}, camera.width, camera.height, 1);
        conditioning.outputs.push_back({std::string(testCase.outputs[i].name), none, none, none, none});
        raise(testCase.outputs[i], camera, doubles[i], floats[i], InputGroup::kNone,
              conditioning.outputs.back().rounding, nullptr);
    }
    for (const InputMove& move : listInputMoves(testCase)) {
        const std::vector<Plane> movedFloats = ask("cpu32", moveInputs(testCase, floatJob, Precision::kFloat, move));
        const std::vector<Plane> movedDoubles = ask("cpu64", moveInputs(testCase, doubleJob, Precision::kDouble, move));
        for (size_t i = 0; i < testCase.outputs.size(); ++i) {
            OutputConditioning& output = conditioning.outputs[i];
            raise(testCase.outputs[i], camera, floats[i], movedFloats[i], move.group, output.float32, nullptr);
            raise(testCase.outputs[i], camera, doubles[i], movedDoubles[i], move.group, output.condition,
                  &output.cause);
        }
    }
    return conditioning;
}

} // namespace

Conditioning measureConditioning(const Case& testCase, const Job& floatJob, const Job& doubleJob, const AskCpu& ask)
{
    Conditioning none;
    if (testCase.projection.model == ProjectionModel::kOwn) {
        none.note = "an own tracer is GLSL, and cpu32 and cpu64 are compiled ahead";
        return none;
    }
    try {
        return measureAll(testCase, floatJob, doubleJob, ask);
    } catch (const Error& failure) {
        none.note = failure.what();
        return none;
    }
}

Mask findUndecidable(const Conditioning& conditioning, std::string_view output, double bound)
{
    const OutputConditioning* found = conditioning.find(output);
    if (found == nullptr) return {};
    Mask mask(found->condition.pixelCount());
    for (size_t pixel = 0; pixel < mask.size(); ++pixel)
        mask[pixel] = found->condition.values[pixel] > bound ? 1 : 0;
    return mask;
}

std::string describeConditioning(const OutputConditioning& output, size_t pixel)
{
    const double condition = output.condition.values[pixel];
    if (condition == 0.0) return {};
    const auto group = static_cast<InputGroup>(static_cast<int>(output.cause.values[pixel]));
    const std::string of =
        group == InputGroup::kAll ? "for an ulp of all inputs at once" : fmt::format("for an ulp of {}", nameOf(group));
    if (std::isinf(condition)) return fmt::format("{} flips {}", output.output, of);
    return fmt::format("{} moves by {:.2g} ulp {}", output.output, condition, of);
}

std::vector<PixelConditioning> listAt(const Conditioning& conditioning, size_t pixel)
{
    std::vector<PixelConditioning> list;
    for (const OutputConditioning& output : conditioning.outputs) {
        const auto group = static_cast<InputGroup>(static_cast<int>(output.cause.values[pixel]));
        list.push_back({output.output, output.condition.values[pixel], output.float32.values[pixel],
                        output.rounding.values[pixel],
                        group == InputGroup::kNone ? std::string() : std::string(nameOf(group)),
                        describeConditioning(output, pixel)});
    }
    return list;
}

ConditioningResult summarize(const Conditioning& conditioning, const std::vector<bool>& tracedPixels)
{
    ConditioningResult result;
    result.bound = kUndecidableAbove;
    result.note = conditioning.note;
    for (const OutputConditioning& output : conditioning.outputs) {
        ConditioningResult::Output& entry = result.outputs.emplace_back();
        entry.output = output.output;
        Comparison statistics;
        std::vector<double> finite;
        double worst = 0.0;
        for (size_t pixel = 0; pixel < tracedPixels.size(); ++pixel) {
            if (!tracedPixels[pixel]) continue;
            ++entry.pixels;
            const double condition = output.condition.values[pixel];
            const bool isUndecidable = condition > result.bound;
            if (isUndecidable) ++entry.undecidable;
            if (!isUndecidable && std::max(output.float32.values[pixel], output.rounding.values[pixel]) > result.bound)
                ++entry.fragile;
            if (std::isfinite(condition)) finite.push_back(condition);
            if (condition <= worst) continue;
            worst = condition;
            const auto width = static_cast<size_t>(output.condition.width);
            entry.worst = {static_cast<int>(pixel % width), static_cast<int>(pixel / width), condition,
                           static_cast<int>(output.cause.values[pixel])};
        }
        std::sort(finite.begin(), finite.end());
        const auto rank = [&](double share) {
            return finite.empty() ? 0.0 : finite[static_cast<size_t>(share * static_cast<double>(finite.size() - 1))];
        };
        entry.median = rank(0.5);
        entry.p95 = rank(0.95);
        entry.max = rank(1.0);
    }
    return result;
}

std::vector<Plane> listConditioningPlanes(const Conditioning& conditioning)
{
    std::vector<Plane> planes;
    const auto add = [&](const std::string& name, const Plane& plane) {
        planes.push_back(plane), planes.back().name = name;
    };
    for (const OutputConditioning& output : conditioning.outputs) {
        add(output.output + "@condition", output.condition);
        add(output.output + "@cpu32", output.float32);
        add(output.output + "@rounding", output.rounding);
        add(output.output + "@cause", output.cause);
    }
    return planes;
}

bool excusesPixels(const Case& testCase)
{
    return std::any_of(testCase.expectations.begin(), testCase.expectations.end(),
                       [](const Expectation& expectation) { return expectation.undecidable.has_value(); });
}

} // namespace crossray
