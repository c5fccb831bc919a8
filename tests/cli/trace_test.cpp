// `crossray trace` from outside: what a person reads, what a program reads, and what it refuses.
#include "tests/cli/program.h"

#include <fmt/format.h>

namespace {

class TraceTest : public CliTest {
  protected:
    // A mirror floor before a wall, marched.
    void writeMarch(const std::string& name, const std::string& more = "", const std::string& folder = "cases")
    {
        writeFile(
            folder + "/" + name + ".toml",
            fmt::format("schema = 1\nname = \"{}\"\nsummary = \"A floor of the test.\"\n"
                        "[camera]\neye = [0, 1.5, 3]\ntarget = [0, 0.5, -2]\n"
                        "[scene]\nsize = [16, 16]\nprimitives = [\n"
                        "{{ shape = \"plane\", normal = [0, 1, 0], half_extents = [4, 4], material = \"mirror\" }},\n"
                        "{{ shape = \"plane\", center = [0, 0, -4], half_extents = [50, 50] }}]\n"
                        "[projection]\nmodel = \"hiz\"\nmin_level = 0\nmax_iterations = 64\ndepth_bias = 0.2\n{}\n"
                        "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"miss\"\n",
                        name, more));
    }
};

} // namespace

TEST_F(TraceTest, printsTheRayAndEachStep)
{
    writeMarch("a");
    const Outcome outcome = run("trace a --pixel 8,13 --backend cpu64");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    for (const char* part : {"a  pixel 8,13\nA floor of the test.\n", "tracing model           HiZ\n",
                             "hit success             hit\n", "(8.500, 13.500) px", "levels                  0 to 6\n",
                             "thickness               0.2 m\n", " of 64\n", "step  level  cell", "  depth\n"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
    EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos);
}

TEST_F(TraceTest, showsTwoBackendsSideBySide)
{
    writeMarch("a");
    const Outcome outcome = run("trace a --pixel 8,13 --backend cpu64 --backend cpu32");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("cpu32  "), std::string::npos);
    EXPECT_NE(outcome.out.find("hit success             hit    "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("\nThey agree in "), std::string::npos) << outcome.out;
    EXPECT_EQ(run("trace a --pixel 8,13 --backend cpu64,cpu32").out, outcome.out);
}

TEST_F(TraceTest, jsonHasTheSameRay)
{
    writeMarch("a");
    const auto json = nlohmann::json::parse(run("trace a --pixel 8,13 --backend cpu32,cpu64 --json").out);
    ASSERT_EQ(json["backends"].size(), 2u);
    const auto& first = json["backends"][0];
    EXPECT_EQ(first["tracingModel"], "HiZ");
    EXPECT_EQ(first["startSS"][1].get<double>(), 13.5);
    EXPECT_EQ(first["steps"].size(), first["iterations"].get<size_t>());
    EXPECT_EQ(first["steps"].back()["intersection"], "depth");
    EXPECT_TRUE(json["parting"].is_null());
    // By hand: the mirrored ray meets the wall z = -4 at y = 3.0388, which is (36.5 - y)/sqrt(26) m deep.
    EXPECT_NEAR(json["backends"][1]["endLinearDepth"].get<double>(), 6.5623, 1e-4);
}

TEST_F(TraceTest, theCommandOfAFailureWorks)
{
    // Names are looked up in the case folder alone; what lies elsewhere is named by its file.
    writeMarch("a", "[expand]\ncamera.fov = [50, 60]");
    writeMarch("b", "[expand]\ncamera.fov = [50, 60]", "elsewhere");
    writeMarch("c", "", "elsewhere");
    const Outcome failed = run("run a elsewhere --backend cpu64");
    ASSERT_EQ(failed.exitCode, 1);
    EXPECT_NE(failed.out.find("crossray trace 'a[fov=50]' --pixel"), std::string::npos) << failed.out;
    EXPECT_NE(failed.out.find("crossray trace 'elsewhere/b.toml[fov=60]' --pixel"), std::string::npos) << failed.out;
    EXPECT_NE(failed.out.find("crossray trace elsewhere/c.toml --pixel"), std::string::npos) << failed.out;
    size_t found = 0;
    for (size_t at = failed.out.find("crossray trace "); at != std::string::npos;
         at = failed.out.find("crossray trace ", at + 1)) {
        const size_t begin = at + std::string("crossray ").size();
        const std::string command = failed.out.substr(begin, failed.out.find('\n', at) - begin);
        const Outcome traced = run(command);
        EXPECT_EQ(traced.exitCode, 0) << command << "\n" << traced.err;
        EXPECT_NE(traced.out.find("hit success             hit\n"), std::string::npos) << command << "\n" << traced.out;
        ++found;
    }
    EXPECT_EQ(found, 5u) << failed.out;
    const Outcome absent = run("trace 'elsewhere/b.toml[fov=70]' --pixel 1,1");
    EXPECT_EQ(absent.exitCode, 4);
    EXPECT_EQ(absent.err, "crossray: no case of elsewhere/b.toml has [fov=70]; it has elsewhere/b.toml[fov=50], "
                          "elsewhere/b.toml[fov=60]\n");
}

TEST_F(TraceTest, errorsAreOneLineAndExitTwo)
{
    writeMarch("a");
    writeMarch("many", "[expand]\ncamera.fov = [50, 60]");
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"trace a", "--pixel"},
        {"trace a --pixel 3", "allowed is X,Y"},
        {"trace a --pixel 16,0 --backend cpu64",
         "pixel 16,0 is outside the image of 16 x 16; allowed are 0,0 to 15,15"},
        {"trace a --pixel=-1,0 --backend cpu64", "pixel -1,0 is outside"},
        {"trace many --pixel 1,1 --backend cpu64", "many stands for 2 cases; name one: many[fov=50], many[fov=60]"},
        {"trace a --pixel 1,1 --backend metal", "there is no such backend"},
        {"trace a --pixel 1,1 --backend cpu32,cpu64,lavapipe", "one is shown alone, two side by side"},
    };
    for (const auto& [command, text] : wrong) {
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.exitCode, 2) << command;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << command << "\n" << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    }
    EXPECT_EQ(run("trace nothing --pixel 1,1").exitCode, 4);
}

