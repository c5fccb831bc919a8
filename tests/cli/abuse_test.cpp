// Hostile shaders and hostile surroundings, from outside: each ends in a verdict of its own case or in one line that
// says what is wrong, and what has nothing to do with it passes.
#include "tests/cli/program.h"

#include <fmt/format.h>

#include <fstream>

#include <sys/mount.h>

namespace fs = std::filesystem;

namespace {

class AbuseTest : public CliTest {
  protected:
    // A case whose tracer is somebody's own GLSL, beside one that has nothing to do with it.
    void writeTracer(const std::string& body) const
    {
        writeCase("cases/plain.toml", "plain");
        writeFile("cases/mine.toml",
                  "schema = 1\nname = \"mine\"\nsummary = \"A tracer of one's own.\"\n[scene]\nsize = [8, 8]\n"
                  "primitives = [{ shape = \"plane\", center = [0, 0, -4], normal = [0, 0, 1], material = "
                  "\"mirror\" }]\n[projection]\nmodel = \"own\"\ntracer = \"mine.glsl\"\n"
                  "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"miss\"\n");
        writeFile("cases/mine.glsl", "OwnHit traceOwn(OwnRay ray)\n{\n" + body + "}\n");
    }
    nlohmann::json resultOf(const std::string& name, const std::string& folder = "out/last") const
    {
        const nlohmann::json run = readRun(folder);
        for (const auto& testCase : run["cases"]) {
            if (testCase["name"] == name) return testCase["backends"][0];
        }
        return {};
    }
    void writeLargeCase(const std::string& name, int side) const
    {
        writeFile(
            fmt::format("cases/{}.toml", name),
            fmt::format(
                "schema = 1\nname = \"{}\"\nsummary = \"Large.\"\n[scene]\nsize = [{}, {}]\nprimitives = [{{ shape = "
                "\"plane\", center = [0, 0, -4], normal = [0, 0, 1], material = \"mirror\" }}]\n[[expect]]\n{}",
                name, side, side, kUpwards));
    }

    static constexpr const char* kUpwards = // fails
        "output = \"RayDirWS\"\nconstant = [0.0, 1.0, 0.0]\ntolerance = { degrees = 1 }\n";
    static constexpr const char* kMiss = "    return ownEnd(kHitReasonSky, vec2(0.0));\n";
};

// As a shell sets them for what it starts.
class LimitedTest : public AbuseTest {
  protected:
    Outcome runLimited(const std::string& limit, const std::string& arguments) const
    {
        return run(arguments, "; " + limit + "; :");
    }
};

} // namespace

TEST_F(AbuseTest, recursionAndTenMegabytesAreErrorsOfTheirCase)
{
    const std::pair<std::string, std::string> tracers[] = {
        {"    return traceOwn(ray);\n", "cases/mine.glsl:1:8: error: 'traceOwn': recursion is not allowed"},
        {std::string(kMiss) + std::string(10 << 20, ' '), "at most 1048576 bytes"},
    };
    for (const auto& [body, text] : tracers) {
        writeTracer(body);
        const Outcome outcome = run("run --backend lavapipe --no-report");
        EXPECT_EQ(outcome.lastLine(), "1 passed, 1 failed, 0 skipped") << outcome.out.substr(0, 2000) << outcome.err;
        EXPECT_EQ(resultOf("mine")["verdict"], "error");
        EXPECT_NE(resultOf("mine")["reason"].get<std::string>().find(text), std::string::npos) << resultOf("mine");
        EXPECT_EQ(resultOf("plain")["verdict"], "pass");
    }
}

// How much a driver takes is its own matter: it answers, refuses, or dies of it, and then its worker alone.
TEST_F(AbuseTest, aHugeArrayHarmsNoOtherCase)
{
    writeTracer("    float big[100000000];\n    for (int i = 0; i < 100; ++i) big[(i * 7919 + ray.pixel.x) % "
                "100000000] = float(i);\n"
                "    if (big[ray.pixel.y] > 1000.0) return ownHit(vec2(0.0), 1.0);\n" +
                std::string(kMiss));
    const Outcome outcome = run("run --backend lavapipe --no-report --timeout 8");
    EXPECT_EQ(resultOf("plain")["verdict"], "pass") << outcome.out << outcome.err;
    const std::string verdict = resultOf("mine")["verdict"];
    if (verdict != "pass") {
        EXPECT_TRUE(verdict == "error" || verdict == "crash" || verdict == "timeout") << resultOf("mine");
        EXPECT_NE(resultOf("mine")["reason"], "");
    }
}

