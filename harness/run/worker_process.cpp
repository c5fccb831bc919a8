#include "harness/run/worker_process.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <sched.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char** environ;

namespace crossray {

using Clock = std::chrono::steady_clock;

namespace {

constexpr int kRequestFd = 3; // in the worker
constexpr int kReplyFd = 4;
constexpr int kFirstFreeFd = 10; // above what the child's own descriptors get
constexpr int kPipeBytes = 1 << 20;

struct Pipe {
    UniqueFd readEnd, writeEnd;
};

Pipe makePipe()
{
    int fds[2];
    if (::pipe2(fds, O_CLOEXEC) != 0)
        throw EnvironmentError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    ::fcntl(fds[1], F_SETPIPE_SZ, kPipeBytes); // fewer switches for big images; a refusal costs only time
    return {UniqueFd(fds[0]), UniqueFd(fds[1])};
}

void makeNonBlocking(int fd)
{
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
}

// What the child needs, made before fork(): after it only calls that are safe in a copy of a threaded process may run.
struct ChildPlan {
    std::vector<std::string> arguments, environment;
    std::vector<char*> argv, envp;
    cpu_set_t cpus{};
    bool pinned = false;
};

ChildPlan planChild(const WorkerCommand& command)
{
    ChildPlan plan;
    plan.arguments.push_back(command.executable.string());
    plan.arguments.insert(plan.arguments.end(), command.arguments.begin(), command.arguments.end());
    for (const std::string& argument : {std::string("--request-fd"), std::to_string(kRequestFd),
                                        std::string("--reply-fd"), std::to_string(kReplyFd)}) {
        plan.arguments.push_back(argument);
    }
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text(*entry);
        if (command.environment.count(std::string(text.substr(0, text.find('=')))) == 0)
            plan.environment.emplace_back(text);
    }
    for (const auto& [name, value] : command.environment) {
        if (!value.empty()) plan.environment.push_back(fmt::format("{}={}", name, value));
    }
    for (std::string& argument : plan.arguments)
        plan.argv.push_back(argument.data());
    for (std::string& entry : plan.environment)
        plan.envp.push_back(entry.data());
    plan.argv.push_back(nullptr);
    plan.envp.push_back(nullptr);
    CPU_ZERO(&plan.cpus);
    if (command.cpu >= 0) {
        CPU_SET(static_cast<size_t>(command.cpu), &plan.cpus);
        plan.pinned = true;
    }
    return plan;
}

// In the child. Never returns.
[[noreturn]] void becomeWorker(const ChildPlan& plan, int request, int reply, int log)
{
    ::setsid(); // a terminal's Ctrl-C goes to the parent alone
    if (plan.pinned) ::sched_setaffinity(0, sizeof(plan.cpus), &plan.cpus); // an unpinned worker is slower, not wrong
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    // Out of the way first: one of them may be what another is to become.
    request = ::fcntl(request, F_DUPFD_CLOEXEC, kFirstFreeFd);
    reply = ::fcntl(reply, F_DUPFD_CLOEXEC, kFirstFreeFd);
    log = ::fcntl(log, F_DUPFD_CLOEXEC, kFirstFreeFd);
    const int null = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (null > 0) ::dup2(null, STDIN_FILENO);
    ::dup2(log, STDOUT_FILENO);
    ::dup2(log, STDERR_FILENO);
    ::dup2(request, kRequestFd);
    ::dup2(reply, kReplyFd);
    ::execve(plan.argv[0], plan.argv.data(), plan.envp.data());
    constexpr std::string_view kMessage = "the worker's program cannot be executed\n";
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
    ::_exit(127);
}

} // namespace

UniqueFd& UniqueFd::operator=(UniqueFd&& other) noexcept
{
    if (this != &other) {
        reset();
        fd_ = other.release();
    }
    return *this;
}

int UniqueFd::release()
{
    return std::exchange(fd_, -1);
}

void UniqueFd::reset()
{
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
}

