#include "harness/run/result_cache.h"

#include "harness/base/text.h"
#include "harness/run/case_flight.h"
#include "harness/run/case_json.h"
#include "harness/run/plane_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>

namespace crossray {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

// Raised where an entry's meaning changes though its form does not.
constexpr uint64_t kKeptFormat = 1;

Json fingerprintToJson(const Fingerprint& print)
{
    return {print.backend, print.api, print.device, print.driver, print.llvm, print.cpu};
}

bool areSame(const Fingerprint& a, const Fingerprint& b)
{
    return fingerprintToJson(a) == fingerprintToJson(b);
}

Hash128 hashFromHex(const std::string& hex)
{
    Hash128 hash;
    const auto parse = [&](size_t begin, uint64_t& word) {
        const char* const end = hex.data() + begin + 16;
        return std::from_chars(hex.data() + begin, end, word, 16).ptr == end;
    };
    if (hex.size() != 32 || !parse(0, hash.high) || !parse(16, hash.low)) throw InputError("no hash");
    return hash;
}

bool comparesBackends(const Case& testCase)
{
    return std::any_of(testCase.expectations.begin(), testCase.expectations.end(),
                       [](const Expectation& expectation) { return isAgreement(expectation); });
}

} // namespace

Hash128 hashProgram()
{
    ContentHashes hashes;
    return hashes.find("/proc/self/exe");
}

