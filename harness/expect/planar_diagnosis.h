// Why a planar probe shows nothing, or the wrong thing: does its influence volume overlap the receiver, is its mirror
// plane parallel to the surface, is the camera in front of it. By the exact surface points of the traced pixels.
#pragma once

#include "harness/expect/expect.h"
#include "harness/scene/planar_capture.h"

#include <string>
#include <vector>

namespace crossray {

struct PlanarDiagnosis {
    size_t tracedPixels = 0;  // the receiver
    size_t insidePixels = 0;  // of these, in the influence volume
    double nearestMetres = 0; // from the receiver to the volume; 0 where they overlap
    // Between the mirror's normal and the receiver's, over the pixels inside, or over all where none is.
    double smallestDegrees = 0;
    double largestDegrees = 0;
    double farthestFromPlane = 0; // metres, of the same pixels
    double cameraHeight = 0;      // metres in front of the plane
    PlanarState state = PlanarState::kCaptured;
};

inline constexpr double kParallelDegrees = 0.1; // up to here two normals count as parallel
inline constexpr double kOnPlaneMetres = 1e-3;  // up to here a surface counts as on the plane

PlanarDiagnosis diagnosePlanar(const CaseData& data, const Probe& probe);

// Plain sentences with the numbers, in this order: the influence volume, the mirror plane, the camera.
std::vector<std::string> describeDiagnosis(const PlanarDiagnosis& diagnosis);

} // namespace crossray
