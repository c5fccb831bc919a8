// One case of a file with keys changed, and the file that it becomes.
#include "harness/case/case_tree.h"

#include "harness/case/build.h"
#include "harness/case/key_path.h"
#include "harness/case/presets.h"
#include "tests/unit/case/case_files.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

using namespace crossray;

namespace {

namespace fs = std::filesystem;

KeyValues values(const std::map<std::string, std::string>& texts)
{
    KeyValues parsed;
    for (const auto& [path, text] : texts)
        parsed[path] = parseOverride(path, text);
    return parsed;
}

class CaseTreeTest : public CaseFiles {
  protected:
    static constexpr const char* kGlass =
        "schema = 1\nname = \"a/glass\"\nsummary = \"It holds.\"\n\n"
        "[scene]\nprimitives = [{ shape = \"sphere\", center = [0, 0, -4], radius = 1, "
        "material = \"glass\" }]\n\n"
        "[material]\nrefraction_model = \"sphere\"\n\n"
        "[expand]\nmaterial.ior = [1.3, 1.5]\nmaterial.thickness = [1.0, 2.0]\n\n"
        "[[expect]]\noutput = \"RayDirWS\"\nanalytic = \"refraction_sphere\"\n"
        "tolerance = { degrees = 1e-3 }\n";

    std::string text(const fs::path& file) const
    {
        std::ifstream stream(file);
        std::ostringstream content;
        content << stream.rdbuf();
        return content.str();
    }
    size_t countFiles() const
    {
        size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            count += entry.is_regular_file();
        return count;
    }
};

} // namespace

TEST_F(CaseTreeTest, aSubCaseIsThatOneWithItsValues)
{
    const fs::path file = write("glass.toml", kGlass);
    const CaseTree tree = readCaseTree(file, "a/glass[ior=1.3,thickness=2]", {});
    EXPECT_EQ(tree.testCase.name, "a/glass[ior=1.3,thickness=2]");
    EXPECT_EQ(tree.testCase.material.ior, 1.3);
    EXPECT_EQ(tree.testCase.material.thickness, 2.0);
}

TEST_F(CaseTreeTest, severalKeysAreSetAtOnceAndOverTheSubCase)
{
    const fs::path file = write("glass.toml", kGlass);
    const CaseTree tree = readCaseTree(
        file, "a/glass[ior=1.3,thickness=2]",
        values({{"material.ior", "1.7"}, {"scene.primitives.0.center.2", "-5.0"}, {"camera.eye.1", "0.5"}}));
    EXPECT_EQ(tree.testCase.material.ior, 1.7);
    EXPECT_EQ(tree.testCase.material.thickness, 2.0);
    EXPECT_EQ(tree.testCase.scene.primitives[0].center, glm::dvec3(0, 0, -5));
    EXPECT_EQ(glm::dvec3(tree.testCase.camera.worldFromView[3]), glm::dvec3(0, 0.5, 0)); // the rest is the default's
}

TEST_F(CaseTreeTest, aNameThatStandsForSeveralIsRefused)
{
    const fs::path file = write("glass.toml", kGlass);
    EXPECT_EQ(messageOf([&] {
                  readCaseTree(file, "a/glass", values({{"material.ior", "1.7"}}));
              }),
              "\"a/glass\" is 2 cases when material.ior is set; one is allowed: they differ in material.thickness");
    const CaseTree tree =
        readCaseTree(file, "a/glass", values({{"material.ior", "1.7"}, {"material.thickness", "3.0"}}));
    EXPECT_EQ(tree.testCase.material.thickness, 3.0);
}

TEST_F(CaseTreeTest, whatTheFormatRefusesIsRefused)
{
    const fs::path file = write("glass.toml", kGlass);
    const std::string name = "a/glass[ior=1.3,thickness=2]";
    const auto refusal = [&](const std::string& path, const std::string& value) {
        return messageOf([&] { readCaseTree(file, name, values({{path, value}})); });
    };
    EXPECT_EQ(refusal("material.ior", "20"), "--set material.ior: \"ior\" is 20; above 0, at most 10 is allowed");
    EXPECT_OPENS(refusal("material.iro", "2"),
                 "--set material.iro: \"material.iro\" is no key of the case format; did you "
                 "mean \"material.ior\"? Allowed: ");
    EXPECT_OPENS(refusal("scene.size.7", "2"), "--set scene.size.7: \"7\" of \"7\" is no index");
    EXPECT_OPENS(refusal("scene.primitives.0.half_extents.0", "2"),
                 "--set scene.primitives.0.half_extents.0: \"scene.primitives.0.half_extents.0\" is one number of "
                 "\"half_extents\", which the case does not give");
}

