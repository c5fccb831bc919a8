#include "harness/inspect/pixel_trace.h"

#include "harness/inspect/names.h"
#include "harness/inspect/trace_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

using namespace crossray;

namespace {

std::string readText(const std::string& file)
{
    std::ifstream stream(std::string(CROSSRAY_SOURCE_DIR) + "/" + file);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
}

RecordOnBackend makeRecord(const std::string& backend)
{
    RecordOnBackend trace{backend, {}};
    trace.record.isTraced = true;
    trace.record.model = ProjectionModel::kHiz;
    trace.record.hitClass = HitClass::kHit;
    trace.record.endSS = {10, 4};
    trace.record.endDepth = 4;
    for (int i = 0; i < 3; ++i) {
        RecordedStep step;
        step.level = i;
        step.cell = {5 - i, 7};
        step.rayLinearDepth = 2 + i;
        step.positionSS = {10, 8 - i};
        trace.record.steps.push_back(step);
    }
    trace.record.iterations = 3;
    return trace;
}

// The numbers that the shaders give to a family of constants: {"kHitReasonSky", 7}, ...
std::map<std::string, int> readConstants(const std::string& prefix)
{
    const std::string text = readText("shaders/crossray/shared/outputs.glsl");
    const std::regex constant("const int (" + prefix + "[A-Za-z0-9]+) = ([0-9]+);");
    std::map<std::string, int> numbers;
    for (std::sregex_iterator it(text.begin(), text.end(), constant), end; it != end; ++it)
        numbers[(*it)[1]] = std::stoi((*it)[2]);
    numbers.erase(prefix + "Count");
    return numbers;
}

} // namespace

TEST(PixelTrace, readsAPixel)
{
    EXPECT_EQ(parsePixel("31,12"), glm::ivec2(31, 12));
    EXPECT_EQ(parsePixel("-1,0"), glm::ivec2(-1, 0)); // outside, and said so later
    for (const char* wrong : {"", "3", "3,", ",3", "a,b", "1.5,2", "1,2,3", "1 ,2", "99999999999,1"})
        EXPECT_THROW(parsePixel(wrong), InputError) << wrong;
}

TEST(PixelTrace, roundingIsNoParting)
{
    const RecordOnBackend first = makeRecord("osmesa");
    RecordOnBackend second = makeRecord("cpu64");
    second.record.steps[1].positionSS.x += 1e-3;
    second.record.steps[2].rayLinearDepth *= 1 + 1e-6;
    second.record.endDepth *= 1 - 1e-7;
    EXPECT_FALSE(findParting(first, second));
    const RecordDistance distance = measureDistance(first.record, second.record);
    EXPECT_NEAR(distance.pixels, 1e-3, 1e-9);
    EXPECT_NEAR(distance.depth, 1e-6, 1e-9);
}

TEST(PixelTrace, findsTheFirstStepThatDiffersInKind)
{
    const RecordOnBackend first = makeRecord("osmesa");
    const auto partingOf = [&](auto change) {
        RecordOnBackend second = makeRecord("cpu64");
        change(second.record);
        const auto parting = findParting(first, second);
        return parting ? parting->step : -2;
    };
    EXPECT_EQ(partingOf([](PixelRecord&) {}), -2);
    EXPECT_EQ(partingOf([](PixelRecord& r) { r.steps[1].level = 4; }), 1);
    EXPECT_EQ(partingOf([](PixelRecord& r) { r.steps[2].cell.x = 4; }), 2);
    EXPECT_EQ(partingOf([](PixelRecord& r) { r.steps[0].kind = IntersectionKind::kCell; }), 0);
    EXPECT_EQ(partingOf([](PixelRecord& r) { r.steps.pop_back(); }), 2);
    EXPECT_EQ(partingOf([](PixelRecord& r) { r.hitClass = HitClass::kMiss; }), -1);
    EXPECT_EQ(partingOf([](PixelRecord& r) { r.reason = 3; }), -1);
}

TEST(PixelTrace, aPartingIsSaidInASentence)
{
    RecordOnBackend second = makeRecord("cpu64");
    second.record.steps[1].level = 4;
    EXPECT_EQ(findParting(makeRecord("osmesa"), second)->sentence,
              "They part at step 1: osmesa is in cell 4,7 of level 1 with intersection none, cpu64 is in cell 4,7 of "
              "level 4 with intersection none.");
    second = makeRecord("cpu64");
    second.record.hitClass = HitClass::kUnknown;
    second.record.reason = 1;
    EXPECT_EQ(findParting(makeRecord("osmesa"), second)->sentence,
              "They take the same steps and part in the answer: osmesa says hit, cpu64 says unknown (iteration cap).");
}

TEST(PixelTrace, everyNumberOfTheShadersHasAName)
{
    using Namer = std::string (*)(int);
    const std::vector<std::pair<std::string, Namer>> families{
        {"kHitReason", nameOfReason}, {"kTracingModel", nameOfTracingModel}, {"kIntersection", nameOfIntersection}};
    for (const auto& [prefix, nameOf] : families) {
        const auto constants = readConstants(prefix);
        EXPECT_GE(constants.size(), 3u) << prefix;
        std::set<std::string> names;
        for (const auto& [constant, number] : constants) {
            EXPECT_FALSE(nameOf(number).starts_with("number ")) << constant;
            EXPECT_TRUE(names.insert(nameOf(number)).second) << constant << " shares its name";
        }
        EXPECT_EQ(nameOf(99), "number 99");
    }
}

TEST(TraceJson, holdsTheRecordAndItsSteps)
{
    PixelTrace trace{"a", "claim", {3, 4}, {makeRecord("osmesa"), makeRecord("cpu64")}, {}};
    trace.records[1].record.endDepth = std::nan("");
    trace.parting = Parting{2, "They part."};
    const auto json = nlohmann::json::parse(formatTraceJson(trace));
    EXPECT_EQ(json["schema"], "crossray-trace/1");
    EXPECT_EQ(json["pixel"], nlohmann::json({3, 4}));
    EXPECT_EQ(json["backends"][0]["hitSuccess"], "hit");
    EXPECT_EQ(json["backends"][0]["steps"][2]["level"], 2);
    EXPECT_EQ(json["backends"][0]["steps"][2]["cell"], nlohmann::json({3, 7}));
    EXPECT_EQ(json["backends"][1]["endLinearDepth"], "NaN");
    EXPECT_EQ(json["parting"]["step"], 2);
}

TEST(TraceJson, isWhatItsDocumentSays)
{
    const std::string document = readText("docs/trace-json.md");
    std::set<std::string> documented;
    const std::regex row("\n\\| `([^`]+)` \\|");
    for (std::sregex_iterator it(document.begin(), document.end(), row), end; it != end; ++it)
        documented.insert((*it)[1]);
    const std::vector<std::string> fields = listTraceJsonFields();
    EXPECT_EQ(documented, std::set<std::string>(fields.begin(), fields.end()));
}
