// The data that pages may still ask for: planes and details of the last renders, by name.
#pragma once

#include "harness/base/plane.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace crossray {

// Thread-safe. A render's pieces go when others are newer and the room is needed.
class PieceStore {
  public:
    static constexpr size_t kFewest = 4, kMost = 24;        // renders
    static constexpr size_t kMostBytes = size_t{512} << 20; // of planes, beyond the fewest

    struct Names {
        std::string details;
        std::map<std::string, std::string> planes; // by source
    };
    // `details` is JSON.
    Names keep(std::string details, std::map<std::string, std::vector<Plane>> planes);
    struct Data {
        std::string bytes;
        bool isJson = true; // else planes as of formatPlaneBytes()
    };
    // Made when it is asked for; nothing when there is none of that name.
    std::optional<Data> find(const std::string& name) const;

  private:
    struct Piece {
        std::string json;          // of details
        std::vector<Plane> planes; // where that is empty
    };
    struct Render {
        std::map<std::string, std::shared_ptr<const Piece>> pieces; // shared with those who pack one right now
        size_t bytes = 0;
    };

    mutable std::mutex mutex_;
    std::deque<Render> renders_; // the newest last
    uint64_t count_ = 0;
};

} // namespace crossray