void LogRing::add(std::string_view text)
{
    for (const char c : text) {
        if (c != '\n') {
            if (partial_.size() < kLineBytes) partial_ += c;
            continue;
        }
        lines_.push_back(std::move(partial_));
        partial_.clear();
        if (lines_.size() > kLines) lines_.pop_front();
    }
}

void LogRing::clear()
{
    lines_.clear();
    partial_.clear();
}

std::vector<std::string> LogRing::lines() const
{
    std::vector<std::string> result(lines_.begin(), lines_.end());
    if (!partial_.empty()) result.push_back(partial_);
    if (result.size() > kLines) result.erase(result.begin());
    return result;
}

std::string describeStatus(int status)
{
    if (WIFSIGNALED(status)) {
        const char* name = ::sigdescr_np(WTERMSIG(status));
        return fmt::format("signal {} ({})", WTERMSIG(status), name != nullptr ? name : "unknown");
    }
    return fmt::format("exit code {}", WEXITSTATUS(status));
}

WorkerProcess::WorkerProcess(const WorkerCommand& command)
{
    Pipe request = makePipe(), reply = makePipe(), log = makePipe();
    const ChildPlan plan = planChild(command);
    pid_ = ::fork();
    if (pid_ < 0) throw EnvironmentError(fmt::format("cannot start a worker process: {}", std::strerror(errno)));
    if (pid_ == 0) becomeWorker(plan, request.readEnd.get(), reply.writeEnd.get(), log.writeEnd.get());
    request_ = std::move(request.writeEnd);
    reply_ = std::move(reply.readEnd);
    logPipe_ = std::move(log.readEnd);
    for (const int fd : {request_.get(), reply_.get(), logPipe_.get()})
        makeNonBlocking(fd);
}

WorkerProcess::~WorkerProcess()
{
    dismiss();
    kill(std::chrono::milliseconds(1000));
}

void WorkerProcess::closePipes()
{
    drainLog();
    request_.reset();
    reply_.reset();
}

// True when the process is dead, and reaped.
bool WorkerProcess::waitUntil(Deadline deadline)
{
    auto pause = std::chrono::microseconds(50);
    while (!reaped_) {
        const pid_t got = ::waitpid(pid_, &status_, WNOHANG);
        if (got == pid_ || (got < 0 && errno != EINTR)) {
            reaped_ = true;
            break;
        }
        if (Clock::now() >= deadline) return false;
        drainLog(); // a full pipe would keep it alive
        std::this_thread::sleep_for(pause);
        pause = std::min(pause * 2, std::chrono::microseconds(5000));
    }
    return true;
}

std::string WorkerProcess::kill(std::chrono::milliseconds grace)
{
    memory();
    if (!waitUntil(Clock::now() + grace)) {
        ::kill(pid_, SIGKILL);
        waitUntil(Deadline::max());
    }
    closePipes();
    return describeStatus(status_);
}

bool WorkerProcess::isAlive()
{
    return !waitUntil(Clock::now());
}

LogRing& WorkerProcess::log()
{
    drainLog();
    return log_;
}

void WorkerProcess::drainLog()
{
    char buffer[4096];
    for (int turns = 0; turns < 256 && logPipe_.get() >= 0; ++turns) {
        const ssize_t count = ::read(logPipe_.get(), buffer, sizeof(buffer));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        log_.add({buffer, static_cast<size_t>(count)});
    }
}

// From /proc: getrusage of a child would count what this process held when it forked.
MemoryUse WorkerProcess::memory()
{
    const std::lock_guard lock(memoryMutex_);
    if (reaped_) return memory_;
    std::ifstream status(fmt::format("/proc/{}/status", pid_));
    std::string line;
    while (std::getline(status, line)) {
        const auto readKilobytes = [&line](std::string_view name, uint64_t& bytes) {
            if (line.starts_with(name)) bytes = std::strtoull(line.c_str() + name.size(), nullptr, 10) * 1024;
        };
        readKilobytes("VmHWM:", memory_.peak);
        readKilobytes("RssFile:", memory_.shared);
    }
    return memory_;
}

} // namespace crossray
