#include "tests/unit/run/dying_worker.h"

#include "harness/run/job_codec.h"
#include "harness/run/worker_frame.h"
#include "harness/run/worker_pool.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <poll.h>
#include <sched.h>
#include <sys/file.h>
#include <unistd.h>

namespace crossray {

namespace {

namespace fs = std::filesystem;

enum class Fate { kOpening, kArrival, kBetween, kAtWork, kLives };

void append(const fs::path& file, const std::string& text)
{
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (descriptor < 0 || ::write(descriptor, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
        std::_Exit(99); // the test finds a cause of death that is none of its own
    ::close(descriptor);
}

[[noreturn]] void die(const fs::path& folder, const std::string& where)
{
    append(folder / "log", where + "\n");
    std::raise(SIGKILL);
    std::_Exit(98);
}

// Processes of a core come one after the other: their number is how many lines the ones before have left.
int countPredecessors(const fs::path& folder)
{
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    ::sched_getaffinity(0, sizeof(cpus), &cpus);
    int core = 0;
    while (core < CPU_SETSIZE && !CPU_ISSET(static_cast<size_t>(core), &cpus))
        ++core;
    const fs::path file = folder / fmt::format("core-{}", core);
    std::error_code failure;
    const auto size = fs::file_size(file, failure);
    append(file, ".");
    return failure ? 0 : static_cast<int>(size);
}

// Whether one of the planted deaths is left for this process. However the cases fall to the cores, all are taken.
bool takeDeath(const fs::path& folder)
{
    int planted = 0;
    std::ifstream(folder / "deaths") >> planted;
    const int taken = ::open((folder / "taken").c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (taken < 0 || ::flock(taken, LOCK_EX) != 0) std::_Exit(99);
    const bool isLeft = ::lseek(taken, 0, SEEK_END) < planted;
    if (isLeft && ::write(taken, ".", 1) != 1) std::_Exit(99);
    ::close(taken);
    return isLeft;
}

Fate chooseFate(const fs::path& folder, int& serial)
{
    serial = countPredecessors(folder);
    // Two in a row that never begin a job, and two that do.
    return takeDeath(folder) ? static_cast<Fate>(serial % 4) : Fate::kLives;
}

} // namespace

DeathLog readDeathLog(const fs::path& folder)
{
    DeathLog log;
    std::ifstream file(folder / "log");
    for (std::string line; std::getline(file, line);) {
        log.opening += line == "opening";
        log.arrival += line == "arrival";
        log.between += line == "between";
        if (line.starts_with("job ")) log.jobs.insert(line.substr(4));
    }
    return log;
}

void plantDeaths(const fs::path& folder, int count)
{
    std::ofstream(folder / "deaths") << count;
}

int serveDying(const fs::path& folder, const std::string& backend, int requestFd, int replyFd)
{
    int serial = 0;
    const Fate fate = chooseFate(folder, serial);
    if (fate == Fate::kOpening) die(folder, "opening");
    const std::unique_ptr<Device> device = openDevice(backend, {});
    writeFrame(replyFd, FrameKind::kGreeting, encodeGreeting({device->fingerprint(), device->precision()}));
    if (fate == Fate::kArrival) {
        pollfd watched{requestFd, POLLIN, 0};
        ::poll(&watched, 1, -1);
        if ((watched.revents & POLLIN) == 0) return 0; // the pool is gone
        die(folder, "arrival");
    }
    std::map<std::string, ProgramSource> programs;
    const auto find = [&](const std::string& key) -> const ProgramSource* {
        const auto found = programs.find(key);
        return found == programs.end() ? nullptr : &found->second;
    };
    const int last = 1 + serial / 4 % 3; // job of its life
    for (int jobs = 1; const std::optional<Frame> frame = readFrame(requestFd); ++jobs) {
        writeFrame(replyFd, FrameKind::kTaken, std::string{});
        const Job job = decodeJob(frame->payload, find).job;
        for (const ProgramSource& program : job.programs)
            programs[program.key] = program;
        if (fate == Fate::kAtWork && jobs == last) die(folder, "job " + job.label);
        writeFrame(replyFd, FrameKind::kResult, encodeResult(device->run(job), device->precision()));
        if (fate == Fate::kBetween && jobs == last) die(folder, "between");
    }
    return 0;
}

} // namespace crossray
