// The record of one pixel: all that its ray did, on one backend. The shader side is shaders/pass/pixel_record.glsl.
#pragma once

#include "harness/pass/pass.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <vector>

namespace crossray {

// The numbers of crossray/shared/outputs.glsl.
enum class IntersectionKind : int { kNone = 0, kCell = 1, kDepth = 2 };

// One iteration of a march.
struct RecordedStep {
    glm::dvec2 positionSS{0.0}; // where the ray is when the step begins, pixels
    double rayLinearDepth = 0;  // there, metres
    int level = 0;              // of the pyramid
    double nearest = 0;         // the depth buffer's in the cell, metres
    double farthest = 0;        //
    double thick = 0;           // nearest and the thickness
    IntersectionKind kind = IntersectionKind::kNone;
    glm::ivec2 cell{0};
    glm::ivec2 cellSize{0}; // pixels
};

struct PixelRecord {
    glm::ivec2 pixel{0};
    bool isTraced = false; // the pixel traces a ray; else all below is 0
    ProjectionModel model = ProjectionModel::kNone;
    HitClass hitClass = HitClass::kNoRaycast;
    int reason = 0; // kHitReason...

    glm::dvec2 startSS{0.0}; // pixels
    double startDepth = 0;   // metres along the view axis
    double pathLength = 0;   // metres in the material before the start
    glm::dvec2 dirSS{0.0};   // unit; 0 for a ray without length on screen
    double depthChange = 0;  // change of 1/linear depth (orthographic: of -linear depth) a pixel
    double wayOnScreen = 0;  // pixels to where the ray ends by itself, at the near plane, the far plane or 65504 m
    glm::dvec3 originWS{0.0};
    glm::dvec3 dirWS{0.0};

    int minLevel = 0, maxLevel = 0, maxIterations = 0; // of the march
    double depthBias = 0;                              // metres

    double projectionDistance = 0; // metres from the start to the proxy; a march: 0
    bool meetsProxy = false;

    glm::dvec2 endSS{0.0};
    double endDepth = 0; // of the hit, metres; 0 without one
    double hitWeight = 0;
    glm::dvec3 sampledColor{0.0};
    double sampledColorWeight = 0;
    int iterations = 0;
    int maxUsedLevel = 0;
    IntersectionKind lastKind = IntersectionKind::kNone;
    double confidence = 0; // of a hit

    std::vector<RecordedStep> steps;
    int lostSteps = 0; // that the record had no room for: the last ones
};

// The case with the outputs that a record shows, whatever it expects itself.
Case prepareForRecord(const Case& testCase);

// Throws InputError where the pixel is outside the image.
void checkPixel(const Camera& camera, glm::ivec2 pixel);

// The job that records the pixel; `data` is of a case from prepareForRecord. Throws ShaderError, and InputError for a
// pixel outside the image.
constexpr int kMostRecordedSteps = 4096;
Job buildRecordJob(const CaseData& data, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
                   Precision precision, glm::ivec2 pixel, int stepCapacity = kMostRecordedSteps);

// Numbers in the buffer of a record.
size_t countRecordScalars(int stepCapacity);

// What came back of that job. Throws EnvironmentError when it is no record.
PixelRecord readRecord(glm::ivec2 pixel, const JobResult& result);

} // namespace crossray