std::string encodeKept(const KeptResult& kept)
{
    Json shaders = Json::object(), devices = Json::object();
    for (const auto& [path, hash] : kept.shaders)
        shaders[path] = hash.hex();
    for (const auto& [backend, print] : kept.devices)
        devices[backend] = fingerprintToJson(print);
    return Json{{"key", kept.key.hex()},
                {"shaders", std::move(shaders)},
                {"devices", std::move(devices)},
                {"case", caseToJson(kept.result)}}
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<KeptResult> decodeKept(std::string_view text)
{
    try {
        const Json json = Json::parse(text);
        KeptResult kept;
        kept.key = hashFromHex(json.at("key").get<std::string>());
        for (const auto& [path, hash] : json.at("shaders").items())
            kept.shaders[path] = hashFromHex(hash.get<std::string>());
        for (const auto& [backend, print] : json.at("devices").items()) {
            const auto words = print.get<std::array<std::string, 6>>();
            kept.devices[backend] = {words[0], words[1], words[2], words[3], words[4], words[5]};
        }
        kept.result = caseFromJson(json.at("case"));
        return kept;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

KeptResults::KeptResults(RunIdentity identity, const fs::path& shaderRoot)
    : identity_(identity), shaderRoot_(fs::weakly_canonical(fs::absolute(shaderRoot)))
{
}

Hash128 KeptResults::keyOf(const Case& testCase)
{
    Hasher hasher;
    hasher.addNumber(kKeptFormat).addHash(identity_.program);
    hasher.addNumber(identity_.validation ? 1 : 0).addNumber(static_cast<uint64_t>(identity_.repeat));
    // The name tells sub-cases of one file apart; positions and the summary are in the file.
    hasher.addString(testCase.name).addString(testCase.file.generic_string());
    return hasher.addHash(hashes_.hashFilesOf(testCase)).finish();
}

KeptResult KeptResults::make(const Case& testCase, const CaseResult& result, std::span<const fs::path> shaderFiles,
                             const std::map<std::string, Fingerprint>& devices)
{
    KeptResult kept{keyOf(testCase), {}, {}, result};
    for (const fs::path& file : shaderFiles) {
        const fs::path path = fs::weakly_canonical(fs::absolute(file)).lexically_relative(shaderRoot_);
        kept.shaders[path.generic_string()] = hashes_.find(shaderRoot_ / path);
    }
    for (const BackendResult& backend : result.backends) {
        if (const auto print = devices.find(backend.backend); print != devices.end()) kept.devices.insert(*print);
    }
    return kept;
}

std::optional<CaseResult> KeptResults::answer(const KeptResult& kept, const Case& testCase,
                                              std::span<const std::string> backends,
                                              const std::map<std::string, Fingerprint>& devices)
{
    if (kept.key != keyOf(testCase) || kept.result.name != testCase.name) return std::nullopt;
    if (comparesBackends(testCase) && backends.size() != kept.result.backends.size()) return std::nullopt;
    CaseResult result = kept.result;
    result.backends.clear();
    for (const std::string& backend : backends) {
        const auto found = std::find_if(kept.result.backends.begin(), kept.result.backends.end(),
                                        [&](const BackendResult& one) { return one.backend == backend; });
        if (found == kept.result.backends.end()) return std::nullopt;
        if (runsOn(testCase, backend)) {
            const auto then = kept.devices.find(backend), now = devices.find(backend);
            if (then == kept.devices.end() || now == devices.end() || !areSame(then->second, now->second)) {
                return std::nullopt;
            }
        }
        result.backends.push_back(*found);
    }
    for (const auto& [path, hash] : kept.shaders) {
        if (hashes_.find(shaderRoot_ / path) != hash) return std::nullopt;
    }
    return result;
}

std::optional<KeptResult> ResultCache::find(const Hash128& key) const
{
    const auto bytes = files_.find(key);
    if (!bytes) return std::nullopt;
    return decodeKept({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

void ResultCache::store(const KeptResult& kept) const
{
    const auto isKept = [](const BackendResult& result) {
        // A skip is the case's own wish; one for want of another backend's answer bears judged expectations.
        return result.verdict == Verdict::kPass || (result.verdict == Verdict::kSkip && result.expectations.empty());
    };
    if (!std::all_of(kept.result.backends.begin(), kept.result.backends.end(), isKept)) return;
    KeptResult bare = kept;
    bare.result.expectedFile.clear(); // planes are the run's own
    if (bare.result.conditioning) bare.result.conditioning->file.clear();
    for (BackendResult& result : bare.result.backends)
        result.planesFile.clear();
    const std::string text = encodeKept(bare);
    files_.store(kept.key, std::as_bytes(std::span(text.data(), text.size())));
}

bool ResultCache::isEmpty() const
{
    std::error_code failure;
    return fs::is_empty(folder_, failure) || failure;
}

fs::path RunJournal::fileOf(const fs::path& runFolder)
{
    return runFolder / "finished.jsonl";
}

RunJournal::RunJournal(const fs::path& runFolder, bool resume)
{
    const fs::path file = fileOf(runFolder);
    bool endsLine = true;
    if (resume) {
        const std::string text = readText(file).value_or("");
        for (size_t begin = 0; begin < text.size();) {
            const size_t end = std::min(text.find('\n', begin), text.size());
            // The last line may be cut off where the run was killed: that case runs again.
            if (auto kept = decodeKept(std::string_view(text).substr(begin, end - begin))) {
                const std::string name = kept->result.name;
                earlier_.insert_or_assign(name, std::move(*kept));
            }
            begin = end + 1;
        }
        endsLine = text.empty() || text.back() == '\n';
    }
    stream_.open(file, std::ios::binary | (resume ? std::ios::app : std::ios::trunc));
    if (!endsLine) stream_ << '\n';
    if (!stream_.flush()) throw EnvironmentError(fmt::format("{}: cannot be written", file.string()));
}

std::optional<KeptResult> RunJournal::find(const std::string& caseName) const
{
    const auto found = earlier_.find(caseName);
    return found == earlier_.end() ? std::nullopt : std::optional(found->second);
}

void RunJournal::add(const KeptResult& kept)
{
    const std::string line = encodeKept(kept) + "\n";
    const std::lock_guard lock(mutex_);
    stream_.write(line.data(), static_cast<std::streamsize>(line.size()));
    stream_.flush(); // a full disk is told when run.json is written
}

void remember(const ResultMemory& memory, std::span<const std::string> backends, ExecuteSteps& steps)
{
    const std::vector<std::string> names(backends.begin(), backends.end());
    const bool asksCache = memory.cache != nullptr && memory.recalls && !memory.cache->isEmpty();
    if (memory.resumes || asksCache) {
        steps.recall = [=](const Case& testCase, const ExecuteSteps::Devices& devices) -> std::optional<CaseResult> {
            const auto answer = [&](const std::optional<KeptResult>& kept, const char* by) {
                auto result = kept ? memory.kept.answer(*kept, testCase, names, devices) : std::nullopt;
                if (result) result->answeredBy = by;
                return result;
            };
            if (auto result = answer(memory.journal.find(testCase.name), "interrupted run")) return result;
            if (!asksCache) return std::nullopt;
            return answer(memory.cache->find(memory.kept.keyOf(testCase)), "cache");
        };
    }
    steps.keep = [=](const Case& testCase, const PreparedCase& prepared, const CaseResult& result,
                     const ExecuteSteps::Devices& devices) {
        std::vector<fs::path> shaderFiles;
        for (const std::optional<Job>* job : {&prepared.floatJob, &prepared.doubleJob}) {
            if (!*job) continue;
            for (const ProgramSource& program : (*job)->programs)
                shaderFiles.insert(shaderFiles.end(), program.files.begin(), program.files.end());
        }
        const KeptResult kept = memory.kept.make(testCase, result, shaderFiles, devices);
        memory.journal.add(kept);
        if (memory.cache != nullptr) memory.cache->store(kept);
    };
}

} // namespace crossray
