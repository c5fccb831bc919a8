#include "harness/run/worker_pool.h"

#include "harness/base/error.h"
#include "harness/base/temporary_folder.h"
#include "harness/run/worker_backends.h"
#include "harness/run/worker_process.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <random>
#include <set>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace crossray;
using namespace std::chrono_literals;

namespace {

WorkerOptions testOptions()
{
    WorkerOptions options;
    options.executable = CROSSRAY_BINARY_DIR "/worker_program";
    return options;
}

Job jobOf(const std::string& label)
{
    Job job;
    job.label = label;
    return job;
}

int processOf(WorkerPool& pool, const std::string& backend = "test", int core = 0)
{
    const JobReport report = pool.run(backend, core, jobOf("pid"), 10s);
    return report.outcome == JobOutcome::kDone ? static_cast<int>(report.result.readbacks.at(0).at(0)) : -1;
}

// A process that is gone, or dead and only not yet waited for.
bool isGone(int process)
{
    std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    if (!std::getline(stat, text)) return true;
    const size_t end = text.rfind(')');
    return text.compare(end + 2, 1, "Z") == 0 || text.compare(end + 2, 1, "X") == 0;
}

} // namespace

TEST(WorkerPool, echoesAJobAndStaysWarm)
{
    WorkerPool pool(testOptions());
    Job job = jobOf("hello");
    job.programs = {{"entry/a.comp", {}, {1, 2, 3}, "glsl", "key"}};
    job.images = {{2, 1, 1, 1, ImageFilter::kNearest, {0.5, 0.1}}};
    job.buffers = {{BufferKind::kUniform, {std::byte{9}}, 0}};
    for (int turn = 0; turn < 3; ++turn) {
        const JobReport report = pool.run("test", 0, job, 10s);
        ASSERT_EQ(report.outcome, JobOutcome::kDone) << report.text;
        EXPECT_EQ(report.result.readbacks, (std::vector<std::vector<double>>{{7}, {0.5, double{0.1f}}, {9}}));
        EXPECT_EQ(report.result.messages, std::vector<std::string>{"hello"});
        EXPECT_GT(report.milliseconds, 0);
    }
    EXPECT_EQ(pool.run("test64", 0, job, 10s).result.readbacks[1], (std::vector<double>{0.5, 0.1}));
    EXPECT_EQ(processOf(pool), processOf(pool));
    EXPECT_EQ(pool.processIds("test").size(), 1u);
    EXPECT_EQ(pool.processIds("test64").size(), 1u);
    EXPECT_EQ(pool.processIds("none").size(), 0u);
}

TEST(WorkerPool, carriesLargeImages)
{
    WorkerPool pool(testOptions());
    Job job = jobOf("large");
    job.images = {{1024, 1024, 4, 1, ImageFilter::kNearest, std::vector<double>(size_t{4} << 20)}};
    for (size_t i = 0; i < job.images[0].texels.size(); ++i)
        job.images[0].texels[i] = static_cast<double>(i % 65536);
    const JobReport report = pool.run("test", 0, job, 30s);
    ASSERT_EQ(report.outcome, JobOutcome::kDone) << report.text;
    EXPECT_EQ(report.result.readbacks.at(1), job.images[0].texels);
}

TEST(WorkerPool, aCrashIsItsJobsAlone)
{
    WorkerPool pool(testOptions());
    const int first = processOf(pool);
    const JobReport crash = pool.run("test", 0, jobOf("crash"), 10s);
    EXPECT_EQ(crash.outcome, JobOutcome::kCrash);
    EXPECT_EQ(crash.text, "signal 11 (Segmentation fault)");
    EXPECT_EQ(crash.logLines, std::vector<std::string>{"about to touch nothing"});
    EXPECT_TRUE(pool.processIds("test").empty());
    const int second = processOf(pool);
    EXPECT_GT(second, 0);
    EXPECT_NE(second, first);
    EXPECT_EQ(pool.run("test", 0, jobOf("abort"), 10s).text, "signal 6 (Aborted)");
    EXPECT_EQ(pool.run("test", 0, jobOf("exit"), 10s).text, "exit code 7");
    EXPECT_EQ(pool.run("test", 0, jobOf("half"), 10s).text, "exit code 9");
    EXPECT_EQ(pool.run("test", 0, jobOf("fine"), 10s).outcome, JobOutcome::kDone);
}

