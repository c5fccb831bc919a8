// A person's own tracer, from outside: as a case's method, and beside the library's in the bench.
#include "tests/cli/program.h"

#include <fmt/format.h>

namespace {

class OwnTracerTest : public CliTest {
  protected:
    void SetUp() override
    {
        CliTest::SetUp();
        writeFile("cases/mine.toml", R"(schema = 1
name = "mine"
summary = "Rays of a floor that meet a wall."
[camera]
eye = [0, 1, 2]
target = [0, 0.5, 0]
[scene]
size = [32, 24]
primitives = [
    { shape = "plane", normal = [0, 1, 0], half_extents = [4, 4], material = "mirror" },
    { shape = "plane", center = [0, 0, -4], half_extents = [50, 50] },
]
[projection]
model = "own"
tracer = "mine.glsl"
[[expect]]
output = "HitSuccess"
constant = "miss"
)");
    }
    void writeTracer(const std::string& body) const
    {
        writeFile("cases/mine.glsl", "OwnHit traceOwn(OwnRay ray)\n{\n" + body + "}\n");
    }
    static constexpr const char* kMiss = "    return ownEnd(kHitReasonSky, vec2(0.0));\n";
};

} // namespace

TEST_F(OwnTracerTest, runsWhereGlslRunsAndSaysWhyNotElsewhere)
{
    writeTracer(kMiss);
    const Outcome outcome = run("run --backend lavapipe,osmesa,cpu64 -v");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.lastLine(), "2 passed, 0 failed, 1 skipped");
    EXPECT_NE(outcome.out.find("an own tracer is GLSL, and this backend's code is compiled ahead"), std::string::npos);
    const Outcome shown = run("show mine");
    EXPECT_NE(shown.out.find("projection own, cases/mine.glsl, 2048 iterations"), std::string::npos) << shown.out;
    EXPECT_NE(shown.out.find("cpu64        skipped: an own tracer is GLSL"), std::string::npos) << shown.out;
    EXPECT_EQ(run("trace mine --pixel 16,20 --backend cpu32").exitCode, 2);
    const Outcome traced = run("trace mine --pixel 16,20");
    EXPECT_EQ(traced.exitCode, 0) << traced.err;
    EXPECT_NE(traced.out.find("left the scene"), std::string::npos) << traced.out;
}

TEST_F(OwnTracerTest, isReadAnewWhenItChanges)
{
    writeTracer(kMiss);
    EXPECT_EQ(run("run --backend lavapipe").exitCode, 0);
    const Outcome unchanged = run("run --backend lavapipe --changed");
    EXPECT_NE((unchanged.out + unchanged.err).find("1 case left out"), std::string::npos) << unchanged.out;
    writeTracer("    return ownHit(vec2(1.0), 1.0);\n");
    EXPECT_EQ(run("run --backend lavapipe --changed").exitCode, 1);
}

TEST_F(OwnTracerTest, whatIsWrongEndsInOneLineOfItsOwnFile)
{
    const std::pair<std::string, std::string> tracers[] = {
        {"    float x = ;\n", "cases/mine.glsl:3:15: error: syntax error, unexpected ';'"},
        {"    while (true) {\n    }\n" + std::string(kMiss),
         "cases/mine.glsl:3: error: the loop goes on and on: cut after 60000 rounds, at pixel "},
        {"    float x = fetchDeviceDepth(ray.pixel);\n" + std::string(kMiss),
         "cases/mine.glsl:3: error: reaches 'deviceDepthImage' past the interface"},
    };
    for (const auto& [body, text] : tracers) {
        writeTracer(body);
        const Outcome outcome = run("run --backend lavapipe");
        EXPECT_EQ(outcome.exitCode, 1) << body;
        EXPECT_NE((outcome.out + outcome.err).find("ERROR mine  lavapipe   " + text), std::string::npos)
            << outcome.out << outcome.err;
        if (body.find("while") != std::string::npos) continue; // found when all methods are made
        const Outcome bench = run("bench mine --rounds 1 --method a=cases/mine.glsl");
        EXPECT_EQ(bench.exitCode, 2) << body;
        EXPECT_NE(bench.err.find(text), std::string::npos) << bench.err;
    }
    writeFile("cases/mine.glsl", "");
    EXPECT_NE(run("run --backend lavapipe").out.find("cases/mine.glsl: error: it does not define OwnHit traceOwn"),
              std::string::npos);
    std::filesystem::remove(folder_ / "cases/mine.glsl");
    const Outcome missing = run("run --backend lavapipe");
    EXPECT_EQ(missing.exitCode, 2);
    EXPECT_NE(missing.err.find("cases/mine.toml:15:10: \"tracer\" is \"mine.glsl\", and there is no such file"),
              std::string::npos)
        << missing.err;
}

