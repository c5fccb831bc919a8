// `crossray mutate` from outside: one bug that a case catches, one that it does not, and what is refused.
#include "tests/cli/program.h"

#include <algorithm>

namespace {

class MutateTest : public CliTest {
  protected:
    void SetUp() override
    {
        CliTest::SetUp();
        // A pane seen at 60 degrees: its rays leave as they came.
        writeFile("cases/pane.toml",
                  "schema = 1\nname = \"pane\"\nsummary = \"A pane of the test.\"\n"
                  "[camera]\nprojection = \"orthographic\"\n"
                  "[scene]\nsize = [8, 4]\nprimitives = [{ shape = \"box\", center = [0, 0, -5], half_extents = [50, "
                  "50, 0.5], rotation = [60, 0, 0], material = \"glass\" }]\n"
                  "[material]\nrefraction_model = \"box\"\n"
                  "[[expect]]\noutput = \"RayDirWS\"\nanalytic = \"refraction_box\"\ntolerance = { degrees = 1e-3 }\n");
        writeFile("none.toml", "");
    }

    // `what` is a part of the bug's line in --list.
    Outcome mutate(const std::string& what, const std::string& more = "") const
    {
        return run("mutate --equivalents none.toml --shader crossray/refract/refraction.glsl --mutant '" + what +
                   "' -j 1 " + more);
    }

    // The ray leaves backwards.
    static constexpr const char* kCaught = "computeRefractionBox sign: - -> ";
    // The pane's index is 1.5.
    static constexpr const char* kUnnoticed = "enterRefractor constant: 1000.0 -> 1250.0";
};

} // namespace

TEST_F(MutateTest, aKnownBugIsCaught)
{
    const Outcome outcome = mutate(kCaught, "--json out/m.json -o out --min-score 100");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err << outcome.out;
    EXPECT_EQ(outcome.lastLine(), "1 caught, 0 survived, 0 not counted, score 100.0 %");
    const auto json = nlohmann::json::parse(readFile("out/m.json"));
    EXPECT_EQ(json["mutants"][0]["end"], "caught");
    EXPECT_EQ(json["mutants"][0]["caughtBy"], "pane");
    EXPECT_EQ(json["mutants"][0]["how"], "fail");
    EXPECT_NE(readFile("out/mutation.md").find("| crossray/refract/refraction.glsl | 1 | 1 | 0 |"), std::string::npos);
    EXPECT_NE(readFile("out/mutation.csv").find(",caught,pane,fail,"), std::string::npos);
}

TEST_F(MutateTest, anUnnoticedBugSurvivesWithItsDiff)
{
    const Outcome outcome = mutate(kUnnoticed, "--min-score 50");
    EXPECT_EQ(outcome.exitCode, 1) << outcome.err;
    EXPECT_EQ(outcome.lastLine(), "0 caught, 1 survived, 0 not counted, score 0.0 %");
    EXPECT_NE(outcome.out.find("-float index = hasIndex ? clamp(indexOfRefraction, 0.001, 1000.0) : 1.0;\n"
                               "+float index = hasIndex ? clamp(indexOfRefraction, 0.001, 1250.0) : 1.0;"),
              std::string::npos)
        << outcome.out;
}

TEST_F(MutateTest, whatNoCaseReachesIsToldApart)
{
    const Outcome outcome = mutate("computeRefractionSphere sign");
    EXPECT_EQ(outcome.lastLine().substr(0, 22), "0 caught, 0 survived, ") << outcome.out;
    EXPECT_NE(outcome.lastLine().find("score -"), std::string::npos);
}

TEST_F(MutateTest, listedEquivalentsDoNotCount)
{
    const std::string head =
        "[[equivalent]]\nfile = \"crossray/refract/refraction.glsl\"\nfunction = \"enterRefractor\"\n"
        "reason = \"of the test\"\nedits = [[\"float index = hasIndex ? clamp(indexOfRefraction, "
        "0.001, 1000.0) : 1.0;\", ";
    writeFile("none.toml", head + "\"float index = hasIndex ? clamp(indexOfRefraction, 0.001, 1250.0) : 1.0;\"]]\n");
    EXPECT_EQ(mutate(kUnnoticed).lastLine(), "0 caught, 0 survived, 1 not counted, score -");
    EXPECT_EQ(mutate(kUnnoticed, "--try-equivalents").lastLine(), "0 caught, 1 survived, 0 not counted, score 0.0 %");
    writeFile("none.toml", head + "\"float index = 2.0;\"]]\n");
    const Outcome outcome = mutate(kUnnoticed);
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_NE(
        outcome.err.find("none.toml:5:11: no mutant of crossray/refract/refraction.glsl in enterRefractor is that "
                         "any more"),
        std::string::npos)
        << outcome.err;
}

TEST_F(MutateTest, theSampleHangsOnTheSeedAlone)
{
    const auto list = [&](const std::string& more) { return run("mutate --list " + more).out; };
    const std::string first = list("--sample 9 --seed 3");
    EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 10);
    EXPECT_EQ(first, list("--sample 9 --seed 3"));
    EXPECT_NE(first, list("--sample 9 --seed 4"));
    EXPECT_NE(list("--shader crossray/refract").find("crossray/refract/fresnel.glsl:"), std::string::npos);
}

TEST_F(MutateTest, refusesWhatIsNotThere)
{
    EXPECT_EQ(run("mutate --shader crossray/none.glsl --list").exitCode, 2);
    EXPECT_EQ(run("mutate --mutant nothing-of-the-kind").exitCode, 4);
    EXPECT_EQ(run("mutate --sample 1 no/such/case").exitCode, 4);
    const Outcome cpu = run("mutate --sample 1 --backend cpu64");
    EXPECT_EQ(cpu.exitCode, 2);
    EXPECT_NE(cpu.err.find("allowed are lavapipe, swiftshader and vulkan:NAME"), std::string::npos) << cpu.err;
}
