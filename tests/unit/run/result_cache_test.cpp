#include "harness/run/result_cache.h"

#include "harness/base/temporary_folder.h"
#include "harness/run/cache_folder.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace crossray;

namespace fs = std::filesystem;

namespace {

const Fingerprint kMesa{"lavapipe", "Vulkan 1.3.230", "llvmpipe", "Mesa 22.3.6", "15.0.6", "a cpu"};
const Fingerprint kCpu{"cpu64", "none", "C++ double", "g++ 12", "", "a cpu"};

void write(const fs::path& file, const std::string& text)
{
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

class ResultCacheTest : public testing::Test {
  protected:
    void SetUp() override
    {
        write(folder() / "cases/a.toml", "a case");
        write(folder() / "cases/a.exr", "a golden");
        write(folder() / "shaders/entry/a.comp", "an entry");
        write(folder() / "shaders/crossray/b.glsl", "an include");
        write(folder() / "shaders/crossray/other.glsl", "not included");
        testCase_.name = "a";
        testCase_.file = folder() / "cases/a.toml";
        Expectation golden;
        golden.source = GoldenSource{folder() / "cases/a.exr"};
        testCase_.expectations = {golden};
        result_.name = "a";
        result_.backends = {makeResult("lavapipe"), makeResult("cpu64")};
    }

    static BackendResult makeResult(const std::string& backend, Verdict verdict = Verdict::kPass)
    {
        BackendResult result;
        result.backend = backend;
        result.verdict = verdict;
        return result;
    }

    fs::path folder() const { return temporary_.path(); }
    // Files are hashed once a run: what has changed is seen by the next.
    KeptResults start(RunIdentity identity = {}) const { return KeptResults(identity, folder() / "shaders"); }
    KeptResult keep(KeptResults& kept) const
    {
        const std::vector<fs::path> files{folder() / "shaders/entry/a.comp", folder() / "shaders/crossray/b.glsl"};
        return kept.make(testCase_, result_, files, devices_);
    }
    std::optional<CaseResult> ask(KeptResults kept, const KeptResult& known,
                                  const std::vector<std::string>& backends = {"lavapipe", "cpu64"}) const
    {
        return kept.answer(known, testCase_, backends, devices_);
    }

    TemporaryFolder temporary_{"crossray_result_cache"};
    Case testCase_;
    CaseResult result_;
    std::map<std::string, Fingerprint> devices_{{"lavapipe", kMesa}, {"cpu64", kCpu}};
};

} // namespace

TEST_F(ResultCacheTest, anUnchangedCaseIsAnswered)
{
    KeptResults first = start();
    const auto read = decodeKept(encodeKept(keep(first)));
    ASSERT_TRUE(read);
    const auto answer = ask(start(), *read);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->backends.size(), 2u);
    EXPECT_EQ(answer->backends[0].backend, "lavapipe");
    EXPECT_EQ(answer->backends[0].verdict, Verdict::kPass);
    // Fewer backends, and in the run's own order.
    EXPECT_EQ(ask(start(), *read, {"cpu64"})->backends.size(), 1u);
    EXPECT_EQ(ask(start(), *read, {"cpu64", "lavapipe"})->backends[0].backend, "cpu64");
    EXPECT_FALSE(ask(start(), *read, {"cpu64", "osmesa"}));
}

TEST_F(ResultCacheTest, whateverAnAnswerDependsOnAsksTheDeviceAgain)
{
    KeptResults first = start();
    const KeptResult known = keep(first);
    for (const char* file : {"cases/a.toml", "cases/a.exr", "shaders/entry/a.comp", "shaders/crossray/b.glsl"}) {
        const fs::path aside = folder() / "aside";
        fs::copy_file(folder() / file, aside, fs::copy_options::overwrite_existing);
        std::ofstream(folder() / file, std::ios::app) << " ";
        EXPECT_FALSE(ask(start(), known)) << file;
        fs::remove(folder() / file);
        EXPECT_FALSE(ask(start(), known)) << file << " gone";
        fs::rename(aside, folder() / file);
        EXPECT_TRUE(ask(start(), known)) << file;
    }
    write(folder() / "cases/presets.toml", "schema = 1");
    EXPECT_FALSE(ask(start(), known));
    fs::remove(folder() / "cases/presets.toml");
    write(folder() / "shaders/crossray/other.glsl", "edited");
    EXPECT_TRUE(ask(start(), known)) << "a shader that is not included";

    EXPECT_FALSE(ask(start({{1, 2}, false, 1}), known)) << "another program";
    EXPECT_FALSE(ask(start({{}, true, 1}), known)) << "validation";
    EXPECT_FALSE(ask(start({{}, false, 2}), known)) << "repeats";
}

TEST_F(ResultCacheTest, noVerdictCrossesFingerprints)
{
    KeptResults first = start();
    const KeptResult known = keep(first);
    for (std::string Fingerprint::*part :
         {&Fingerprint::api, &Fingerprint::device, &Fingerprint::driver, &Fingerprint::llvm, &Fingerprint::cpu}) {
        devices_["lavapipe"] = kMesa;
        devices_["lavapipe"].*part += "x";
        EXPECT_FALSE(ask(start(), known));
        EXPECT_TRUE(ask(start(), known, {"cpu64"})) << "the other device is the same";
    }
    devices_.erase("lavapipe");
    EXPECT_FALSE(ask(start(), known)) << "no device";
}

