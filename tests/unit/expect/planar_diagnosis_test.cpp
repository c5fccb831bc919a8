#include "harness/expect/planar_diagnosis.h"

#include "tests/unit/expect/cases.h"

#include <cmath>

namespace crossray::test {

namespace {

std::vector<std::string> describe(const Case& testCase)
{
    return describeDiagnosis(diagnosePlanar(CaseData(testCase), testCase.probes[0]));
}

} // namespace

TEST(PlanarDiagnosis, allIsWell)
{
    const std::vector<std::string> lines = describe(planarMirror());
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0], "The influence volume overlaps the receiver: 384 of its 384 pixels are inside.");
    EXPECT_EQ(lines[1], "The mirror plane's normal is parallel to the surface's: 0 degrees apart at most.");
    EXPECT_EQ(lines[2], "The camera is 4 m in front of the mirror plane.");
}

TEST(PlanarDiagnosis, theInfluenceMissesTheReceiver)
{
    Case testCase = planarMirror();
    testCase.probes[0].influence.center.z = -2;
    EXPECT_EQ(describe(testCase)[0], "The influence volume does not overlap the receiver: none of its 384 pixels is "
                                     "inside, the nearest is 1.5 m away. The probe shows nothing.");
    testCase.probes[0].influence = {VolumeShape::kSphere, {0, 0, -1}, glm::dmat3(1.0), glm::dvec3(1.0)};
    const PlanarDiagnosis sphere = diagnosePlanar(CaseData(testCase), testCase.probes[0]);
    EXPECT_EQ(sphere.insidePixels, 0u);
    EXPECT_NEAR(sphere.nearestMetres, 2.0, 0.02); // the pixels' centres lie around the axis
}

TEST(PlanarDiagnosis, theMirrorIsNotParallel)
{
    Case testCase = planarMirror();
    testCase.probes[0].mirror.normal = {0, std::sin(0.1), std::cos(0.1)};
    EXPECT_EQ(describe(testCase)[1],
              "The mirror plane's normal is not parallel to the surface's: 5.7296 to 5.7296 degrees "
              "apart. The probe does not show what the surface reflects.");
    testCase.probes[0].mirror = {{0, 0, -3.75}, {0, 0, 1}, {}, 8, 8, true};
    EXPECT_EQ(describe(testCase)[1], "The mirror plane's normal is parallel to the surface's: 0 degrees apart at most, "
                                     "but the surface is up to 0.25 m off the plane: what the probe shows is shifted.");
}

TEST(PlanarDiagnosis, theCameraIsNotInFront)
{
    Case testCase = planarMirror();
    testCase.probes[0].mirror.position = {0, 0, 0};
    EXPECT_EQ(describe(testCase)[2],
              "The camera is on the mirror plane: nothing is captured, the probe shows nothing.");
    testCase.probes[0].mirror.position = {0, 0, 2};
    EXPECT_EQ(describe(testCase)[2],
              "The camera is 2 m behind the mirror plane: nothing is captured, the probe shows nothing.");
    testCase.probes[0].mirror.fovYDegrees = 0.0;
    EXPECT_EQ(describe(testCase)[2], "The field of view is 0: nothing is captured, the probe shows nothing.");
}

TEST(PlanarDiagnosis, thereIsNoReceiver)
{
    Case testCase = planarMirror();
    testCase.scene.primitives[0].material = "diffuse";
    const std::vector<std::string> lines = describe(testCase);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0], "There is no receiver: no pixel traces a ray.");
}

} // namespace crossray::test
