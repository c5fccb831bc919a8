// A worker for the tests of the pool: with the real devices, and with one that misbehaves on demand, told by a job's
// label.
#include "harness/base/error.h"
#include "harness/run/job_codec.h"
#include "harness/run/worker_frame.h"
#include "harness/run/worker_pool.h"
#include "harness/run/worker_server.h"
#include "tests/unit/run/dying_worker.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <poll.h>
#include <sched.h>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace crossray;

namespace {

// Answers with what it was given: a readback of each program's code size, of each image's texels, of each buffer's
// bytes.
JobResult echo(const Job& job)
{
    JobResult result;
    std::vector<double> sizes;
    for (const ProgramSource& program : job.programs)
        sizes.push_back(static_cast<double>(program.spirv.size() + program.glsl.size()));
    result.readbacks.push_back(sizes);
    for (const ImageDesc& image : job.images)
        result.readbacks.push_back(image.texels);
    for (const BufferDesc& buffer : job.buffers) {
        std::vector<double> bytes;
        for (const std::byte byte : buffer.bytes)
            bytes.push_back(static_cast<double>(byte));
        result.readbacks.push_back(bytes);
    }
    result.messages.push_back(job.label);
    return result;
}

class TestDevice : public Device {
  public:
    TestDevice(std::string backend, int replyFd) : backend_(std::move(backend)), replyFd_(replyFd) {}

    Fingerprint fingerprint() const override
    {
        cpu_set_t cpus;
        CPU_ZERO(&cpus);
        ::sched_getaffinity(0, sizeof(cpus), &cpus);
        const char* driver = std::getenv("GALLIVM_PERF");
        return {backend_,
                "test",
                "group " + std::to_string(::getpgrp()),
                driver != nullptr ? driver : "",
                "",
                std::to_string(CPU_COUNT(&cpus))};
    }
    Precision precision() const override { return backend_ == "test64" ? Precision::kDouble : Precision::kFloat; }

    JobResult run(const Job& job) override
    {
        const std::string& what = job.label;
        if (what == "crash") {
            std::fprintf(stderr, "about to touch nothing\n");
            const rlimit none{0, 0}; // no core file
            ::setrlimit(RLIMIT_CORE, &none);
            std::signal(SIGSEGV, SIG_DFL); // whatever a sanitizer has put there
            std::raise(SIGSEGV);
        }
        if (what == "abort") std::abort();
        if (what == "exit") std::_Exit(7);
        if (what == "hang") {
            std::fprintf(stderr, "going to sleep\n");
            while (true)
                std::this_thread::sleep_for(std::chrono::seconds(1));
        }
        if (what == "garbage") {
            const std::string noise(100, '?');
            if (::write(replyFd_, noise.data(), noise.size()) < 0) std::_Exit(8);
            while (true)
                std::this_thread::sleep_for(std::chrono::seconds(1));
        }
        if (what == "half") {
            const char start[] = {'C', 'R', 'F', '1', 4, 0};
            if (::write(replyFd_, start, sizeof(start)) < 0) std::_Exit(8);
            std::_Exit(9);
        }
        if (what == "chatter") {
            for (int i = 0; i < 100000; ++i)
                std::fprintf(i % 2 == 0 ? stderr : stdout, "line %d of much chatter\n", i);
            std::fflush(stdout);
            std::_Exit(5);
        }
        if (what == "shader") throw ShaderError("a.comp:1:2: error: no such thing");
        if (what == "lost") throw EnvironmentError("the device is lost");
        if (what == "input") throw InputError("the job is no job");
        if (what == "no memory") {
            const rlimit little{size_t{1} << 28, size_t{1} << 40}; // of addresses: a quarter of what is asked for
            ::setrlimit(RLIMIT_AS, &little);
            std::vector<char> much(size_t{1} << 30, 1);
            return echo(job);
        }
        if (what == "memory") {
            std::vector<char> much(200 << 20, 1);
            JobResult result;
            result.readbacks.push_back({static_cast<double>(much[much.size() / 2])});
            return result;
        }
        if (what == "pid") {
            JobResult result;
            result.readbacks.push_back({static_cast<double>(::getpid())});
            return result;
        }
        if (what.starts_with("sign ")) { // makes a file, to say that it runs, and then takes its time
            std::ofstream(what.substr(5)).close();
            std::this_thread::sleep_for(std::chrono::seconds(5));
        }
        if (what.starts_with("sleep "))
            std::this_thread::sleep_for(std::chrono::milliseconds(std::atoi(what.c_str() + 6)));
        return echo(job);
    }

  private:
    std::string backend_;
    int replyFd_;
};

} // namespace

int main(int argc, char** argv)
{
    std::map<std::string, std::string> options;
    if (argc < 2 || std::strcmp(argv[1], "worker") != 0) return 2;
    bool validation = false;
    for (int i = 2; i < argc; ++i) {
        if (std::strcmp(argv[i], "--validation") == 0) {
            validation = true;
        } else if (i + 1 < argc) {
            options[argv[i]] = argv[i + 1];
            ++i;
        }
    }
    const std::string backend = options["--backend"];
    const int replyFd = std::atoi(options["--reply-fd"].c_str());
    if (backend == "early-death") {
        std::fprintf(stderr, "this driver cannot even start\n");
        return 6;
    }
    if (backend == "never-opens") {
        while (true)
            ::pause();
    }
    if (backend == "deaf") { // ends when a job arrives, before it has read it
        const TestDevice device(backend, replyFd);
        writeFrame(replyFd, FrameKind::kGreeting, encodeGreeting({device.fingerprint(), device.precision()}));
        pollfd watched{std::atoi(options["--request-fd"].c_str()), POLLIN, 0};
        ::poll(&watched, 1, -1);
        return 8;
    }
    if (const char* deaths = std::getenv(kDeathsVariable))
        return serveDying(deaths, backend, std::atoi(options["--request-fd"].c_str()), replyFd);
    if (backend == "late-riser") { // the fourth process opens: the ones before it die
        const char* file = std::getenv("CROSSRAY_TEST_TRIES");
        if (file == nullptr) return 2;
        std::ofstream(file, std::ios::app) << '.';
        if (std::filesystem::file_size(file) < 4) return 6;
    }
    if (!backend.starts_with("test") && backend != "late-riser" && backend != "refusing") {
        return runWorker(backend, std::atoi(options["--request-fd"].c_str()), replyFd, validation);
    }
    return serveJobs(std::atoi(options["--request-fd"].c_str()), replyFd, [&]() -> std::unique_ptr<Device> {
        if (backend == "refusing") throw EnvironmentError("there is no such device");
        return std::make_unique<TestDevice>(backend, replyFd);
    });
}