// In the library's own code, on a driver that runs loops to their end: the worker is killed, and the next case has
// another.
TEST_F(AbuseTest, anEndlessLoopIsATimeoutOfItsCase)
{
    fs::copy(fs::absolute(CROSSRAY_SOURCE_DIR) / "shaders", folder_ / "shaders", fs::copy_options::recursive);
    std::string entry = readFile("shaders/entry/screen_trace.comp");
    const size_t body = entry.find("    traceScreenPixel(");
    ASSERT_NE(body, std::string::npos);
    // Of large images alone, and of what no compiler can foresee.
    entry.insert(
        body,
        "    uint n = gl_NumWorkGroups.x;\n    while (n > 8u) n = n * 3u + 16u | 16u;\n    if (n == 7u) return;\n");
    writeFile("shaders/entry/screen_trace.comp", entry);
    writeCase("cases/small.toml", "small");
    writeLargeCase("large", 256);
    const Outcome outcome = run("run --backend swiftshader --no-report --timeout 8 --shaders shaders");
    if (outcome.exitCode == 3) GTEST_SKIP() << outcome.err;
    EXPECT_EQ(outcome.lastLine(), "1 passed, 1 failed, 0 skipped") << outcome.out << outcome.err;
    EXPECT_EQ(resultOf("large")["verdict"], "timeout");
    EXPECT_EQ(resultOf("large")["reason"], "no answer within 8 s");
    EXPECT_EQ(resultOf("small")["verdict"], "pass");
}

TEST_F(LimitedTest, aFileThatMayNotGrowIsOneLine)
{
    writeLargeCase("large", 500);
    const Outcome outcome = runLimited("ulimit -f 64", "run --backend cpu64 --planes all --no-report");
    EXPECT_EQ(outcome.exitCode, 3) << outcome.out << outcome.err;
    EXPECT_NE(
        outcome.err.find("out/last/planes/large/cpu64.exr: cannot be written; allowed: a writable folder with room\n"),
        std::string::npos)
        << outcome.err;
}

TEST_F(LimitedTest, withoutMemoryTheToolSaysSo)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer reserves more memory than there is";
#endif
    writeLargeCase("large", 8000);
    const Outcome outcome = runLimited("ulimit -v 1500000", "run --backend cpu64 --no-report");
    EXPECT_EQ(outcome.exitCode, 3) << outcome.out << outcome.err;
    EXPECT_NE(outcome.err.find("crossray: out of memory; "), std::string::npos) << outcome.err;
}

TEST_F(AbuseTest, aFullDiskIsOneLine)
{
    const fs::path disk = folder_ / "disk";
    fs::create_directories(disk);
    if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=256k") != 0)
        GTEST_SKIP() << "no file system can be mounted here";
    writeCase("cases/a.toml", "a");
    writeLargeCase("large", 500);
    const Outcome outcome = run("run --backend cpu64 --planes all --no-report -j1 -o disk/out");
    const nlohmann::json json = readRun("disk/out");
    size_t temporary = 0;
    for (const auto& entry : fs::recursive_directory_iterator(disk))
        temporary += entry.path().extension() == ".tmp";
    // A cache on such a disk keeps nothing, and is no error.
    writeFile("disk/fill", std::string(1 << 20, 'x'));
    const Outcome cached = run("run --backend cpu64 --no-report cases/a.toml --cache-dir disk/cache");
    EXPECT_EQ(::umount(disk.c_str()), 0);
    EXPECT_EQ(outcome.exitCode, 3) << outcome.out << outcome.err;
    EXPECT_NE(
        outcome.err.find("disk/out/planes/large/cpu64.exr: cannot be written; allowed: a writable folder with room\n"),
        std::string::npos)
        << outcome.err;
    EXPECT_EQ(json["interrupted"], true) << "what is there does not claim to be whole";
    EXPECT_EQ(temporary, 0u);
    EXPECT_EQ(cached.lastLine(), "1 passed, 0 failed, 0 skipped") << cached.out << cached.err;
}