TEST(WorkerPool, aHangEndsAtTheTimeout)
{
    WorkerPool pool(testOptions());
    const int process = processOf(pool);
    const auto begin = std::chrono::steady_clock::now();
    const JobReport hang = pool.run("test", 0, jobOf("hang"), 200ms);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(hang.outcome, JobOutcome::kTimeout);
    EXPECT_EQ(hang.text, "no answer within 0.2 s");
    EXPECT_EQ(hang.logLines, std::vector<std::string>{"going to sleep"});
    EXPECT_GE(took, 200ms);
    EXPECT_LT(took, 1500ms);
    EXPECT_TRUE(isGone(process));
    EXPECT_EQ(pool.run("test", 0, jobOf("fine"), 10s).outcome, JobOutcome::kDone);
}

TEST(WorkerPool, aHangWhileALargeJobIsOnItsWayEndsToo)
{
    WorkerPool pool(testOptions());
    const int process = processOf(pool);
    ::kill(process, SIGSTOP); // reads nothing any more
    Job job = jobOf("large");
    job.buffers = {{BufferKind::kUniform, std::vector<std::byte>(size_t{8} << 20), 0}};
    EXPECT_EQ(pool.run("test", 0, job, 300ms).outcome, JobOutcome::kTimeout);
    EXPECT_TRUE(isGone(process));
}

TEST(WorkerPool, nonsenseIsACrash)
{
    WorkerPool pool(testOptions());
    const JobReport report = pool.run("test", 0, jobOf("garbage"), 10s);
    EXPECT_EQ(report.outcome, JobOutcome::kCrash);
    EXPECT_EQ(report.text, "the worker's answer is none: malformed frame: mark 3f3f3f3f");
    EXPECT_EQ(pool.run("test", 0, jobOf("fine"), 10s).outcome, JobOutcome::kDone);
}

TEST(WorkerPool, muchChatterNeitherBlocksNorGrows)
{
    WorkerPool pool(testOptions());
    const JobReport report = pool.run("test", 0, jobOf("chatter"), 20s);
    EXPECT_EQ(report.text, "exit code 5");
    ASSERT_EQ(report.logLines.size(), LogRing::kLines);
    EXPECT_EQ(report.logLines.back(), "line 99999 of much chatter");
}

TEST(WorkerPool, errorsOfAJobAreAnswers)
{
    WorkerPool pool(testOptions());
    const int process = processOf(pool);
    const JobReport shader = pool.run("test", 0, jobOf("shader"), 10s);
    EXPECT_EQ(shader.outcome, JobOutcome::kShaderError);
    EXPECT_EQ(shader.text, "a.comp:1:2: error: no such thing");
    EXPECT_EQ(pool.run("test", 0, jobOf("input"), 10s).text, "the job is no job");
    EXPECT_EQ(processOf(pool), process);
    const JobReport lost = pool.run("test", 0, jobOf("lost"), 10s);
    EXPECT_EQ(lost.outcome, JobOutcome::kEnvironmentError);
    EXPECT_EQ(lost.text, "the device is lost");
    EXPECT_NE(processOf(pool), process);
    EXPECT_EQ(pool.run("test", 0, jobOf("fine"), 10s).outcome, JobOutcome::kDone);
}

TEST(WorkerPool, aLackOfMemoryIsAnAnswer)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer ends a process whose memory is used up";
#endif
    WorkerPool pool(testOptions());
    const JobReport starved = pool.run("test", 0, jobOf("no memory"), 10s);
    EXPECT_EQ(starved.outcome, JobOutcome::kEnvironmentError);
    EXPECT_EQ(starved.text, "the worker is out of memory");
    EXPECT_EQ(pool.run("test", 0, jobOf("fine"), 10s).outcome, JobOutcome::kDone);
}

TEST(WorkerPool, devicesThatDoNotOpen)
{
    WorkerPool pool(testOptions());
    for (int turn = 0; turn < 2; ++turn) {
        const JobReport refused = pool.run("refusing", 0, jobOf("x"), 10s);
        EXPECT_EQ(refused.outcome, JobOutcome::kEnvironmentError);
        EXPECT_EQ(refused.text, "there is no such device");
    }
    EXPECT_THROW(pool.fingerprint("refusing"), EnvironmentError);
    const JobReport dead = pool.run("early-death", 0, jobOf("x"), 10s);
    EXPECT_EQ(dead.outcome, JobOutcome::kEnvironmentError); // the backend's doing, not the job's
    EXPECT_EQ(dead.text,
              "early-death is broken: 5 workers in a row ended before a job was begun, the last while opening the "
              "device: exit code 6");
    EXPECT_EQ(dead.logLines, std::vector<std::string>{"this driver cannot even start"});
    try {
        pool.fingerprint("early-death");
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_EQ(error.what(), dead.text + "; its last line: this driver cannot even start");
    }
    WorkerOptions absent;
    absent.executable = "/nonexistent/program";
    const std::string none = WorkerPool(absent).run("test", 0, jobOf("x"), 10s).text;
    EXPECT_TRUE(none.ends_with("while opening the device: exit code 127")) << none;
}

