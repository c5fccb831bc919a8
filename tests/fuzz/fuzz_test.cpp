// Random cases through the backends: never a NaN or an infinity, never more iterations than the settings allow, and the
// same classes wherever the question can be decided. What fails is cut down and written as a case.
#include "tests/fuzz/case_fuzzer.h"

#include "harness/base/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <thread>

using namespace crossray;
namespace fs = std::filesystem;

namespace {

// Cases that share their names and switches, and so most of their shader variants: compiling one takes as long as
// running a hundred.
constexpr uint64_t kCasesPerVariant = 40;
constexpr uint64_t kAllDriversEvery = 7; // shares no factor with the number of turns
constexpr int kCores = 2;
constexpr int kMostCuts = 300;

uint64_t readVariable(const char* name, uint64_t otherwise)
{
    const char* const text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// Drivers beside cpu64 and cpu32 in the order of their turns, where they are installed. The two that LLVM compiles for
// take five times as long as the others and share their arithmetic: together they have one turn in three.
std::vector<std::string> findDrivers()
{
    const char* const asked = std::getenv("CROSSRAY_FUZZ_BACKENDS");
    std::istringstream list(asked ? asked : "swiftshader,softpipe,lavapipe,swiftshader,softpipe,osmesa");
    std::vector<std::string> names;
    for (std::string name; std::getline(list, name, ',');) {
        for (const BackendInfo& info : listBackends()) {
            if (info.name == name && info.found) names.push_back(name);
        }
    }
    return names;
}

// A driver compiles each variant for as long as it runs a hundred cases: the cases that share variants share one
// driver, and every seventh group of them is run by all.
std::vector<std::string> chooseDrivers(const std::vector<std::string>& turns, uint64_t seed)
{
    const uint64_t group = seed / kCasesPerVariant;
    if (turns.empty()) return {};
    if (group % kAllDriversEvery != kAllDriversEvery - 1) return {turns[group % turns.size()]};
    const std::set<std::string> all(turns.begin(), turns.end());
    return {all.begin(), all.end()};
}

CaseFuzzer::Options makeOptions(const fs::path& shaders)
{
    CaseFuzzer::Options options;
    options.shaders = shaders;
    options.cache = CROSSRAY_BINARY_DIR "/fuzz-cache";
    options.executable = CROSSRAY_BINARY_DIR "/worker_program";
    options.cores = kCores;
    return options;
}

rc::Shrinkable<Node> drawFuzzCase(const CaseFuzzer& fuzzer, uint64_t seed, int core)
{
    return genCase(seed / kCasesPerVariant, fuzzer.scratchFile(core))(rc::Random(seed), rc::kNominalSize);
}

struct Totals {
    size_t refused = 0, untraced = 0, rays = 0, differing = 0, undecidable = 0, findings = 0;
    struct Share {
        size_t cases = 0;
        double seconds = 0;
    };
    std::map<std::string, Share> byBackend;

    void add(const CaseOutcome& outcome)
    {
        refused += !outcome.refused.empty();
        untraced += outcome.refused.empty() && outcome.pixels == 0;
        rays += outcome.pixels;
        differing += outcome.differingPixels;
        undecidable += outcome.undecidablePixels;
        findings += outcome.finding.has_value();
        for (const auto& [backend, seconds] : outcome.asked) {
            ++byBackend[backend].cases;
            byBackend[backend].seconds += seconds;
        }
    }

    void print(uint64_t cases) const
    {
        fmt::print("{} cases, {} refused, {} without rays, {} rays, {} of another class than on cpu64, of which {} are "
                   "undecidable; {} findings\n",
                   cases, refused, untraced, rays, differing, undecidable, findings);
        for (const auto& [backend, share] : byBackend)
            fmt::print("  {:<12} {:>6} cases {:>8.1f} s\n", backend, share.cases, share.seconds);
    }
};

void reportFinding(const CaseFuzzer& fuzzer, std::vector<std::string> backends, uint64_t seed, const Node& smallest,
                   const Finding& finding)
{
    backends.insert(backends.end(), {"cpu32", "cpu64"});
    const std::string name = fmt::format("found_{}", seed);
    const fs::path file = fuzzer.scratchFile(0).parent_path() / (name + ".toml");
    std::ofstream(file) << formatFinding(smallest, finding, name, backends);
    fmt::print(stderr, "case {}: {}\n", seed, finding.text);
    ADD_FAILURE() << "CROSSRAY_FUZZ_FIRST=" << seed << " CROSSRAY_FUZZ_CASES=1: " << finding.text << "\n  crossray run "
                  << file.string();
}

} // namespace

TEST(Fuzz, RandomCasesAreFiniteBoundedAndAgree)
{
    const uint64_t first = readVariable("CROSSRAY_FUZZ_FIRST", 0), count = readVariable("CROSSRAY_FUZZ_CASES", 500);
    const CaseFuzzer::Options options = makeOptions(fs::path(CROSSRAY_SOURCE_DIR) / "shaders");
    const std::vector<std::string> drivers = findDrivers();
    CaseFuzzer fuzzer(options);
    std::atomic<uint64_t> next = first / kCasesPerVariant;
    std::mutex mutex;
    Totals totals;
    const auto serve = [&](int core) {
        for (uint64_t group = next++; group * kCasesPerVariant < first + count; group = next++) {
            const uint64_t begin = std::max(first, group * kCasesPerVariant);
            const uint64_t end = std::min(first + count, (group + 1) * kCasesPerVariant);
            for (uint64_t seed = begin; seed < end; ++seed) {
                const rc::Shrinkable<Node> drawn = drawFuzzCase(fuzzer, seed, core);
                const std::vector<std::string> asked = chooseDrivers(drivers, seed);
                CaseOutcome outcome = fuzzer.check(drawn.value(), core, asked);
                std::optional<Node> smallest;
                if (outcome.finding) smallest = fuzzer.minimize(drawn, *outcome.finding, core, asked, kMostCuts);
                const std::lock_guard lock(mutex);
                totals.add(outcome);
                if (outcome.finding) reportFinding(fuzzer, asked, seed, *smallest, *outcome.finding);
            }
            if (count >= 2000) fmt::print(stderr, "to {}: {} rays, {} findings\n", end, totals.rays, totals.findings);
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int core = 0; core < kCores; ++core)
            threads.emplace_back(serve, core);
    }
    totals.print(count);
    if (count < 100) return;
    // Else the cases ask for nothing.
    EXPECT_LT(totals.refused, count / 10);
    EXPECT_LT(totals.untraced, count / 3);
    EXPECT_GT(totals.rays, count * 10);
}

// Every key of the schema that speaks to a shader is drawn, and what is drawn is read by rules that stand in the reader
// alone.
TEST(Fuzz, EveryKeyIsDrawn)
{
    const TemporaryFolder folder("fuzz");
    std::map<std::string, int> drawn;
    const std::function<void(const Node&, const std::string&)> count = [&](const Node& table, const std::string& name) {
        for (const NodeEntry& entry : table.entries) {
            ++drawn[name.empty() ? entry.key : name + "." + entry.key];
            const std::string inner = subTableName(name, entry.key);
            if (entry.value.kind == NodeKind::kTable) count(entry.value, inner);
            for (const Node& item : entry.value.items) {
                if (item.kind == NodeKind::kTable) count(item, inner);
            }
        }
    };
    std::set<std::string> missing;
    for (const CaseKey& key : caseSchema()) {
        const std::string path = key.table.empty() ? key.key : key.table + "." + key.key;
        const bool isText = key.type == "string" || key.type == "list of strings" || key.type == "date";
        const bool isRun = key.table.starts_with("expect") || key.table.starts_with("known_failure") ||
                           key.table.starts_with("gbuffer") || key.table == "expand" || key.table == "rotation" ||
                           key.table.empty();
        if (!isText && !isRun) missing.insert(path);
    }
    for (uint64_t seed = 0; seed < 600 && !missing.empty(); ++seed) {
        rc::Random values(seed);
        Node root = drawCase(rc::Random(seed), values.split());
        if (readOrRepair(root, rc::Random(seed), values, folder.path() / "case.toml")) count(root, "");
        std::erase_if(missing, [&](const std::string& path) { return drawn.contains(path); });
    }
    EXPECT_TRUE(missing.empty()) << fmt::format("{}", fmt::join(missing, ", "));
}

// A fault in a copy of the shaders: transmittances above 1 amplify. It is found, cut down, and written as a case that
// fails with that copy and passes with the shaders as they are.
TEST(Fuzz, AFaultIsFoundCutDownAndWrittenAsACase)
{
    const TemporaryFolder folder("fault");
    const fs::path shaders = folder.path() / "shaders";
    fs::copy(fs::path(CROSSRAY_SOURCE_DIR) / "shaders", shaders, fs::copy_options::recursive);
    const fs::path faulty = shaders / "crossray/refract/absorption.glsl";
    std::ostringstream text;
    text << std::ifstream(faulty).rdbuf();
    std::string code = text.str();
    const std::string guard = "return transmittance < 1.0 ? max(transmittance, kSmallestTransmittance) : 1.0;";
    ASSERT_NE(code.find(guard), std::string::npos);
    code.replace(code.find(guard), guard.size(), "return max(transmittance, kSmallestTransmittance);");
    std::ofstream(faulty) << code;

    const CaseFuzzer::Options options = makeOptions(shaders);
    std::vector<std::string> drivers = findDrivers();
    if (drivers.empty()) GTEST_SKIP() << "no driver is installed";
    drivers.resize(1);
    CaseFuzzer fuzzer(options);
    std::optional<Finding> finding;
    Node smallest;
    for (uint64_t seed = 0; seed < 800 && !finding; ++seed) {
        const rc::Shrinkable<Node> drawn = drawFuzzCase(fuzzer, seed, 0);
        const Node root = drawn.value();
        const Node* const material = root.find("material");
        // The others have no transmittance to be wrong, and each takes a compilation.
        if (material == nullptr || material->find("transmittance_color") == nullptr) continue;
        finding = fuzzer.check(root, 0, drivers).finding;
        if (finding) smallest = fuzzer.minimize(drawn, *finding, 0, drivers, kMostCuts);
    }
    ASSERT_TRUE(finding);
    EXPECT_EQ(finding->kind, FindingKind::kRange) << finding->text;
    EXPECT_EQ(finding->output, "Transmittance") << finding->text;
    EXPECT_NE(smallest.find("material")->find("transmittance_color"), nullptr);
    for (const char* gone : {"probe", "history", "hierarchy", "sky", "profile"})
        EXPECT_EQ(smallest.find(gone), nullptr) << gone;

    const fs::path file = folder.path() / "found.toml";
    std::ofstream(file) << formatFinding(smallest, *finding, "found", {drivers.front(), "cpu64"});
    const auto run = [&](const fs::path& root) {
        const std::string command =
            fmt::format("{}/crossray run {} --backend {} --shaders {} --no-report --progress none -o {} >{} 2>&1",
                        CROSSRAY_BINARY_DIR, file.string(), drivers.front(), root.string(),
                        (folder.path() / "run").string(), (folder.path() / "log").string());
        return WEXITSTATUS(std::system(command.c_str()));
    };
    EXPECT_EQ(run(shaders), 1);
    EXPECT_EQ(run(fs::path(CROSSRAY_SOURCE_DIR) / "shaders"), 0);
}
