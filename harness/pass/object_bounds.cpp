#include "harness/pass/object_bounds.h"

namespace crossray {

namespace {

// Half the size of the box around a primitive, along the world's axes.
glm::dvec3 reachOf(const Primitive& primitive)
{
    if (primitive.shape == PrimitiveShape::kSphere) return glm::dvec3(primitive.radius);
    glm::dvec3 reach(0.0);
    const glm::dvec3 half = localHalfExtents(primitive);
    const int axes = primitive.shape == PrimitiveShape::kPlane ? 2 : 3; // an endless plane times 0 is no number
    for (int axis = 0; axis < axes; ++axis)
        reach += glm::abs(primitive.worldFromLocal[axis]) * half[axis];
    return reach;
}

} // namespace

ObjectBounds findObjectBounds(const Case& testCase)
{
    const std::string traced = testCase.effect == TraceEffect::kRefraction ? "glass" : "mirror";
    ObjectBounds bounds;
    bool isFirst = true;
    for (const Primitive& primitive : testCase.scene.primitives) {
        if (primitive.material != traced) continue;
        const glm::dvec3 low = primitive.center - reachOf(primitive);
        const glm::dvec3 high = primitive.center + reachOf(primitive);
        bounds =
            isFirst ? ObjectBounds{low, high} : ObjectBounds{glm::min(bounds.minWS, low), glm::max(bounds.maxWS, high)};
        isFirst = false;
    }
    return bounds;
}

double measureCoveredArea(const ObjectBounds& object, const ObjectBounds& box)
{
    const glm::dvec3 inside =
        glm::max(glm::min(object.maxWS, box.maxWS) - glm::max(object.minWS, box.minWS), glm::dvec3(0.0));
    double area = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto holds = [&](double at) { return at >= box.minWS[axis] && at <= box.maxWS[axis] ? 1.0 : 0.0; };
        area +=
            (holds(object.minWS[axis]) + holds(object.maxWS[axis])) * inside[(axis + 1) % 3] * inside[(axis + 2) % 3];
    }
    return area;
}

} // namespace crossray
