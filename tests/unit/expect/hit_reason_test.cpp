#include "tests/unit/expect/cases.h"

#include <fstream>
#include <sstream>

using namespace crossray;

// The numbers are written down twice on purpose: the closed forms include nothing of the shaders. This holds them
// together.
TEST(HitReason, hasTheShadersNumbers)
{
    std::ifstream file(std::string(CROSSRAY_SOURCE_DIR) + "/shaders/crossray/shared/outputs.glsl");
    std::stringstream text;
    text << file.rdbuf();
    const std::pair<HitReason, const char*> reasons[] = {
        {HitReason::kNone, "None"},
        {HitReason::kBehindCamera, "BehindCamera"},
        {HitReason::kNoProxyHit, "NoProxyHit"},
        {HitReason::kNoRefractedRay, "NoRefractedRay"},
        {HitReason::kDegenerateRay, "DegenerateRay"},
        {HitReason::kDegenerateInput, "DegenerateInput"},
    };
    for (const auto& [reason, name] : reasons) {
        const std::string line =
            "const int kHitReason" + std::string(name) + " = " + std::to_string(static_cast<int>(reason)) + ";";
        EXPECT_NE(text.str().find(line), std::string::npos) << line;
    }
}
