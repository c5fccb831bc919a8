// The object by whose bounds probes are chosen, against numbers by hand.
#include "harness/pass/object_bounds.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace crossray;

namespace {

Primitive primitiveOf(PrimitiveShape shape, const glm::dvec3& center, const glm::dvec3& halfExtents,
                      const std::string& material = "mirror")
{
    Primitive primitive;
    primitive.shape = shape;
    primitive.center = center;
    primitive.halfExtents = halfExtents;
    primitive.material = material;
    return primitive;
}

} // namespace

TEST(ObjectBounds, holdAllThatTracesAndNothingElse)
{
    Case testCase;
    EXPECT_EQ(findObjectBounds(testCase).maxWS, glm::dvec3(0.0));
    Primitive turned = primitiveOf(PrimitiveShape::kBox, {4, 0, 0}, {1, 1, 3});
    const double s = std::sqrt(0.5);
    turned.worldFromLocal = glm::dmat3(s, s, 0, -s, s, 0, 0, 0, 1); // by 45 degrees about z
    testCase.scene.primitives = {turned, primitiveOf(PrimitiveShape::kSphere, {0, 2, 0}, {}),
                                 primitiveOf(PrimitiveShape::kPlane, {0, 0, -5}, {2, 1, 9}),
                                 primitiveOf(PrimitiveShape::kBox, {50, 0, 0}, {1, 1, 1}, "diffuse"),
                                 primitiveOf(PrimitiveShape::kBox, {0, 50, 0}, {1, 1, 1}, "glass")};
    ObjectBounds bounds = findObjectBounds(testCase);
    EXPECT_NEAR(bounds.maxWS.x, 4.0 + std::sqrt(2.0), 1e-15);
    EXPECT_EQ(bounds.maxWS.y, 3.0);
    EXPECT_EQ(bounds.maxWS.z, 3.0);
    EXPECT_EQ(bounds.minWS.x, -2.0);
    EXPECT_EQ(bounds.minWS.z, -5.0); // a plane is flat
    testCase.effect = TraceEffect::kRefraction;
    bounds = findObjectBounds(testCase);
    EXPECT_EQ(bounds.minWS, glm::dvec3(-1, 49, -1));
}

TEST(ObjectBounds, coveredAreaIsThatOfTheFacesInside)
{
    const ObjectBounds cube{{0, 0, 0}, {2, 2, 2}};
    EXPECT_EQ(measureCoveredArea(cube, {{-1, -1, -1}, {3, 3, 3}}), 24.0);
    // Half of it: one face, and half of four.
    EXPECT_EQ(measureCoveredArea(cube, {{-1, -1, -1}, {1, 3, 3}}), 4.0 + 4.0 * 2.0);
    EXPECT_EQ(measureCoveredArea(cube, {{0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}}), 0.0); // within, no face
    EXPECT_EQ(measureCoveredArea(cube, {{5, 5, 5}, {6, 6, 6}}), 0.0);
    // Both sides of a flat object.
    EXPECT_EQ(measureCoveredArea({{0, 0, 0}, {2, 0, 3}}, {{-1, -1, -1}, {1, 1, 9}}), 6.0);
}