TEST(WorkerPool, deathWhileItOpensHarmsNone)
{
    const TemporaryFolder folder("tries");
    const std::string file = (folder.path() / "tries").string();
    ASSERT_EQ(::setenv("CROSSRAY_TEST_TRIES", file.c_str(), 1), 0);
    WorkerPool pool(testOptions());
    const JobReport report = pool.run("late-riser", 0, jobOf("fine"), 10s);
    ::unsetenv("CROSSRAY_TEST_TRIES");
    EXPECT_EQ(report.outcome, JobOutcome::kDone) << report.text;
    EXPECT_EQ(std::filesystem::file_size(file), 4u);
}

// A driver that hangs while it opens is not asked five times over.
TEST(WorkerPool, aHangWhileItOpensTakesTheTimeOnce)
{
    WorkerOptions options = testOptions();
    options.startTimeout = 300ms;
    WorkerPool pool(options);
    const auto begin = std::chrono::steady_clock::now();
    const JobReport report = pool.run("never-opens", 0, jobOf("x"), 10s);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 1200ms);
    EXPECT_EQ(report.outcome, JobOutcome::kEnvironmentError);
    EXPECT_EQ(report.text, "never-opens is broken: a worker ended before a job was begun, while opening the "
                           "device: no answer within 0.3 s");
}

TEST(WorkerPool, workersArePinnedApartFromTheTerminalAndHaveTheirEnvironment)
{
    WorkerPool pool(testOptions());
    const Fingerprint print = pool.fingerprint("test", 1);
    EXPECT_EQ(print.cpu, "1");
    EXPECT_EQ(print.device, "group " + std::to_string(processOf(pool, "test", 1)));
    EXPECT_EQ(print.driver, "no_aos_sampling");
}

TEST(WorkerPool, killedBetweenJobsHarmsNone)
{
    WorkerPool pool(testOptions());
    const int process = processOf(pool);
    ::kill(process, SIGKILL);
    while (!isGone(process))
        std::this_thread::sleep_for(1ms);
    EXPECT_EQ(pool.run("test", 0, jobOf("fine"), 10s).outcome, JobOutcome::kDone);
}

TEST(WorkerPool, killedBeforeItHasReadTheJobHarmsNone)
{
    WorkerPool pool(testOptions());
    for (const bool isLarge : {false, true}) { // a small job waits in the pipe, a large one is stuck half way
        const int process = processOf(pool);
        ::kill(process, SIGSTOP); // it looks alive, and reads nothing
        std::thread killer([process] {
            std::this_thread::sleep_for(50ms);
            ::kill(process, SIGKILL);
        });
        Job job = jobOf("fine");
        if (isLarge) job.buffers = {{BufferKind::kUniform, std::vector<std::byte>(size_t{8} << 20), 0}};
        const JobReport report = pool.run("test", 0, job, 10s);
        killer.join();
        EXPECT_EQ(report.outcome, JobOutcome::kDone) << report.text;
        EXPECT_NE(processOf(pool), process);
    }
}

TEST(WorkerPool, deathAtEachJobsArrivalIsTheBackends)
{
    WorkerPool pool(testOptions());
    const JobReport report = pool.run("deaf", 0, jobOf("fine"), 10s);
    EXPECT_EQ(report.outcome, JobOutcome::kEnvironmentError);
    EXPECT_EQ(report.text,
              "deaf is broken: 5 workers in a row ended before a job was begun, the last before it had read the "
              "job: exit code 8");
}

TEST(WorkerPool, killedDuringAJobIsThatJobsCrash)
{
    WorkerPool pool(testOptions());
    const int process = processOf(pool);
    const TemporaryFolder folder("killed");
    const std::filesystem::path sign = folder.path() / "runs";
    std::thread killer([&] {
        while (!std::filesystem::exists(sign))
            std::this_thread::sleep_for(1ms);
        ::kill(process, SIGKILL);
    });
    const JobReport report = pool.run("test", 0, jobOf("sign " + sign.string()), 10s);
    killer.join();
    EXPECT_EQ(report.outcome, JobOutcome::kCrash);
    EXPECT_EQ(report.text, "signal 9 (Killed)");
    EXPECT_LT(report.milliseconds, 3000);
    EXPECT_EQ(pool.run("test", 0, jobOf("fine"), 10s).outcome, JobOutcome::kDone);
}

