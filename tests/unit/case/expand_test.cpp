// Presets, parameter lists and overrides.
#include "tests/unit/case/case_files.h"

using namespace crossray;

using Expansion = CaseFiles;

namespace {

std::vector<std::string> namesOf(const std::vector<Case>& cases)
{
    std::vector<std::string> names;
    for (const Case& c : cases)
        names.push_back(c.name);
    return names;
}

} // namespace

TEST_F(Expansion, makesTheProductInTheOrderOfTheFile)
{
    const std::vector<Case> cases =
        read(withScene("[expand]\n\"material.thickness\" = [0.5, 2]\nmaterial.ior = [1.2, 1.5, 2]\n"));
    EXPECT_EQ(namesOf(cases), (std::vector<std::string>{"a/b[thickness=0.5,ior=1.2]", "a/b[thickness=0.5,ior=1.5]",
                                                        "a/b[thickness=0.5,ior=2]", "a/b[thickness=2,ior=1.2]",
                                                        "a/b[thickness=2,ior=1.5]", "a/b[thickness=2,ior=2]"}));
    EXPECT_EQ(cases[3].material.thickness, 2);
    EXPECT_EQ(cases[3].material.ior, 1.2);
}

TEST_F(Expansion, reachesListsTablesAndMissingKeys)
{
    const std::vector<Case> cases =
        read(withScene("primitives = [{ shape = \"sphere\", radius = 1 }]\n[expand]\n\"scene.primitives.0.radius\" = "
                       "[2]\nscene.size = [[63, 65]]\n"
                       "\"projection.proxy.center\" = [[1, 2, 3]]\n\"expect.0.tolerance\" = [{ degrees = 5 }]\n"));
    ASSERT_EQ(namesOf(cases), std::vector<std::string>{"a/b[radius=2,size=63x65,center=1x2x3,tolerance=degrees:5]"});
    EXPECT_EQ(cases[0].scene.primitives[0].radius, 2);
    EXPECT_EQ(cases[0].camera.width, 63);
    EXPECT_EQ(cases[0].projection.proxy.center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(cases[0].expectations[0].tolerance.degrees, 5);
}

TEST_F(Expansion, labelsKeysThatEndAlikeByTheirPath)
{
    const std::vector<Case> cases =
        read(withScene("primitives = [{ shape = \"plane\", material = \"glass\" }]\n[expand]\n"
                       "material.ior = [1.2]\n\"scene.primitives.0.ior\" = [1.4]\n"));
    EXPECT_EQ(namesOf(cases), std::vector<std::string>{"a/b[material.ior=1.2,scene.primitives.0.ior=1.4]"});
}

TEST_F(Expansion, chargesTheValueThatIsWrong)
{
    EXPECT_EQ(refusal(withScene("[expand]\nmaterial.ior = [1.2, 11]\n")),
              "a.toml:11:22: \"ior\" is 11; above 0, at most 10 is allowed");
    EXPECT_OPENS(refusal(withScene("[expand]\nmaterial.iro = [1.2]\n")),
                 "a.toml:11:10: unknown key \"iro\" in [material]; did you mean \"ior\"? Allow");
    EXPECT_EQ(refusal(withScene("[expand]\nmaterial.ior = []\n")),
              "a.toml:11:16: \"material.ior\" of [expand] is an empty list; a list of one value or more is allowed");
    EXPECT_EQ(refusal(withScene("[expand]\nmaterial.ior = 1.5\n")),
              "a.toml:11:16: \"material.ior\" of [expand] is a number; a list of one value or more is allowed");
    EXPECT_EQ(refusal(withScene("[expand]\nmaterial.ior = [1.5, 1.5]\n")),
              "a.toml:11:22: [expand] makes \"a/b[ior=1.5]\" twice; each name once is allowed");
    EXPECT_EQ(refusal(withScene("[expand]\nname = [\"x\"]\n")), "a.toml:11:1: \"name\" cannot be expanded");
    EXPECT_EQ(
        refusal(withScene("primitives = [{ shape = \"plane\" }]\n[expand]\n\"scene.primitives.3.radius\" = [1]\n")),
        "a.toml:12:1: \"3\" of \"scene.primitives.3.radius\" is no index into a list of 1 (counted from 0)");
    EXPECT_EQ(refusal(withScene("[expand]\n\"name.x\" = [1]\n")), "a.toml:11:1: \"name.x\" cannot be expanded");
    std::string many = "[0";
    for (int i = 1; i < 70; ++i)
        many += ", " + std::to_string(i);
    EXPECT_EQ(refusal(withScene("[expand]\nmaterial.roughness = " + many + "]\nmaterial.ior = " + many + "]\n")),
              "a.toml:12:10: [expand] makes more than 4096 sub-cases; at most that many are allowed");
}

TEST_F(Expansion, overridesReplaceValuesAndLists)
{
    const auto file =
        write("a.toml",
              withScene("[material]\nior = 1.5\n[expand]\nmaterial.ior = [1.2, 1.3]\nmaterial.thickness = [1, 2]\n"));
    const std::vector<Case> cases = readCaseFile(file, {{"material.ior", "1.9"}, {"projection.model", "hiz"}});
    EXPECT_EQ(namesOf(cases), (std::vector<std::string>{"a/b[thickness=1]", "a/b[thickness=2]"}));
    EXPECT_EQ(cases[0].material.ior, 1.9);
    EXPECT_EQ(cases[0].projection.model, ProjectionModel::kHiz);
    EXPECT_EQ(readCaseFile(file, {{"scene.size", "[3, 5]"}}).at(0).camera.height, 5);
}

TEST_F(Expansion, overridesAreCheckedLikeTheFile)
{
    const auto file = write("a.toml", withScene(""));
    const auto refused = [&](const std::string& path, const std::string& text) {
        return messageOf([&] { readCaseFile(file, {{path, text}}); });
    };
    EXPECT_EQ(refused("material.ior", "11"), "--set material.ior: \"ior\" is 11; above 0, at most 10 is allowed");
    EXPECT_EQ(refused("material.ior", "nan"), "--set material.ior: nan is not allowed; a finite number is");
    EXPECT_EQ(refused("material.ior", "high"),
              "--set material.ior: \"ior\" is a string; a number is allowed: above 0, at most 10");
    EXPECT_OPENS(refused("material.iro", "1"), "--set material.iro: unknown key \"iro\" in [materi");
    EXPECT_EQ(refused("", "1"), "--set : \"\" names no key; a dotted path such as material.ior is allowed");
    EXPECT_EQ(refused("name.x", "1"),
              "--set name.x: \"name.x\" leads through a string; only tables and lists have keys");
    EXPECT_OPENS(refused("projection.model", "hzi"),
                 "--set projection.model: \"hzi\" is no name for \"model\"; did you ");
}

TEST_F(Expansion, presetsLieUnderTheCase)
{
    write("presets.toml",
          "schema = 1\n[tolerance.exact]\ndegrees = 0.5\n"
          "[preset.glass]\nmaterial = { ior = 2, thickness = 3 }\nscene.primitives = [{ shape = \"plane\" }]\n"
          "[preset.thick]\nmaterial.thickness = 7\n"
          "[[preset.agree.expect]]\noutput = \"HitSuccess\"\nagree = [\"osmesa\", \"cpu64\"]\n");
    const auto text = [](const std::string& use) {
        return "schema = 1\nname = \"a\"\nsummary = \"b\"\nuse = " + use +
               "\n[material]\nior = 1.1\n[scene]\nprimitives = [{ shape = \"sphere\", radius = 1 }]\n"
               "[[expect]]\noutput = \"RayDirWS\"\nanalytic = \"x\"\ntolerance = \"exact\"\n";
    };
    const auto file = write("deep/er/a.toml", text("[\"glass\", \"thick\", \"agree\"]"));
    const Case c = readCaseFile(file).at(0);
    EXPECT_EQ(c.material.ior, 1.1);
    EXPECT_EQ(c.material.thickness, 7); // the later preset wins
    ASSERT_EQ(c.scene.primitives.size(), 2u);
    EXPECT_EQ(c.scene.primitives[0].shape, PrimitiveShape::kSphere); // the case's own come first
    EXPECT_EQ(c.expectations[0].tolerance.degrees, 0.5);
    ASSERT_EQ(c.expectations.size(), 2u);
    EXPECT_EQ(c.expectations[1].output.name, "HitSuccess");

    EXPECT_EQ(messageOf([&] { readCaseFile(write("a.toml", text("[\"glas\"]"))); }),
              "a.toml:4:8: \"glas\" is no [preset.NAME] of the presets; did you mean \"glass\"? Allowed: glass, thick, "
              "agree");
}

TEST_F(Expansion, presetsAreCheckedToo)
{
    const std::string own =
        "schema = 1\nname = \"a\"\nsummary = \"b\"\nscene = {}\n[[expect]]\noutput = \"RayDirWS\"\nanalytic = \"x\"\n";
    EXPECT_EQ(refusal(own + "tolerance = \"exact\"\n"),
              "a.toml:8:13: \"exact\" names a preset; a presets.toml in the case's folder or above it is required");
    write("presets.toml", "[tolerance.exact]\nrelative = 0.5\n");
    EXPECT_EQ(refusal(own + "tolerance = \"exact\"\n"),
              "presets.toml:2:1: \"relative\" is no bound of RayDirWS; allowed: degrees, outliers and worst");
    write("presets.toml", "[tolerance.exact]\ndegrees = 0.5\ndegree = 3\n");
    EXPECT_OPENS(refusal(own + "tolerance = { degrees = 1 }\n"),
                 "presets.toml:3:1: unknown key \"degree\" in [expect.tolerance]; did you mean \"de");
    write("presets.toml", "[presets.a]\nx = 1\n\n\n");
    EXPECT_EQ(
        refusal(own + "tolerance = { degrees = 1 }\n"),
        "presets.toml:1:2: \"presets\" is not allowed in presets; schema = 1, [tolerance.NAME] and [preset.NAME] are");
    write("presets.toml", "[preset.a]\nname = \"longer than before, so that the change is seen\"\n");
    EXPECT_EQ(refusal(own + "tolerance = { degrees = 1 }\n"),
              "presets.toml:2:1: \"name\" is not allowed in a preset; it is the case's own");
    write("presets.toml", "[preset.a]\nmaterial.ior = 77\n# and a change of length\n\n");
    EXPECT_EQ(refusal("use = [\"a\"]\n" + own + "tolerance = { degrees = 1 }\n"),
              "presets.toml:2:16: \"ior\" is 77; above 0, at most 10 is allowed");
}
