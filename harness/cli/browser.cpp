#include "harness/cli/browser.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <csignal>
#include <spawn.h>
#include <unistd.h>

namespace crossray {

// xdg-open leaves the browser behind and ends.
void openInBrowser(const std::string& place)
{
    std::string program = "xdg-open", argument = place;
    char* const arguments[] = {program.data(), argument.data(), nullptr};
    // The caller may keep its signals back, and the browser shall hear them.
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setsigmask(&attributes, &none);
    pid_t process = 0;
    const int failure = posix_spawnp(&process, program.c_str(), nullptr, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    if (failure != 0) throw EnvironmentError(fmt::format("--open: there is no xdg-open; open {} yourself", place));
}

} // namespace crossray