TEST(WorkerPool, programsAreSentOnceAndAgainAfterALoss)
{
    WorkerPool pool(testOptions());
    // More programs than a worker holds: the oldest are asked for again.
    for (int i = 0; i < 1100; ++i) {
        Job job = jobOf("one of many");
        job.programs = {{"e", {}, std::vector<uint32_t>(static_cast<size_t>(i)), "", "key " + std::to_string(i)}};
        ASSERT_EQ(pool.run("test", 0, job, 10s).result.readbacks.at(0).at(0), i);
    }
    for (const int i : {1099, 5, 600}) {
        Job job = jobOf("again");
        job.programs = {{"e", {}, std::vector<uint32_t>(static_cast<size_t>(i)), "", "key " + std::to_string(i)}};
        EXPECT_EQ(pool.run("test", 0, job, 10s).result.readbacks.at(0).at(0), i);
        if (i == 5) pool.run("test", 0, jobOf("crash"), 10s);
    }
}

TEST(WorkerPool, twoHundredRandomKillsLoseNothing)
{
    WorkerPool pool(testOptions());
    std::atomic<bool> done{false};
    std::atomic<int> kills{0};
    std::thread killer([&] {
        std::mt19937 random(11);
        while (!done) {
            for (const int process : pool.processIds("test"))
                kills += ::kill(process, SIGKILL) == 0 ? 1 : 0;
            std::this_thread::sleep_for(std::chrono::microseconds(random() % 4000));
        }
    });
    std::atomic<int> finished{0}, crashed{0}, wrong{0};
    const auto runJobs = [&](int core) {
        // A busy machine may see many kills a job: both numbers are wanted.
        for (int i = 0; kills < 200 || finished + crashed <= 20; ++i) {
            Job job = jobOf("job " + std::to_string(core) + "/" + std::to_string(i));
            job.images = {{1, 1, 1, 1, ImageFilter::kNearest, {static_cast<double>(i)}}};
            const JobReport report = pool.run("test", core, job, 20s);
            if (report.outcome == JobOutcome::kDone) {
                ++finished;
                if (report.result.messages != std::vector<std::string>{job.label} ||
                    report.result.readbacks.at(1).at(0) != i)
                    ++wrong;
            } else {
                ++crashed;
                // Killed at work, or five in a row before they had begun: kills come faster than processes start.
                const bool isGivenUp = report.outcome == JobOutcome::kEnvironmentError &&
                                       report.text.find("5 workers in a row") != std::string::npos;
                const bool isKilled = report.text.find("signal 9 (Killed)") != std::string::npos;
                if (!isKilled || !(isGivenUp || report.outcome == JobOutcome::kCrash)) ++wrong;
            }
        }
    };
    std::thread other([&] { runJobs(1); });
    runJobs(0);
    other.join();
    done = true;
    killer.join();
    EXPECT_GE(kills, 200);
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(finished + crashed, 20);
    EXPECT_EQ(pool.run("test", 0, jobOf("fine"), 10s).outcome, JobOutcome::kDone);
}

TEST(WorkerPool, workersRunAtTheSameTime)
{
    WorkerPool pool(testOptions());
    for (int core = 0; core < 3; ++core)
        pool.fingerprint("test", core);
    const auto begin = std::chrono::steady_clock::now();
    std::vector<std::thread> threads;
    for (int core = 0; core < 3; ++core) {
        threads.emplace_back(
            [&pool, core] { EXPECT_EQ(pool.run("test", core, jobOf("sleep 1000"), 10s).outcome, JobOutcome::kDone); });
    }
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 2500ms); // one after the other: 3 s
    EXPECT_EQ(pool.processIds("test").size(), 3u);
}

TEST(WorkerPool, aWorkerOutlivesTheThreadThatStartedIt)
{
    WorkerPool pool(testOptions());
    int process = 0;
    std::thread([&] { process = processOf(pool); }).join();
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(processOf(pool), process);
}

TEST(WorkerPool, noWorkerOutlivesThePool)
{
    std::vector<int> processes;
    {
        WorkerPool pool(testOptions());
        for (int core = 0; core < 3; ++core)
            processes.push_back(processOf(pool, "test", core));
    }
    for (const int process : processes)
        EXPECT_TRUE(isGone(process));
}

