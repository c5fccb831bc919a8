#include "harness/expect/expect.h"

#include "harness/base/error.h"

#include <fmt/format.h>

namespace crossray {

namespace {

// Quantities of the truth that exist only where a ray leaves. In recorded data a ray that meets nothing has no known
// direction.
bool speaksOfTheRay(const Expectation& expectation)
{
    const auto* truth = std::get_if<TruthSource>(&expectation.source);
    if (truth == nullptr) return false;
    const std::string& name = truth->quantity;
    return name == "ray_direction" || name == "ray_origin" || name == "refracted_exit_direction" ||
           name == "path_length";
}

} // namespace

Mask makeMask(const CaseData& data, const Expectation& expectation, const Plane* hitSuccess)
{
    const std::vector<bool>& traced = data.tracedPixels();
    Mask mask(traced.size(), 1);
    if (expectation.where != Where::kAll) mask.assign(traced.begin(), traced.end());

    if (expectation.where == Where::kAnswerable || expectation.where == Where::kAnswerableHits) {
        const Truth& truth = data.truth();
        for (size_t pixel = 0; pixel < mask.size(); ++pixel) {
            if (truth.pixels[pixel].screen != ScreenKnowledge::kVisible) mask[pixel] = 0;
        }
    }
    if (expectation.where == Where::kHits || expectation.where == Where::kAnswerableHits) {
        if (hitSuccess == nullptr || hitSuccess->values.size() != mask.size()) {
            throw InputError(expectation.position,
                             fmt::format("{} is judged where HitSuccess says hit, which the case must write as well",
                                         expectation.output.name));
        }
        for (size_t pixel = 0; pixel < mask.size(); ++pixel) {
            if (hitSuccess->values[pixel] != static_cast<double>(HitClass::kHit)) mask[pixel] = 0;
        }
    }
    if (speaksOfTheRay(expectation)) {
        const Truth& truth = data.truth();
        for (size_t pixel = 0; pixel < mask.size(); ++pixel) {
            const TruthPixel& here = truth.pixels[pixel];
            // Where::kAll keeps the pixels that trace nothing: there the answer is known to be "none".
            const bool unknown = here.screen == ScreenKnowledge::kNoRay || here.rayDirWS == glm::dvec3(0.0);
            if (traced[pixel] && unknown) mask[pixel] = 0;
        }
    }
    return mask;
}

} // namespace crossray