// Cut short, of another version, and of no kind: what cannot be read is made anew.
TEST_F(AbuseTest, damagedCachesAreMadeAnew)
{
    fs::remove_all(folder_ / "cache"); // that of all tests
    writeCase("cases/a.toml", "a");
    const std::string command = "run --backend lavapipe,cpu64 --no-report";
    ASSERT_EQ(run(command).exitCode, 0);
    const auto damage = [&](const auto& change) {
        int files = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache")) {
            if (!entry.is_regular_file()) continue;
            const std::string name = fs::relative(entry.path(), folder_).string();
            writeFile(name, change(readFile(name)));
            ++files;
        }
        EXPECT_GE(files, 3);
    };
    const auto expectPass = [&](const char* what) {
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.lastLine(), "2 passed, 0 failed, 0 skipped") << what << outcome.out << outcome.err;
        const nlohmann::json json = readRun();
        for (const auto& testCase : json["cases"])
            EXPECT_EQ(testCase["answeredBy"], "") << what;
    };
    damage([](const std::string& bytes) { return bytes.substr(0, bytes.size() / 2); });
    expectPass("cut short");
    damage([](const std::string&) { return std::string(); });
    expectPass("empty");
    damage([](std::string bytes) { // another version of whatever it is
        for (size_t i = 0; i < std::min<size_t>(bytes.size(), 24); ++i)
            bytes[i] = static_cast<char>(bytes[i] ^ 0x15);
        return bytes;
    });
    expectPass("another version");
}

TEST_F(AbuseTest, aGoldenOfAnotherFingerprintIsSaidToBe)
{
    const auto writeMirror = [&](const char* normal) {
        writeFile(
            "cases/a.toml",
            fmt::format(
                "schema = 1\nname = \"a\"\nsummary = \"A mirror.\"\n[scene]\nsize = [8, 8]\nprimitives = [{{ shape = "
                "\"plane\", center = [0, 0, -4], normal = {}, material = \"mirror\" }}]\n[[expect]]\noutput = "
                "\"RayDirWS\"\ngolden = \"a.exr\"\ntolerance = {{ degrees = 1e-3 }}\n",
                normal));
    };
    writeMirror("[0, 0, 1]");
    run("run --backend cpu64 --planes all --no-report --no-cache");
    ASSERT_EQ(run("review --accept a").exitCode, 0);
    const auto noteOf = [&] {
        run("run --backend cpu64 --no-report --no-cache");
        return resultOf("a")["expectations"][0]["note"].get<std::string>();
    };
    EXPECT_EQ(noteOf(), "");
    const nlohmann::json own = nlohmann::json::parse(readFile("cases/a.exr.json"));
    nlohmann::json other = own;
    other["fingerprint"]["cpu"] = "a museum piece";
    writeFile("cases/a.exr.json", other.dump());
    EXPECT_EQ(noteOf(), fmt::format("a.exr was recorded under another fingerprint: cpu \"a museum piece\", here \"{}\"",
                                    own["fingerprint"]["cpu"].get<std::string>()));
    EXPECT_EQ(resultOf("a")["verdict"], "pass");
    // A failure says it in the terminal, of another backend, too.
    writeMirror("[0, 0.6, 0.8]");
    const Outcome failure = run("run --backend cpu32 --no-report --no-cache");
    EXPECT_EQ(failure.exitCode, 1) << failure.out << failure.err;
    EXPECT_NE(failure.out.find("      a.exr was recorded under another fingerprint: backend cpu64, here cpu32; "),
              std::string::npos)
        << failure.out;
    writeMirror("[0, 0, 1]");
    fs::remove(folder_ / "cases/a.exr.json");
    EXPECT_EQ(noteOf(), "where a.exr was recorded is not known: it has no a.exr.json");
    writeFile("cases/a.exr.json", "{}");
    EXPECT_EQ(noteOf(), "where a.exr was recorded is not known: a.exr.json does not say it");
}
