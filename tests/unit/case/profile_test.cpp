// probe_profile and [profile]: what they become, and what each profile refuses.
#include "tests/unit/case/case_files.h"

using namespace crossray;

namespace {

const std::string kSolidProbe = "[probe.environment]\nsolid = [1, 0.5, 0.25]\n";

// A box probe with those keys of [[probe]] and of its influence.
std::string probeWith(const std::string& keys = "", const std::string& influence = "")
{
    return "[[probe]]\n" + keys + "[probe.influence]\nshape = \"box\"\nhalf_extents = [1, 2, 3]\n" + influence +
           kSolidProbe;
}

} // namespace

class Profile : public CaseFiles {
  protected:
    static std::string caseOf(const std::string& profile, const std::string& tables)
    {
        return complete("[scene]\nprimitives = [{ shape = \"sphere\", radius = 1, material = \"mirror\" }]\n" + tables,
                        "probe_profile = \"" + profile + "\"");
    }
    // The refusal without its position.
    std::string reasonFor(const std::string& text) const
    {
        const std::string message = refusal(text);
        return message.substr(std::min(message.find(": "), message.size() - 2) + 2);
    }
};

TEST_F(Profile, settingsAreRead)
{
    const Case testCase = readOne(
        caseOf("urp_unity", "[profile]\nblending = false\nbox_projection = false\nbox_projection_form = \"select\"\n"
                            "forward_plus = true\nhalf_precision = true\nroughness_mip = \"exact\"\n"
                            "color_space = \"gamma\"\n" +
                                probeWith("box_projection = true\nrgbm = { alpha = 0.5, range = 5, exponent = 2.2, "
                                          "alpha_weight = 0.75 }\n",
                                          "blend = 0.5\n")));
    EXPECT_EQ(testCase.probeProfile, ProbeProfile::kUrpUnity);
    const ProfileSettings& profile = testCase.profile;
    EXPECT_FALSE(profile.blending);
    EXPECT_FALSE(profile.boxProjection);
    EXPECT_EQ(profile.boxProjectionForm, BoxProjectionForm::kSelect);
    EXPECT_TRUE(profile.forwardPlus);
    EXPECT_TRUE(profile.halfPrecision);
    EXPECT_TRUE(profile.exactMip);
    EXPECT_TRUE(profile.gammaSpace);
    const Probe& probe = testCase.probes.at(0);
    EXPECT_TRUE(probe.boxProjection);
    ASSERT_TRUE(probe.rgbm);
    EXPECT_EQ(probe.rgbm->alpha, 0.5);
    EXPECT_EQ(probe.rgbm->range, 5.0);
    EXPECT_EQ(probe.rgbm->exponent, 2.2);
    EXPECT_EQ(probe.rgbm->alphaWeight, 0.75);
    EXPECT_EQ(probe.blend.positive.x, 0.5);
}

TEST_F(Profile, nothingSaidIsBlendingInLinearSpace)
{
    const Case testCase = readOne(caseOf("builtin", probeWith()));
    EXPECT_EQ(testCase.probeProfile, ProbeProfile::kBuiltIn);
    EXPECT_TRUE(testCase.profile.blending);
    EXPECT_TRUE(testCase.profile.boxProjection);
    EXPECT_EQ(testCase.profile.boxProjectionForm, BoxProjectionForm::kDivision);
    EXPECT_FALSE(testCase.profile.exactMip);
    EXPECT_FALSE(testCase.probes.at(0).boxProjection);
    EXPECT_FALSE(testCase.probes.at(0).rgbm);
}

TEST_F(Profile, whatOnlyHdrpHasIsRefused)
{
    for (const std::string profile : {"builtin", "urp_doc", "urp_unity"}) {
        const std::string end = " is not allowed where \"probe_profile\" is \"" + profile + "\"";
        for (const std::string key :
             {"weight = 0.5", "distance_based_roughness = false", "proxy = { shape = \"box\" }"})
            EXPECT_EQ(reasonFor(caseOf(profile, probeWith(key + "\n"))),
                      "\"" + key.substr(0, key.find(' ')) + "\"" + end);
        for (const std::string key :
             {"rotation = [0, 1, 0]", "blend_positive = [1, 1, 1]", "blend_normal = 1", "face_negative = [1, 1, 1]"})
            EXPECT_EQ(reasonFor(caseOf(profile, probeWith("", key + "\n"))),
                      "\"" + key.substr(0, key.find(' ')) + "\"" + end);
        EXPECT_EQ(
            reasonFor(caseOf(profile, "[[probe]]\n[probe.influence]\nshape = \"sphere\"\nradius = 1\n" + kSolidProbe)),
            "\"shape\" is \"sphere\"; box is allowed where \"probe_profile\" is \"" + profile + "\"");
    }
}

TEST_F(Profile, whatHdrpDoesNotHaveIsRefused)
{
    const std::string end = " is not allowed where \"probe_profile\" is \"hdrp\"";
    EXPECT_EQ(reasonFor(caseOf("hdrp", "[profile]\nblending = true\n" + probeWith())), "\"profile\"" + end);
    EXPECT_EQ(reasonFor(caseOf("hdrp", probeWith("box_projection = true\n"))), "\"box_projection\"" + end);
    EXPECT_EQ(reasonFor(caseOf("hdrp", probeWith("rgbm = { alpha = 1 }\n"))), "\"rgbm\"" + end);
}

TEST_F(Profile, theCodesSettingsAreOfItsProfileAlone)
{
    for (const std::string profile : {"builtin", "urp_doc"})
        for (const std::string key : {"forward_plus", "half_precision"})
            EXPECT_EQ(reasonFor(caseOf(profile, "[profile]\n" + key + " = true\n" + probeWith())),
                      "\"" + key + "\" is not allowed where \"probe_profile\" is \"" + profile + "\"");
}

TEST_F(Profile, theObjectHasBounds)
{
    EXPECT_EQ(reasonFor(complete("[scene]\nprimitives = [{ shape = \"plane\", material = \"mirror\" }]\n" + probeWith(),
                                 "probe_profile = \"urp_doc\"")),
              "\"probe_profile\" chooses probes by the object's bounds, and a plane of mirror has none; one with "
              "half_extents is "
              "allowed");
    EXPECT_NO_THROW(readOne(
        complete("[scene]\nprimitives = [{ shape = \"plane\" }]\n" + probeWith(), "probe_profile = \"urp_doc\"")));
}
