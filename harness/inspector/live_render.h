// One case at a time on warm workers: its planes on some backends, judged as a run judges them, and the record of one
// pixel. What a change leaves alone is kept.
#pragma once

#include "harness/base/work_watch.h"
#include "harness/case/case_tree.h"
#include "harness/inspect/pixel_trace.h"
#include "harness/run/results.h"
#include "harness/run/steps.h"

#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace crossray {

struct LiveTimes { // milliseconds
    double prepare = 0, compile = 0, judge = 0, total = 0;
    std::map<std::string, double> backends; // from hand-over to answer
    std::map<std::string, double> shader;   // the passes alone, by the device's clock where that is right
};

struct LiveRender {
    CaseResult result;
    std::map<std::string, std::vector<Plane>> planes; // by backend, and "expected"
    LiveTimes times;
};

struct LiveTrace {
    PixelTrace trace;
    LiveTimes times;
};

struct LiveSetup {
    std::filesystem::path shaders, cache;
    std::filesystem::path workerProgram; // empty: this program
    std::vector<std::string> backends;   // those that may be asked for
};

class LiveRenderer {
  public:
    explicit LiveRenderer(const LiveSetup& setup);

    // One call at a time. Throws InputError where the case is broken, ShaderError, and WorkCancelled; a backend that
    // crashes, hangs or refuses the shader is a verdict.
    LiveRender render(const CaseTree& tree, std::span<const std::string> backends, WorkWatch& watch);
    // The same, but that a backend without an answer is an EnvironmentError.
    LiveTrace trace(const CaseTree& tree, glm::ivec2 pixel, std::span<const std::string> backends, WorkWatch& watch);

    WorkerPool& pool() { return pool_; }

  private:
    // What is kept of a case.
    struct Kept {
        std::string caseName;
        Node whole;                           // what the data are of
        std::shared_ptr<const CaseData> data; // as rendered
        Node recordWhole;
        std::shared_ptr<const CaseData> record; // as traced
    };
    Kept& keptOf(const std::string& caseName);
    std::shared_ptr<const CaseData> prepare(const CaseTree& tree);
    std::shared_ptr<const CaseData> prepareRecord(const CaseTree& tree);
    int coreOf(const std::string& backend);
    // One job a backend, all at once. Throws what the first of them throws.
    void runAll(size_t count, const WorkWatch& watch, const std::function<void(size_t)>& job);
    void killBusy();

    LiveSetup setup_;
    WorkerPool pool_;
    ShaderCompiler compiler_;
    ExecuteSteps steps_;
    std::list<Kept> kept_; // the latest first
    std::map<std::string, int> cores_;
    std::mutex busyMutex_;
    std::map<std::string, int> busy_; // backends that run something now
    class Busy;
};

} // namespace crossray
