// `crossray sweep` from outside: rows, edges and files, and what it refuses.
#include "tests/cli/program.h"

namespace {

class SweepTest : public CliTest {
  protected:
    // A tilted pane seen by parallel rays at 60 degrees: nothing enters below an index of 0.866.
    void writePane()
    {
        writeFile("cases/pane.toml",
                  "schema = 1\nname = \"pane\"\nsummary = \"A pane of the test.\"\n"
                  "[camera]\nprojection = \"orthographic\"\n"
                  "[scene]\nsize = [8, 4]\nprimitives = [{ shape = \"box\", center = [0, 0, -5], half_extents = [50, "
                  "50, 0.5], rotation = [60, 0, 0], material = \"glass\" }]\n"
                  "[material]\nrefraction_model = \"box\"\n"
                  "[[expect]]\noutput = \"RayDirWS\"\nanalytic = \"refraction_box\"\ntolerance = { degrees = 1e-3 }\n");
    }
};

} // namespace

TEST_F(SweepTest, findsTheCriticalAngle)
{
    writePane();
    const Outcome outcome = run("sweep pane material.ior 0.5..2:7 --backend cpu32 -o out --csv numbers.csv");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.lastLine(), "9 values, 0 refused, 1 edges") << outcome.out;
    EXPECT_NE(outcome.out.find("edge: at material.ior 0.866"), std::string::npos) << outcome.out;
    EXPECT_NE(
        outcome.out.find("from \"no raycast: total internal reflection\" into \"no raycast\", seen at 60 degrees"),
        std::string::npos)
        << outcome.out;
    EXPECT_NE(readFile("out/pane_material_ior.svg").find("</svg>"), std::string::npos);
    EXPECT_EQ(readFile("out/pane_material_ior.csv"), readFile("numbers.csv"));
    EXPECT_NE(readFile("numbers.csv").find(",cpu64,"), std::string::npos);
}

TEST_F(SweepTest, jsonStandsAloneAndRefusedValuesAreRows)
{
    writePane();
    const Outcome outcome = run("sweep pane material.ior 0..12:4 --backend cpu64 --json");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_NE(json["values"][0]["refused"].get<std::string>().find("above 0, at most 10"), std::string::npos);
    EXPECT_EQ(json["values"].back()["value"], 12);
    EXPECT_TRUE(json["values"].back().contains("refused"));
    EXPECT_EQ(json["edges"][0]["kind"], "refused");
    EXPECT_NE(outcome.err.find(" refused, "), std::string::npos);
}

TEST_F(SweepTest, otherKeysAreSetForAllValues)
{
    writePane();
    const Outcome outcome = run("sweep pane material.thickness 0..10:3 --set material.ior=0.5 --set 'scene.size=[2, "
                                "2]' --backend cpu64 --json");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    const nlohmann::json sweep = nlohmann::json::parse(outcome.out);
    for (const auto& row : sweep["values"])
        EXPECT_EQ(row["backends"][0]["classes"]["no raycast: total internal reflection"], 1);
}

TEST_F(SweepTest, saysWhatIsWrong)
{
    writePane();
    const auto refusal = [&](const std::string& arguments) {
        const Outcome outcome = run("sweep " + arguments);
        EXPECT_EQ(outcome.exitCode, 2) << arguments << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        return outcome.err;
    };
    EXPECT_NE(refusal("pane material.iro 1..2").find("did you mean \"material.ior\"? Allowed: "), std::string::npos);
    EXPECT_NE(refusal("pane material.ior 1").find("FROM..TO[:STEPS][:log]"), std::string::npos);
    EXPECT_NE(refusal("pane material.ior").find("or --all"), std::string::npos);
    EXPECT_NE(refusal("pane material.ior 11..12").find("every value is refused: "), std::string::npos);
    EXPECT_NE(refusal("pane material.ior 1..2 --set x").find("KEY=VALUE"), std::string::npos);
    EXPECT_EQ(run("sweep nothing material.ior 1..2").exitCode, 4);
}

TEST_F(SweepTest, makesTheListAgain)
{
    writePane();
    writeFile("cases/sweeps.toml", "[[sweep]]\nid = \"ior\"\ntitle = \"Index\"\ncase = \"pane\"\nparameter = "
                                   "\"material.ior\"\nrange = \"0.5..2:4\"\nshows = \"S.\"\nwhy = \"W.\"\n");
    const Outcome outcome = run("sweep --all -o out --backend cpu64");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(readFile("out/ior.svg").find("</svg>"), std::string::npos);
    const std::string readme = readFile("out/README.md");
    for (const char* part : {"## Index", "](ior.svg)", "`crossray sweep pane material.ior 0.5..2:4`", "**Shows.** S.",
                             "**Edge.** at material.ior 0.866", "**Why.** W."})
        EXPECT_NE(readme.find(part), std::string::npos) << part << "\n" << readme;
    EXPECT_EQ(run("sweep --all -k nothing -o out").exitCode, 2);
}