TEST_F(OwnTracerTest, standsInTheBenchBesideTheLibrarys)
{
    writeTracer(kMiss);
    writeFile("depth.glsl",
              "OwnHit traceOwn(OwnRay ray)\n{\n    for (int i = 0; i < 3; ++i) ownLinearDepth(ray.pixel);\n"
              "    return ownHit(vec2(0.0), 1.0);\n}\n");
    const Outcome outcome =
        run("bench --method missing=cases/mine.glsl --method three=depth.glsl mine --rounds 1 -o charts");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    const auto json = nlohmann::json::parse(readFile("charts/bench.json"));
    int found = 0;
    for (const auto& point : json["scenes"][0]["methods"]) {
        if (point["method"] == "missing") {
            ++found;
            EXPECT_EQ(point["errors"]["Missed"], 1);
            EXPECT_EQ(point["counters"]["Iterations"], 0);
        }
        if (point["method"] == "three") {
            ++found;
            EXPECT_EQ(point["kind"], "own");
            EXPECT_EQ(point["counters"]["Iterations"], 3);
            EXPECT_EQ(point["counters"]["Fetches"], 3);
            EXPECT_EQ(point["counters"]["FetchesOf32"], 3);
        }
    }
    EXPECT_EQ(found, 2);
    EXPECT_NE(readFile("charts/projection_mine.svg").find(">three</text>"), std::string::npos);

    for (const char* words :
         {"bench mine --method a", "bench mine --method a=none.glsl",
          "bench mine --method a=depth.glsl --backend cpu32",
          "bench mine --method a=depth.glsl --method a=cases/mine.glsl",
          "bench tracers --method a=depth.glsl --backend cpu64", "bench tracers --method a=depth.glsl --disturb noise",
          "bench tracers --method a=none.glsl"}) {
        const Outcome refused = run(words);
        EXPECT_EQ(refused.exitCode, 2) << words;
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n') <= 2, true) << refused.err;
    }
}

TEST_F(OwnTracerTest, isARowOfTheTableOfTracers)
{
    writeFile("three.glsl",
              "OwnHit traceOwn(OwnRay ray)\n{\n    for (int i = 0; i < 3; ++i) ownLinearDepth(ray.pixel);\n"
              "    return ownHit(vec2(-9.0), 1.0);\n}\n");
    const Outcome outcome =
        run("bench tracers --method three=three.glsl --seeds 1-2 --size 64x36 -k oracle --csv a.csv");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.lastLine(), "2 tracers, 2 scenes");
    // Claims all and finds none: no recall, no precision, all false; 3 reads and 3 rounds a ray, and of 32 rays.
    const char* const row =
        "| three | 0.000 (0.000) | 0.000 | 1.0000 (1.000) | 0.000 / 0.000 | 3.0 | 3 | 3.0 | 0.000 % |";
    EXPECT_NE(outcome.out.find(row), std::string::npos) << outcome.out;
    EXPECT_NE(readFile("a.csv").find("three"), std::string::npos);
    writeFile("endless.glsl",
              "OwnHit traceOwn(OwnRay ray)\n{\n    for (;;) {\n    }\n    return ownHit(vec2(0.0), 1.0);\n}\n");
    const Outcome endless = run("bench tracers --method a=endless.glsl --seeds 1-4 --size 64x36 -k oracle");
    EXPECT_EQ(endless.exitCode, 2);
    EXPECT_NE(endless.err.find("endless.glsl:3: error: "), std::string::npos) << endless.err;
    // A case's scene instead.
    writeTracer(kMiss);
    const Outcome ofCase = run("bench tracers --case mine --method three=three.glsl -k oracle");
    EXPECT_EQ(ofCase.exitCode, 0) << ofCase.err;
    EXPECT_EQ(ofCase.lastLine(), "2 tracers, 1 scenes");
}
