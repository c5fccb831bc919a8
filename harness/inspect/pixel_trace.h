// One pixel of a case on one backend or two: its records, and where they part.
#pragma once

#include "harness/pass/pixel_record.h"
#include "harness/run/conditioning.h"
#include "harness/run/environment.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossray {

struct RecordOnBackend {
    std::string backend;
    PixelRecord record;
};

// The first thing in which two records differ in kind; numbers alone may differ by rounding.
struct Parting {
    int step = -1; // from 0; -1: the steps agree, and the answers or the set-up differ
    std::string sentence;
};

struct PixelTrace {
    std::string caseName, summary;
    glm::ivec2 pixel{0};
    std::vector<RecordOnBackend> records;          // one or two
    std::optional<Parting> parting;                // of two
    std::vector<PixelConditioning> conditioning{}; // of each output, where it was measured
    std::string conditioningNote{};                // why it was not
};

// "31,12". Throws InputError.
glm::ivec2 parsePixel(const std::string& text);

// Level, cell, intersection, class or reason; nothing where both went the same way.
std::optional<Parting> findParting(const RecordOnBackend& first, const RecordOnBackend& second);

// Largest difference of two records that went the same way: of the steps' and the ends' positions in pixels, and of the
// ray's depths there relative to them.
struct RecordDistance {
    double pixels = 0, depth = 0;
};
RecordDistance measureDistance(const PixelRecord& first, const PixelRecord& second);

// Why no pixel of the case can be traced on the backend; empty where one can.
std::string whyNotTraced(const Case& testCase, const std::string& backend);

// Where pixels are traced; whoever traces many has one pool and one compiler for all.
struct TraceWorkers {
    WorkerPool& pool;
    ShaderCompiler& compiler;
    std::filesystem::path shaders;
    int core = 0;
    std::chrono::duration<double> timeout{60}; // of each backend
};

// Runs the case for one pixel on each backend. Throws InputError (the pixel is outside), ShaderError, EnvironmentError.
PixelTrace tracePixel(const Case& testCase, glm::ivec2 pixel, std::span<const std::string> backends,
                      const TraceWorkers& workers);
// The same of data that are there already: of a case from prepareForRecord().
PixelTrace tracePixel(const CaseData& data, glm::ivec2 pixel, std::span<const std::string> backends,
                      const TraceWorkers& workers);
// With workers of its own.
PixelTrace tracePixel(const Case& testCase, glm::ivec2 pixel, std::span<const std::string> backends,
                      const Folders& folders);

} // namespace crossray
