// What the live pages ask for, as values: routes' answers without the network. docs/inspector.md documents each.
#pragma once

#include "harness/inspector/latest_queue.h"
#include "harness/inspector/live_render.h"
#include "harness/inspector/piece_store.h"
#include "harness/inspector/question.h"
#include "harness/inspector/routes.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

struct InspectorSetup {
    LiveSetup live;
    std::filesystem::path cases; // the case folder
    std::vector<Case> selected;
    std::string token; // that the page hands back with each request
    std::vector<std::string> commandLine;
};

inline constexpr int64_t kMostPixels = int64_t{2048} * 2048; // of an image whose size a request sets

// Thread-safe.
class Inspector : public InspectorRoutes {
  public:
    explicit Inspector(InspectorSetup setup);

    Reply page() const override;
    Reply data(const std::string& piece) const override;
    Reply controls(const std::string& caseName) const override;
    Reply render(const std::string& body) override;
    Reply trace(const std::string& body) override;
    Reply save(const std::string& body) override;
    Reply progress() const override;
    Reply cancel() override;
    void close() override { queue_.close(); }

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
