#include "harness/pass/pixel_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace crossray {

namespace {

#include "shaders/pass/record_layout.glsl"

class RecordReader {
  public:
    explicit RecordReader(std::span<const double> values) : values_(values) {}

    double number(int vector, size_t component) const { return values_[static_cast<size_t>(vector) * 4 + component]; }
    int whole(int vector, size_t component) const { return static_cast<int>(number(vector, component)); }
    glm::dvec2 pair(int vector) const { return {number(vector, 0), number(vector, 1)}; }
    glm::dvec3 triple(int vector) const { return {number(vector, 0), number(vector, 1), number(vector, 2)}; }
    int stepCapacity() const { return (static_cast<int>(values_.size()) / 4 - kRecordHeaderSize) / kRecordStepSize; }

    RecordedStep step(int index) const
    {
        const int first = kRecordHeaderSize + index * kRecordStepSize;
        const int place = first + kRecordStepPlace, depth = first + kRecordStepDepth, cell = first + kRecordStepCell;
        RecordedStep step;
        step.positionSS = pair(place);
        step.rayLinearDepth = number(place, 2);
        step.level = whole(place, 3);
        step.nearest = number(depth, 0);
        step.farthest = number(depth, 1);
        step.thick = number(depth, 2);
        step.kind = static_cast<IntersectionKind>(whole(depth, 3));
        step.cell = {whole(cell, 0), whole(cell, 1)};
        step.cellSize = {whole(cell, 2), whole(cell, 3)};
        return step;
    }

  private:
    std::span<const double> values_;
};

} // namespace

Case prepareForRecord(const Case& testCase)
{
    Case recorded = testCase;
    if (recorded.projection.model == ProjectionModel::kNone) return recorded; // nothing is hit, nothing is sampled
    for (const char* name : {"HitWeight", "SampledColor"}) {
        const bool isThere = std::any_of(recorded.outputs.begin(), recorded.outputs.end(),
                                         [&](const OutputInfo& output) { return output.name == name; });
        if (!isThere) recorded.outputs.push_back(*findOutput(name));
    }
    return recorded;
}

size_t countRecordScalars(int stepCapacity)
{
    return static_cast<size_t>(kRecordHeaderSize + stepCapacity * kRecordStepSize) * 4;
}

PixelRecord readRecord(glm::ivec2 pixel, const JobResult& result)
{
    const bool isRecord = result.readbacks.size() == 1 && result.readbacks[0].size() >= countRecordScalars(0);
    if (!isRecord) throw EnvironmentError("the device returned no record of a pixel");
    const RecordReader reader(result.readbacks[0]);
    PixelRecord record;
    record.pixel = pixel;
    record.model = static_cast<ProjectionModel>(reader.whole(kRecordClass, 0));
    record.hitClass = static_cast<HitClass>(reader.whole(kRecordClass, 1));
    record.reason = reader.whole(kRecordClass, 2);
    record.isTraced = reader.whole(kRecordClass, 3) == 1;
    record.startSS = reader.pair(kRecordStart);
    record.startDepth = reader.number(kRecordStart, 2);
    record.pathLength = reader.number(kRecordStart, 3);
    record.dirSS = reader.pair(kRecordDirSS);
    record.depthChange = reader.number(kRecordDirSS, 2);
    record.wayOnScreen = reader.number(kRecordDirSS, 3);
    record.originWS = reader.triple(kRecordOriginWS);
    record.dirWS = reader.triple(kRecordDirWS);
    record.minLevel = reader.whole(kRecordLimits, 0);
    record.maxLevel = reader.whole(kRecordLimits, 1);
    record.maxIterations = reader.whole(kRecordLimits, 2);
    record.depthBias = reader.number(kRecordLimits, 3);
    record.projectionDistance = reader.number(kRecordProxy, 0);
    record.meetsProxy = reader.whole(kRecordProxy, 1) == 1;
    record.endSS = reader.pair(kRecordEnd);
    record.endDepth = reader.number(kRecordEnd, 2);
    record.hitWeight = reader.number(kRecordEnd, 3);
    record.sampledColor = reader.triple(kRecordColor);
    record.sampledColorWeight = reader.number(kRecordColor, 3);
    record.iterations = reader.whole(kRecordCounts, 0);
    record.maxUsedLevel = reader.whole(kRecordCounts, 1);
    record.lastKind = static_cast<IntersectionKind>(reader.whole(kRecordCounts, 2));
    record.confidence = reader.number(kRecordCounts, 3);
    const int kept = std::clamp(record.iterations, 0, reader.stepCapacity());
    for (int index = 0; index < kept; ++index)
        record.steps.push_back(reader.step(index));
    record.lostSteps = record.iterations - kept;
    return record;
}

} // namespace crossray
