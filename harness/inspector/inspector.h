// What the live pages ask for, as values: routes' answers without the network. docs/inspector.md documents each.
#pragma once

#include "harness/inspector/latest_queue.h"
#include "harness/inspector/live_render.h"
#include "harness/inspector/piece_store.h"
#include "harness/inspector/question.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

struct Reply {
    int status = 200;
    std::string body;
    std::string type = "application/json";
};
// {"error": text}, on one line.
Reply makeErrorReply(int status, std::string_view text);

struct InspectorSetup {
    LiveSetup live;
    std::filesystem::path cases; // the case folder
    std::vector<Case> selected;
    std::string token; // that the page hands back with each request
    std::vector<std::string> commandLine;
};

inline constexpr size_t kMostBodyBytes = 64 << 10;
inline constexpr int64_t kMostPixels = int64_t{2048} * 2048; // of an image whose size a request sets

// Thread-safe. No member throws on account of what a request says.
class Inspector {
  public:
    explicit Inspector(InspectorSetup setup);

    Reply page() const;
    Reply data(const std::string& piece) const;
    Reply controls(const std::string& caseName) const;
    Reply render(const std::string& body);
    Reply trace(const std::string& body);
    Reply save(const std::string& body);
    Reply progress() const;
    Reply cancel();
    // Ends the work in progress and takes no other: whoever waits has an answer.
    void close() { queue_.close(); }

    LiveRenderer& renderer() { return renderer_; }

  private:
    Case findCase(const std::string& name) const; // throws where there is none
    CaseTree readTree(const Question& question) const;
    void checkBackends(const std::vector<std::string>& backends, size_t most) const;

    InspectorSetup setup_;
    mutable std::mutex mutex_; // guards cases_
    std::map<std::string, Case> cases_;
    std::vector<std::string> order_;
    PieceStore pieces_;
    LiveRenderer renderer_;
    LatestQueue queue_; // ends before what it works on
};

} // namespace crossray
