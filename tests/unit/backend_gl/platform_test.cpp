// What the platform does in silence. No wish of this project is tested here: these are facts about one version of Mesa
// that shape the shaders and the expected data, written down so that a newer version that differs is noticed.
#include "tests/unit/backend_gl/gl_test_device.h"

using namespace crossray;

namespace {

constexpr double kLoopBudget = 65535;

class GlPlatform : public GlTest {
  protected:
    void SetUp() override
    {
        GlTest::SetUp();
        if (!IsSkipped() && device_->fingerprint().driver != "Mesa 22.3.6")
            GTEST_SKIP() << "facts about Mesa 22.3.6; this is " << device_->fingerprint().driver;
    }

    bool cutsLoops() const { return isRenderer("llvmpipe"); }
};

} // namespace

TEST_F(GlPlatform, llvmpipeEndsALoopAt65535IterationsInSilence)
{
    const Job job = makeJob(makeGlsl("for (int i = 0; i < 70000; ++i) result[0] += 1.0;\nresult[1] = 1.0;"), 2);
    const JobResult result = run(job);
    EXPECT_EQ(result.readbacks[0][0], cutsLoops() ? kLoopBudget : 70000.0);
    EXPECT_EQ(result.readbacks[0][1], 1.0); // the shader goes on as if the condition had ended the loop
    EXPECT_TRUE(result.messages.empty());
}

// The number is a budget of the whole invocation: loops that each stay far below it can use it up together.
TEST_F(GlPlatform, llvmpipeCountsAllLoopsOfAnInvocationTogether)
{
    const auto values = run(makeJob(makeGlsl("for (int i = 0; i < 40000; ++i) result[0] += 1.0;\n"
                                             "for (int i = 0; i < 40000; ++i) result[1] += 1.0;"),
                                    2))
                            .readbacks[0];
    EXPECT_EQ(values[0], 40000.0);
    EXPECT_EQ(values[1], cutsLoops() ? kLoopBudget - 40000.0 - 1.0 : 40000.0);

    const double nested = run(makeJob(makeGlsl("for (int j = 0; j < 500; ++j)\n"
                                               "  for (int i = 0; i < 200; ++i) result[0] += 1.0;"),
                                      1))
                              .readbacks[0][0];
    if (cutsLoops())
        EXPECT_LT(nested, kLoopBudget);
    else
        EXPECT_EQ(nested, 100000.0);
}

// And of all invocations that share a vector register: where they part ways, each pays for the loops of the others.
TEST_F(GlPlatform, llvmpipeCountsTheLoopsOfNeighboursTogether)
{
    const auto values =
        run(makeJob(makeGlsl("uint i = gl_LocalInvocationIndex;\n"
                             "if ((i & 1u) == 0u) { for (int k = 0; k < 40000; ++k) result[i] += 1.0; }\n"
                             "else { for (int k = 0; k < 40000; ++k) result[i] += 1.0; }",
                             "", 2),
                    2))
            .readbacks[0];
    EXPECT_EQ(values[0], 40000.0);
    if (cutsLoops())
        EXPECT_LT(values[1], kLoopBudget - 40000.0);
    else
        EXPECT_EQ(values[1], 40000.0);
}

// By the text of the specification step(edge, x) is 0 where x < edge and 1 otherwise, so 1 with a NaN on either side.
// Mesa's OpenGL asks for x >= edge instead; its Vulkan does not. The NaN is made at run time: a constant would be
// folded.
TEST_F(GlPlatform, stepWithNanIsZero)
{
    Job job = makeJob(makeGlsl("float nan = result[0] / result[0];\n"
                               "result[1] = step(nan, 0.5);\nresult[2] = step(0.5, nan);\nresult[3] = step(nan, nan);\n"
                               "result[4] = nan == nan ? 1.0 : 0.0;"),
                      5);
    EXPECT_EQ(run(job).readbacks[0], (std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.0}));
}
