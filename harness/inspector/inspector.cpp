#include "harness/inspector/inspector.h"

#include "harness/inspect/trace_json.h"
#include "harness/inspector/controls.h"
#include "harness/report/page.h"
#include "harness/report/report_index.h"
#include "harness/run/environment.h"
#include "harness/run/run_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace crossray {

namespace {

using Json = nlohmann::ordered_json;

struct UnknownCase : std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::string dump(const Json& json)
{
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// What went wrong as a status: the request's form, what it names, what is there already, or what it asks for.
template <typename Answer>
Reply answerOrRefuse(const Answer& answer)
{
    try {
        return answer();
    } catch (const BadQuestion& error) {
        return makeErrorReply(400, error.what());
    } catch (const UnknownCase& error) {
        return makeErrorReply(404, error.what());
    } catch (const AlreadyThere& error) {
        return makeErrorReply(409, error.what());
    } catch (const Error& error) {
        return makeErrorReply(422, error.what());
    } catch (const std::exception& error) {
        return makeErrorReply(500, fmt::format("unexpected failure: {}", error.what()));
    }
}

std::optional<Reply> replyToEnd(WorkEnd end)
{
    if (end == WorkEnd::kDone) return std::nullopt;
    const bool isCancelled = end == WorkEnd::kCancelled;
    const Json json{{isCancelled ? "cancelled" : "superseded", true},
                    {"error", isCancelled ? "the work was cancelled" : "a newer request took its place"}};
    return Reply{409, dump(json)};
}

Json formatTimes(const LiveTimes& times)
{
    return {{"prepare", times.prepare}, {"compile", times.compile},   {"judge", times.judge},
            {"total", times.total},     {"backends", times.backends}, {"shader", times.shader}};
}

RunResult describeSession(const InspectorSetup& setup, const std::vector<const Case*>& cases)
{
    RunResult run;
    run.version = toolVersion();
    run.commandLine = setup.commandLine;
    run.cores = countAvailableCores();
    run.compilers = ShaderCompiler::versions();
    for (const Case* testCase : cases)
        run.cases.push_back(startCaseResult(*testCase));
    return run;
}

} // namespace

Inspector::Inspector(InspectorSetup setup) : setup_(std::move(setup)), renderer_(setup_.live)
{
    for (Case& testCase : setup_.selected) {
        order_.push_back(testCase.name);
        cases_.emplace(testCase.name, std::move(testCase));
    }
    setup_.selected.clear();
}

Case Inspector::findCase(const std::string& name) const
{
    const std::lock_guard lock(mutex_);
    const auto found = cases_.find(name);
    if (found == cases_.end())
        throw UnknownCase(fmt::format("there is no case \"{}\" among those that are shown", name));
    return found->second;
}

// The file is read anew each time: it may be edited while it is looked at.
CaseTree Inspector::readTree(const Question& question) const
{
    const Case testCase = findCase(question.caseName);
    CaseTree tree = readCaseTree(testCase.file, testCase.name, question.parameters);
    const Camera& camera = tree.testCase.camera;
    const bool setsSize = std::any_of(question.parameters.begin(), question.parameters.end(),
                                      [](const auto& each) { return each.first.starts_with("scene.size"); });
    if (setsSize && int64_t{camera.width} * camera.height > kMostPixels) {
        throw InputError(fmt::format("scene.size: {} x {} pixels; at most {} are allowed here", camera.width,
                                     camera.height, kMostPixels));
    }
    return tree;
}

void Inspector::checkBackends(const std::vector<std::string>& backends, size_t most) const
{
    const std::vector<std::string>& known = setup_.live.backends;
    if (backends.empty() || backends.size() > most)
        throw InputError(fmt::format("{} backends; 1 to {} are allowed", backends.size(), most));
    for (size_t i = 0; i < backends.size(); ++i) {
        if (std::find(known.begin(), known.end(), backends[i]) == known.end())
            throw InputError(fmt::format("\"{}\" is no backend; allowed are {}", backends[i], fmt::join(known, ", ")));
        if (std::find(backends.begin(), backends.begin() + static_cast<ptrdiff_t>(i), backends[i]) !=
            backends.begin() + static_cast<ptrdiff_t>(i))
            throw InputError(fmt::format("\"{}\" is twice among the backends; once is allowed", backends[i]));
    }
}

Reply Inspector::page() const
{
    std::vector<const Case*> cases;
    const std::lock_guard lock(mutex_);
    for (const std::string& name : order_)
        cases.push_back(&cases_.at(name));
    const RunResult run = describeSession(setup_, cases);
    ReportIndex pieces;
    pieces.cases.resize(run.cases.size());
    Json index = Json::parse(formatIndexJson(run, ReportOptions{}, pieces));
    index["live"] = true;
    index["token"] = setup_.token;
    index["backends"] = Json::array();
    for (const BackendInfo& info : listBackends()) {
        const auto& known = setup_.live.backends;
        if (std::find(known.begin(), known.end(), info.name) == known.end()) continue;
        index["backends"].push_back({{"name", info.name}, {"default", info.byDefault}});
    }
    const PageData data{"index", dump(index)};
    return {200, formatPage("crossray: inspector", {&data, 1}), "text/html; charset=utf-8"};
}

Reply Inspector::data(const std::string& piece) const
{
    std::optional<PieceStore::Data> data = pieces_.find(piece);
    if (!data) return makeErrorReply(404, "there is no such piece of data any more; render again");
    return {200, std::move(data->bytes), data->isJson ? "application/json" : "application/octet-stream"};
}

Reply Inspector::controls(const std::string& caseName) const
{
    return answerOrRefuse([&] {
        Question question;
        question.caseName = caseName;
        return Reply{200, formatControlsJson(listControls(readTree(question)))};
    });
}

Reply Inspector::render(const std::string& body)
{
    return answerOrRefuse([&] {
        static constexpr std::string_view kFields[] = {"case", "parameters", "backends", "generation"};
        const Question question = parseQuestion(body, kFields);
        checkBackends(question.backends, setup_.live.backends.size());
        const auto tree = std::make_shared<const CaseTree>(readTree(question));
        // Shared with the queue's thread, which may outlast this call where nobody wants the answer any more.
        const auto live = std::make_shared<LiveRender>();
        const WorkEnd end =
            queue_.run(WorkKind::kRender, [this, tree, live, backends = question.backends](WorkWatch& watch) {
                *live = renderer_.render(*tree, backends, watch);
            });
        if (const std::optional<Reply> refusal = replyToEnd(end)) return *refusal;
        const PieceStore::Names names = pieces_.keep("[" + formatCaseJson(live->result) + "]", std::move(live->planes));
        const Json item = Json::parse(formatIndexCase(live->result, {names.details, names.planes}));
        Json json{{"item", item}, {"planes", names.planes}, {"milliseconds", formatTimes(live->times)}};
        if (question.generation) json["generation"] = *question.generation;
        return Reply{200, dump(json)};
    });
}

Reply Inspector::trace(const std::string& body)
{
    return answerOrRefuse([&] {
        static constexpr std::string_view kFields[] = {"case", "parameters", "backends", "pixel", "generation"};
        const Question question = parseQuestion(body, kFields);
        checkBackends(question.backends, 2);
        const auto tree = std::make_shared<const CaseTree>(readTree(question));
        const auto live = std::make_shared<LiveTrace>();
        const WorkEnd end = queue_.run(WorkKind::kTrace, [this, tree, live, pixel = question.pixel,
                                                          backends = question.backends](WorkWatch& watch) {
            *live = renderer_.trace(*tree, pixel, backends, watch);
        });
        if (const std::optional<Reply> refusal = replyToEnd(end)) return *refusal;
        Json json = Json::parse(formatTraceJson(live->trace));
        json["milliseconds"] = formatTimes(live->times);
        if (question.generation) json["generation"] = *question.generation;
        return Reply{200, dump(json)};
    });
}

Reply Inspector::save(const std::string& body)
{
    return answerOrRefuse([&] {
        static constexpr std::string_view kFields[] = {"case", "parameters", "name"};
        const Question question = parseQuestion(body, kFields);
        const SavedCase saved = saveCase(readTree(question), question.name, setup_.cases);
        const Case testCase = readCaseTree(saved.file, saved.name, {}).testCase;
        const Json item = Json::parse(formatIndexCase(startCaseResult(testCase), {}));
        {
            const std::lock_guard lock(mutex_);
            order_.push_back(testCase.name);
            cases_.emplace(testCase.name, testCase);
        }
        return Reply{200, dump(Json{{"file", saved.file.generic_string()}, {"case", saved.name}, {"item", item}})};
    });
}

Reply Inspector::progress() const
{
    const LatestQueue::State state = queue_.state();
    return {200, dump(Json{{"busy", state.isBusy},
                           {"what", state.progress.what},
                           {"done", state.progress.done},
                           {"total", state.progress.total},
                           {"seconds", state.seconds}})};
}

Reply Inspector::cancel()
{
    return {200, dump(Json{{"cancelled", queue_.cancel()}})};
}

} // namespace crossray