TEST(WorkerPool, noWorkerOutlivesAParentThatIsKilledWhileItHangs)
{
    int pipes[2];
    ASSERT_EQ(::pipe(pipes), 0);
    const int parent = ::fork();
    if (parent == 0) {
        WorkerPool pool(testOptions());
        const int process = processOf(pool);
        if (::write(pipes[1], &process, sizeof(process)) < 0) ::_exit(1);
        pool.run("test", 0, jobOf("hang"), 60s);
        ::_exit(0);
    }
    int process = 0;
    ASSERT_EQ(::read(pipes[0], &process, sizeof(process)), static_cast<ssize_t>(sizeof(process)));
    std::this_thread::sleep_for(100ms);
    EXPECT_FALSE(isGone(process));
    ::kill(parent, SIGKILL);
    ::waitpid(parent, nullptr, 0);
    const auto limit = std::chrono::steady_clock::now() + 10s;
    while (!isGone(process) && std::chrono::steady_clock::now() < limit)
        std::this_thread::sleep_for(20ms);
    EXPECT_TRUE(isGone(process));
    ::close(pipes[0]);
    ::close(pipes[1]);
}

TEST(WorkerPool, peakMemoryCountsTheDeadToo)
{
    WorkerPool pool(testOptions());
    EXPECT_EQ(pool.peakMemory(), 0u);
    processOf(pool);
    const uint64_t small = pool.peakMemory();
    EXPECT_GT(small, uint64_t{1} << 20);
    EXPECT_LT(small, uint64_t{100} << 20);
    EXPECT_EQ(pool.run("test", 0, jobOf("memory"), 10s).outcome, JobOutcome::kDone);
    EXPECT_GT(pool.peakMemory(), uint64_t{190} << 20);
    pool.run("test", 0, jobOf("exit"), 10s);
    EXPECT_GT(pool.peakMemory(), uint64_t{150} << 20);
}

TEST(WorkerPool, anEmptyJobTakesLittleTime)
{
    WorkerPool pool(testOptions());
    processOf(pool);
    double best = 1e9;
    for (int i = 0; i < 200; ++i)
        best = std::min(best, pool.run("test", 0, Job{}, 10s).milliseconds);
    EXPECT_LT(best, 1.0);
    RecordProperty("milliseconds", std::to_string(best));
}

TEST(LogRing, keepsTheLastLinesAndCutsLongOnes)
{
    LogRing ring;
    for (int i = 0; i < 50; ++i)
        ring.add("line " + std::to_string(i) + "\n");
    ring.add("unfinished");
    EXPECT_EQ(ring.lines().size(), LogRing::kLines);
    EXPECT_EQ(ring.lines().front(), "line 11");
    EXPECT_EQ(ring.lines().back(), "unfinished");
    ring.clear();
    ring.add(std::string(5000, 'x') + "\n");
    EXPECT_EQ(ring.lines().at(0).size(), LogRing::kLineBytes);
}

TEST(Backends, areListedWithWhatToInstall)
{
    std::set<std::string> names;
    for (const BackendInfo& info : listBackends()) {
        names.insert(info.name);
        EXPECT_EQ(info.missing.empty(), info.found) << info.name;
    }
    EXPECT_EQ(names, (std::set<std::string>{"lavapipe", "swiftshader", "osmesa", "softpipe", "egl", "cpu32", "cpu64"}));
    EXPECT_THROW(openDevice("gameboy", {}), InputError);
}

TEST(Backends, environmentFitsTheDriver)
{
    WorkerOptions options;
    options.mesaCacheFolder = "/tmp/cache";
    EXPECT_EQ(workerEnvironment("softpipe", options).at("GALLIUM_DRIVER"), "softpipe");
    EXPECT_EQ(workerEnvironment("softpipe", options).at("MESA_GL_VERSION_OVERRIDE"), "4.5");
    EXPECT_EQ(workerEnvironment("osmesa", options).at("GALLIUM_DRIVER"), "llvmpipe");
    EXPECT_EQ(workerEnvironment("osmesa", options).at("MESA_GL_VERSION_OVERRIDE"), "");
    EXPECT_EQ(workerEnvironment("egl", options).at("EGL_PLATFORM"), "surfaceless");
    EXPECT_EQ(workerEnvironment("lavapipe", options).at("MESA_SHADER_CACHE_DIR"), "/tmp/cache");
    EXPECT_EQ(workerEnvironment("lavapipe", {}).at("MESA_SHADER_CACHE_DISABLE"), "true");
}