TEST_F(ResultCacheTest, whatHoldsBackendsAgainstEachOtherNeedsThemAll)
{
    Expectation agreement;
    agreement.source = AgreeSource{{"lavapipe", "cpu64"}};
    testCase_.expectations = {agreement};
    KeptResults first = start();
    const KeptResult known = keep(first);
    EXPECT_TRUE(ask(start(), known));
    EXPECT_FALSE(ask(start(), known, {"lavapipe"}));
}

TEST_F(ResultCacheTest, onlyPassesAreKeptForLaterRuns)
{
    const fs::path cacheFolder = folder() / "cache/results";
    const ResultCache cache(cacheFolder);
    EXPECT_TRUE(cache.isEmpty());
    KeptResults kept = start();
    for (const Verdict verdict : allVerdicts()) {
        result_.backends[1].verdict = verdict;
        result_.backends[1].planesFile = "planes/a/cpu64.exr";
        const KeptResult one = keep(kept);
        fs::remove_all(cacheFolder);
        cache.store(one);
        const bool isKept = verdict == Verdict::kPass || verdict == Verdict::kSkip;
        EXPECT_EQ(cache.find(one.key).has_value(), isKept) << nameOf(verdict);
        if (isKept) {
            EXPECT_EQ(cache.find(one.key)->result.backends[1].planesFile, "") << "the planes are of a run";
        }
    }
}

TEST_F(ResultCacheTest, damagedEntriesAreAsGoodAsAbsent)
{
    const fs::path cacheFolder = folder() / "cache/results";
    const ResultCache cache(cacheFolder);
    KeptResults kept = start();
    const KeptResult one = keep(kept);
    cache.store(one);
    fs::path file;
    for (const auto& entry : fs::recursive_directory_iterator(cacheFolder)) {
        if (entry.is_regular_file()) file = entry.path();
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(stream)), {});
    for (size_t length = 0; length < whole.size(); length += 7) {
        std::ofstream(file, std::ios::binary) << whole.substr(0, length);
        EXPECT_FALSE(cache.find(one.key)) << length;
    }
    for (size_t place = 0; place < whole.size(); place += 5) {
        std::string changed = whole;
        changed[place] = static_cast<char>(changed[place] ^ 1);
        std::ofstream(file, std::ios::binary) << changed;
        EXPECT_FALSE(cache.find(one.key)) << place;
    }
    std::ofstream(file, std::ios::binary) << whole;
    EXPECT_TRUE(cache.find(one.key));
}

TEST_F(ResultCacheTest, theJournalKeepsWhatHadFinishedWhenTheRunWasKilled)
{
    KeptResults kept = start();
    result_.backends[1].verdict = Verdict::kFail; // failures, too
    const KeptResult one = keep(kept);
    {
        RunJournal journal(folder(), false);
        journal.add(one);
    }
    const fs::path file = RunJournal::fileOf(folder());
    std::ofstream(file, std::ios::app) << encodeKept(one).substr(0, 100); // cut off
    {
        RunJournal journal(folder(), true);
        ASSERT_TRUE(journal.find("a"));
        EXPECT_EQ(journal.find("a")->result.backends[1].verdict, Verdict::kFail);
        EXPECT_FALSE(journal.find("b"));
        KeptResult other = one;
        other.result.name = "b";
        journal.add(other); // not onto the line that was cut off
    }
    EXPECT_TRUE(RunJournal(folder(), true).find("b"));
    EXPECT_FALSE(RunJournal(folder(), false).find("a")); // a new run begins anew
}

TEST_F(ResultCacheTest, linesThatAreNoResultsAreNone)
{
    KeptResults kept = start();
    const std::string line = encodeKept(keep(kept));
    for (size_t length = 0; length < line.size(); ++length)
        EXPECT_FALSE(decodeKept(line.substr(0, length))) << length;
    for (const char* text : {"", "null", "[]", "{}", R"({"key":"zz"})", "\xff\xfe"})
        EXPECT_FALSE(decodeKept(text)) << text;
}

TEST_F(ResultCacheTest, theCacheIsCutBackToItsBoundOldestFirst)
{
    const fs::path cache = folder() / "cache";
    const auto now = fs::file_time_type::clock::now();
    for (int i = 0; i < 10; ++i) {
        const fs::path file = cache / (i % 2 == 0 ? "spirv" : "results") / std::to_string(i);
        write(file, std::string(1000, 'x'));
        fs::last_write_time(file, now - std::chrono::hours(100 - i));
    }
    write(cache / "a person's own", "kept");
    EXPECT_EQ(trimCache(cache, 10'000), 0u);
    EXPECT_EQ(trimCache(cache, 3'500), 7'000u);
    for (int i = 0; i < 10; ++i)
        EXPECT_EQ(fs::exists(cache / (i % 2 == 0 ? "spirv" : "results") / std::to_string(i)), i >= 7) << i;
    EXPECT_EQ(measureCache(cache)[1].files, 2u); // results 7 and 9
    EXPECT_EQ(clearCache(cache, {"results"}), 2'000u);
    EXPECT_EQ(clearCache(cache, {}), 1'000u);
    EXPECT_TRUE(fs::exists(cache / "a person's own"));
    EXPECT_THROW(clearCache(cache, {"a person's own"}), InputError);
}
