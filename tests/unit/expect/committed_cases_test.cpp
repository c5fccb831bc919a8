// Every committed case can be judged: its expectations name what exists, and their planes and masks can be made.
#include "tests/unit/expect/cases.h"

#include <algorithm>

using namespace crossray;

namespace {

void checkExpectation(const CaseData& data, const Expectation& expectation)
{
    const Case& testCase = data.testCase();
    Plane hits("HitSuccess", testCase.camera.width, testCase.camera.height, 1, 1.0);
    const Mask mask = makeMask(data, expectation, &hits);
    if (!testCase.mustFail) {
        EXPECT_NE(std::count(mask.begin(), mask.end(), 1), 0)
            << expectation.position.format() << ": " << testCase.name << ": no pixel is compared";
    }
    if (std::holds_alternative<AgreeSource>(expectation.source)) return;
    const auto plane = makeExpected(data, expectation);
    if (!plane) return; // a missing golden is the run's to report
    for (const double value : plane->values) {
        ASSERT_TRUE(std::isfinite(value)) << expectation.position.format() << ": " << testCase.name;
    }
    if (expectation.budget || testCase.mustFail) return;
    if (std::holds_alternative<BoundSource>(expectation.source)) return; // no plane that the output should equal
    // The expectation against itself: the tolerance is one that its type knows, and no pixel fails.
    const Comparison same = compare(expectation.output.type, *plane, *plane, mask, expectation.tolerance);
    EXPECT_TRUE(same.passed) << expectation.position.format() << ": " << testCase.name << ": " << same.reason;
}

} // namespace

TEST(CommittedCases, canAllBeJudged)
{
    const std::filesystem::path root = std::filesystem::path(CROSSRAY_SOURCE_DIR) / "cases";
    for (const std::filesystem::path& file : findCaseFiles(root)) {
        for (const Case& testCase : readCaseFile(file)) {
            try {
                const CaseData data(testCase);
                for (const Expectation& expectation : testCase.expectations)
                    checkExpectation(data, expectation);
            } catch (const Error& error) {
                ADD_FAILURE() << testCase.name << ": " << error.what();
            }
        }
    }
}