TEST_F(CaseTreeTest, oneNumberOfAPresetsListIsSetInAFileOfItsOwn)
{
    write("presets.toml", "schema = 1\n[preset.far]\ncamera.eye = [1, 2, 3]\ncamera.target = [1, 2, 0]\n");
    const fs::path file = write("a/b.toml", complete("[scene]\nsize = [8, 8]\n", "use = [\"far\"]"));
    const CaseTree tree = readCaseTree(file, "a/b", values({{"camera.eye.0", "1.5"}}));
    EXPECT_EQ(glm::dvec3(tree.testCase.camera.worldFromView[3]), glm::dvec3(1.5, 2, 3));
    const SavedCase saved = saveCase(tree, "c", folder_);
    EXPECT_NE(text(saved.file).find("use = [\"far\"]"), std::string::npos) << text(saved.file);
    EXPECT_EQ(glm::dvec3(readCaseFile(saved.file).at(0).camera.worldFromView[3]), glm::dvec3(1.5, 2, 3));
}

TEST_F(CaseTreeTest, whatOnlyAPresetHoldsIsWrittenOut)
{
    write("presets.toml", "schema = 1\n[preset.box]\nscene.primitives = [{ shape = \"sphere\", radius = 1.0 }]\n");
    const fs::path file = write("a/b.toml", complete("[scene]\nsize = [8, 8]\n", "use = [\"box\"]"));
    const CaseTree tree = readCaseTree(file, "a/b", values({{"scene.primitives.0.radius", "2.0"}}));
    EXPECT_EQ(tree.testCase.scene.primitives.at(0).radius, 2.0);
    const SavedCase saved = saveCase(tree, "c", folder_);
    EXPECT_EQ(text(saved.file).find("use"), text(saved.file).find("used")) << text(saved.file);
    const Case again = readCaseFile(saved.file).at(0);
    ASSERT_EQ(again.scene.primitives.size(), 1u);
    EXPECT_EQ(again.scene.primitives[0].radius, 2.0);
}

TEST_F(CaseTreeTest, aSavedCaseIsTheSameCaseUnderItsNewName)
{
    const fs::path file = write("a/glass.toml", kGlass);
    const CaseTree tree = readCaseTree(file, "a/glass[ior=1.5,thickness=2]", values({{"material.ior", "1.25"}}));
    const SavedCase saved = saveCase(tree, "mine", folder_);
    EXPECT_EQ(saved.file, folder_ / "a" / "mine.toml");
    EXPECT_EQ(saved.name, "a/mine");
    const std::vector<Case> again = readCaseFile(saved.file);
    ASSERT_EQ(again.size(), 1u);
    EXPECT_EQ(again[0].name, "a/mine");
    EXPECT_EQ(again[0].material.ior, 1.25);
    EXPECT_EQ(again[0].material.thickness, 2.0);
    EXPECT_EQ(again[0].scene, tree.testCase.scene);
    EXPECT_EQ(again[0].camera, tree.testCase.camera);
    EXPECT_EQ(again[0].expectations.size(), tree.testCase.expectations.size());
    EXPECT_EQ(countFiles(), 2u); // and no draft
}

TEST_F(CaseTreeTest, savingNeverReplacesAndNeverLeavesTheFolder)
{
    const fs::path file = write("a/glass.toml", kGlass);
    write("b/other.toml", complete("[scene]\n"));
    fs::create_symlink("nowhere", folder_ / "a" / "dangling.toml");
    const CaseTree tree = readCaseTree(file, "a/glass[ior=1.5,thickness=2]", {});
    const std::string before = text(file);
    const auto refusal = [&](const std::string& word) { return messageOf([&] { saveCase(tree, word, folder_); }); };
    EXPECT_EQ(refusal("glass"), "a/glass.toml: is there already; another name is allowed");
    EXPECT_EQ(refusal("dangling"), "a/dangling.toml: is there already; another name is allowed");
    EXPECT_EQ(refusal("b"), "b/other.toml: is called \"a/b\" already; another name is allowed");
    for (const char* word : {"", "../out", "/tmp/out", "a/../out", "b/out", "Out", "out.toml", "out\n", "a/", "ä"}) {
        EXPECT_EQ(refusal(word),
                  "the name is no word; at most 80 of a-z, 0-9 and _ are allowed, \"a/\" may stand before them")
            << word;
    }
    EXPECT_THROW(saveCase(tree, "glass", folder_), AlreadyThere);
    EXPECT_EQ(text(file), before);
    EXPECT_EQ(countFiles(), 2u);
    EXPECT_EQ(saveCase(tree, "a/fine", folder_).file, folder_ / "a" / "fine.toml");
    EXPECT_THROW(saveCase(tree, "fine", folder_), AlreadyThere);
}

