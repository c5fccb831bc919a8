// Cases by hand, for the tests of the expected data.
#pragma once

#include "harness/base/error.h"
#include "harness/expect/analytic.h"
#include "harness/expect/expect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace crossray::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

inline Primitive sphere(const glm::dvec3& center, double radius, const std::string& material)
{
    Primitive primitive;
    primitive.shape = PrimitiveShape::kSphere;
    primitive.center = center;
    primitive.radius = radius;
    primitive.material = material;
    return primitive;
}

inline Primitive box(const glm::dvec3& center, const glm::dvec3& halfExtents, const std::string& material)
{
    Primitive primitive;
    primitive.shape = PrimitiveShape::kBox;
    primitive.center = center;
    primitive.halfExtents = halfExtents;
    primitive.material = material;
    return primitive;
}

// The plane z = `z`, facing +z, with a checker.
inline Primitive wall(double z, const std::string& material = "diffuse")
{
    Primitive primitive;
    primitive.center = {0.0, 0.0, z};
    primitive.material = material;
    primitive.radiance.pattern = RadiancePattern::kChecker;
    return primitive;
}

// A 24x16 camera at the origin that looks down -z.
inline Case makeCase(std::vector<Primitive> primitives, TraceEffect effect)
{
    Case testCase;
    testCase.name = "test";
    testCase.camera.width = 24;
    testCase.camera.height = 16;
    testCase.scene.primitives = std::move(primitives);
    testCase.effect = effect;
    return testCase;
}

// A glass sphere of radius 1 before a wall: the sphere model is exact.
inline Case glassSphere(double ior = 1.5)
{
    Case testCase = makeCase({sphere({0.1, -0.05, -4.0}, 1.0, "glass"), wall(-9.0)}, TraceEffect::kRefraction);
    testCase.scene.primitives[0].ior = ior;
    testCase.material.refractionModel = RefractionModel::kSphere;
    testCase.material.ior = ior;
    testCase.material.thickness = 2.0;
    return testCase;
}

// A mirror at z = -4 with a planar probe about it.
inline Case planarMirror()
{
    Case testCase = makeCase({wall(-4.0, "mirror")}, TraceEffect::kReflection);
    Probe probe;
    probe.kind = ProbeKind::kPlanar;
    probe.influence = {VolumeShape::kBox, {0, 0, -4}, glm::dmat3(1.0), glm::dvec3(100, 100, 0.5)};
    probe.capturePosition = {0, 0, -4};
    probe.mirror = {{0, 0, -4}, {0, 0, 1}, {}, 8, 8, true};
    testCase.probes = {probe};
    testCase.hierarchy = unsigned{kTierProbes} | unsigned{kTierSky};
    return testCase;
}

inline Expectation expectation(const std::string& output, ExpectationSource source)
{
    Expectation made;
    made.output = *findOutput(output);
    made.source = std::move(source);
    made.position = {"case.toml", 7, 1};
    return made;
}

inline Expectation analytic(const std::string& output, const std::string& function)
{
    return expectation(output, AnalyticSource{function});
}

inline Expectation truth(const std::string& output, const std::string& quantity)
{
    return expectation(output, TruthSource{quantity});
}

// The text of the InputError that `call` throws; empty when it throws nothing.
template <typename Call>
std::string errorOf(Call call)
{
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

} // namespace crossray::test
