// Workers that die as the test of a thousand deaths wants it: each process once, in one of four places, and its own log
// says where.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace crossray {

// The environment variable that holds the folder of the log; workers read it.
inline constexpr const char* kDeathsVariable = "CROSSRAY_TEST_DEATHS";

struct DeathLog {
    int opening = 0;            // while it opened its device
    int arrival = 0;            // a job had arrived, and was not read
    int between = 0;            // an answer was out, and no job in
    std::set<std::string> jobs; // labels of the jobs that were at work
    int count() const { return opening + arrival + between + static_cast<int>(jobs.size()); }
};
DeathLog readDeathLog(const std::filesystem::path& folder);
// How many processes die; the ones after them live. The test writes it before it starts any.
void plantDeaths(const std::filesystem::path& folder, int count);

// main() of such a worker: one that answers on a real device until it dies.
int serveDying(const std::filesystem::path& folder, const std::string& backend, int requestFd, int replyFd);

} // namespace crossray