TEST_F(CaseTreeTest, aBakedProbeKeepsItsFile)
{
    const fs::path file =
        write("a/b.toml", complete("[scene]\n[[probe]]\ninfluence = { shape = \"sphere\", radius = 3.0 }\n"
                                   "environment = { capture = \"baked\" }\n"));
    const auto bakedFile = [](const Case& testCase) {
        return std::get<SceneCapture>(testCase.probes.at(0).environment.content).bakedFile.filename();
    };
    const CaseTree tree = readCaseTree(file, "a/b", {});
    EXPECT_EQ(bakedFile(tree.testCase), "b.probe1.exr");
    EXPECT_EQ(bakedFile(readCaseFile(saveCase(tree, "c", folder_).file).at(0)), "b.probe1.exr");
}

TEST_F(CaseTreeTest, textSaysTheSameWhenItIsReadAgain)
{
    const std::string odd = "text = \"a \\\"quote\\\", a \\\\ and \\u0007\"\nnumber = 1e300\nsmall = -0.0\nwhole = 7\n"
                            "float = 7.0\nday = 2026-01-31\nyes = true\nempty = []\nlist = [[1, 2.5], []]\n"
                            "\"odd key\" = 1\n[table.inner]\ntables = [{ a = 1 }, { b = { c = [] } }]\n"
                            "[[many]]\nx = 1\n[many.y]\nz = 2\n[[many]]\n";
    const Node root = parseToml(odd, "odd");
    const Node again = parseToml(formatToml(root), "again");
    EXPECT_TRUE(saysTheSame(root, again)) << formatToml(root);
    EXPECT_FALSE(saysTheSame(root, parseToml(odd + "[more]\n", "more")));
    EXPECT_FALSE(saysTheSame(parseToml("a = 1", ""), parseToml("a = 1.0", "")));
}

// Every case of the house, written as a file of its own and read again.
TEST_F(CaseTreeTest, everyCommittedCaseSaysTheSameAsAFileOfItsOwn)
{
    const fs::path root = fs::path(CROSSRAY_SOURCE_DIR) / "cases";
    size_t count = 0;
    for (const fs::path& file : findCaseFiles(root)) {
        const std::vector<Case> cases = readCaseFile(file);
        for (const Case* each : {&cases.front(), &cases.back()}) {
            const CaseTree tree = readCaseTree(file, each->name, {});
            ASSERT_EQ(tree.testCase.name, each->name);
            ASSERT_EQ(tree.testCase.scene, each->scene) << each->name;
            ASSERT_EQ(tree.testCase.camera, each->camera) << each->name;
            // As it would be read beside the original.
            Node again = parseToml(formatToml(tree.own), file.string()), whole = tree.whole;
            ASSERT_TRUE(saysTheSame(again, tree.own)) << each->name << "\n" << formatToml(tree.own);
            applyPresets(again, findPresets(file.parent_path()).get());
            again.erase("use");
            whole.erase("use");
            ASSERT_TRUE(saysTheSame(again, whole)) << each->name << "\n" << formatToml(tree.own);
            ++count;
        }
    }
    EXPECT_GT(count, 200u);
}

TEST(KeyPath, leadsToKeysAndTheirNumbers)
{
    EXPECT_EQ(findPathTarget("material.ior").spec->key, "ior");
    EXPECT_FALSE(findPathTarget("material.ior").isComponent);
    EXPECT_TRUE(findPathTarget("scene.size.0").isComponent);
    EXPECT_EQ(findPathTarget("scene.primitives.3.rotation.degrees").spec->table, "rotation");
    EXPECT_EQ(findPathTarget("probe.0.environment.gradient.zenith.1").spec->table, "scene.sky");
    EXPECT_EQ(findPathTarget("scene.primitive.0.radius").spec->table, "scene.primitives");
    EXPECT_EQ(findPathTarget("history.moved.0.primitive").spec->table, "history.moved");
    EXPECT_EQ(findPathTarget("material.ior.0").spec, nullptr);
    EXPECT_EQ(findPathTarget("").spec, nullptr);
    EXPECT_EQ(findPathTarget("..").spec, nullptr);
}