TEST_F(TraceTest, aPixelThatTracesNothingSaysSo)
{
    writeMarch("a");
    const Outcome outcome = run("trace a --pixel 8,0 --backend cpu64");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("This pixel traces no ray"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("step"), std::string::npos);
}

TEST_F(TraceTest, saysWhatIsUndecidableAndWhy)
{
    const std::string testCase = "ring.toml";
    std::filesystem::copy(CROSSRAY_SOURCE_DIR "/cases/stability/undecidable_critical_angle.toml", folder_ / testCase);
    const Outcome ring = run("trace " + testCase + " --pixel 8,4 --backend cpu64");
    EXPECT_EQ(ring.exitCode, 0) << ring.err;
    EXPECT_NE(ring.out.find("undecidable here: HitReason flips for an ulp of "), std::string::npos) << ring.out;
    const Outcome inside = run("trace " + testCase + " --pixel 8,5 --backend cpu64");
    EXPECT_EQ(inside.out.find("undecidable here"), std::string::npos) << inside.out;
    EXPECT_NE(inside.out.find("ulp for an ulp"), std::string::npos) << inside.out;
    const auto json = nlohmann::json::parse(run("trace " + testCase + " --pixel 8,4 --backend cpu64 --json").out);
    const auto reason = json["conditioning"][1];
    EXPECT_EQ(reason["output"], "HitReason");
    EXPECT_EQ(reason["condition"], "Infinity");
    EXPECT_EQ(reason["undecidable"], true);
    const Outcome shown = run("show " + testCase + " --conditioning");
    EXPECT_NE(shown.out.find("HitReason        12 of 256 px undecidable, 0 fragile"), std::string::npos) << shown.out;
    const Outcome pixel = run("show " + testCase + " --conditioning --pixel 8,4");
    EXPECT_NE(pixel.out.find("undecidable here: HitReason flips"), std::string::npos) << pixel.out;
    EXPECT_EQ(run("show " + testCase + " --pixel 8,4").exitCode, 2);
    EXPECT_EQ(run("show " + testCase + " --conditioning --pixel 16,0").exitCode, 2);
}
