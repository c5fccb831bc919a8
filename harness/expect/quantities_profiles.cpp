// What the Built-in and the URP profile answer for, by name.
#include "harness/expect/analytic_profiles.h"
#include "harness/expect/quantities.h"

namespace crossray {

namespace {

PixelAnswer answerProfile(const QuantityInput& input, size_t pixel)
{
    const Case& testCase = input.testCase;
    const SurfacePoint& surface = (*input.surfaces)[pixel];
    PixelAnswer answer;
    answer.ray = computeEffectRay(testCase, surface);
    if (answer.ray.status != HitReason::kNone) return answer; // no ray, no tier
    const ProfileAnswer profile = answerByProfile(testCase, surface.positionWS, answer.ray);
    answer.radiance = profile.color;
    answer.hitWeight = 1.0; // the shares are in it
    for (size_t probe = 0; probe < profile.shares.probes.size(); ++probe) {
        if (probe < 4) answer.share.probes[static_cast<int>(probe)] = profile.shares.probes[probe];
        answer.share.tiers.y += profile.shares.probes[probe];
    }
    answer.share.tiers.w = profile.shares.sky;
    answer.share.probeDirWS = profile.firstDirWS;
    answer.share.probeMipLevel = profile.firstMip;
    return answer;
}

PixelAnswer answerPublishedBox(const QuantityInput& input, size_t pixel)
{
    PixelAnswer answer;
    answer.ray = computeEffectRay(input.testCase, (*input.surfaces)[pixel]);
    answer.share.probeDirWS =
        publishedBoxDirection(input.testCase.probes.at(0), {answer.ray.originWS, answer.ray.dirWS});
    return answer;
}

std::string refuseOtherProfiles(const Case& testCase, Output)
{
    if (testCase.probeProfile == ProbeProfile::kHdrp) return "it is of the profiles builtin, urp_doc and urp_unity";
    return refuseProfile(testCase);
}

std::string refuseToPass(const Case& testCase, Output)
{
    if (!testCase.mustFail || testCase.probes.empty())
        return "it is wrong; a case with must_fail and a probe may be held to it";
    return {};
}

} // namespace

std::vector<Quantity> profileQuantities()
{
    using enum Output;
    return {
        makeQuantity("probe_profile",
                     "What the Built-in or the URP profile gives each probe and the sky, where and at which level the "
                     "first is read, and the colour of all; of environments with one colour a level.",
                     {kColor, kTierWeights, kProbeWeights, kProbeDirWS, kProbeMipLevel}, nullptr, refuseOtherProfiles,
                     answerProfile),
        makeQuantity("box_projection_published",
                     "Direction by the published optimisation of box projection, which takes the face behind the ray; "
                     "for must_fail alone.",
                     {kProbeDirWS}, nullptr, refuseToPass, answerPublishedBox),
    };
}

} // namespace crossray
