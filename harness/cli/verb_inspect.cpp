#include "harness/cli/browser.h"
#include "harness/cli/verbs.h"
#include "harness/inspector/inspector.h"
#include "harness/inspector/server.h"
#include "harness/run/environment.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>

namespace crossray {

namespace {

// SIGINT and SIGTERM wait for who asks for them: in every thread that is started from here on.
class HeldSignals {
  public:
    HeldSignals()
    {
        sigemptyset(&held_);
        sigaddset(&held_, SIGINT);
        sigaddset(&held_, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &held_, &before_);
    }
    ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

    void wait() const
    {
        int signal = 0;
        while (sigwait(&held_, &signal) != 0) {
        }
    }

  private:
    sigset_t held_{}, before_{};
};

std::vector<std::string> findBackends()
{
    std::vector<std::string> names;
    for (const BackendInfo& info : listBackends()) {
        if (info.found) names.push_back(info.name);
    }
    return names;
}

// One that outlives the server lets an open page go on when it is started again on the same port.
std::string chooseToken()
{
    const char* const given = std::getenv("CROSSRAY_INSPECT_TOKEN");
    if (given == nullptr || *given == '\0') return makeToken();
    if (!isToken(given)) {
        throw InputError(fmt::format("CROSSRAY_INSPECT_TOKEN: {} to {} of a-z, A-Z, 0-9, _ and - are allowed",
                                     kShortestToken, kLongestToken));
    }
    return given;
}

} // namespace

int inspectCases(const GlobalOptions& global, const InspectVerbOptions& options)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    SelectedCases selected =
        selectCases(options.selection, folders.cases, "out/last", options.selection.arguments.empty());
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    InspectorSetup setup;
    setup.live = {folders.shaders, folders.cache, {}, findBackends()};
    setup.cases = folders.cases;
    setup.selected = std::move(selected.cases);
    setup.token = chooseToken();
    setup.commandLine = global.commandLine;
    const size_t count = setup.selected.size();

    const HeldSignals signals;
    const std::string token = setup.token;
    Inspector inspector(std::move(setup));
    InspectorServer server(inspector, token, options.port);
    server.start();
    fmt::print("{} case{}; Ctrl-C ends it\n{}\n", count, count == 1 ? "" : "s", server.url());
    std::fflush(stdout);
    if (options.open) openInBrowser(server.url());
    signals.wait();
    server.stop();
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
