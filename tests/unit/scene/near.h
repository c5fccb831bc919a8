// Vectors that are close, for the tests of this folder.
#pragma once

#include <glm/glm.hpp>
#include <gtest/gtest.h>

inline void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double bound)
{
    EXPECT_LE(glm::length(actual - expected), bound) << actual.x << ", " << actual.y << ", " << actual.z << " for "
                                                     << expected.x << ", " << expected.y << ", " << expected.z;
}
