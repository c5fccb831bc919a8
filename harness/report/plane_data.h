// Planes as JSON for a page: 32-bit floats, channel after channel, their bytes sorted by significance, deflated, in
// base64.
#pragma once

#include "harness/base/plane.h"
#include "harness/scene/cubemap.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace crossray {

inline constexpr int kPlaneLevel = 5;

// Remembers which planes of a case have been written, so that an answer with the same bits as another's is a reference.
class PlaneEncoder {
  public:
    // `level`: zlib's, from 1, quick, to 9, small.
    explicit PlaneEncoder(int level = kPlaneLevel) : level_(level) {}
    // {"width":..,"height":..,"planes":[{"name":..,"channels":..,"data":BASE64 or "same":SOURCE}]}
    std::string encode(const std::string& source, std::span<const Plane> planes);
    // Takes the last encode() back: what it made is not part of the report.
    void forget(const std::string& source);

  private:
    struct Written {
        std::string source;
        std::string bytes;
    };
    int level_;
    std::map<std::string, std::vector<Written>> written_; // by the plane's name
};

// {"size":..,"levels":[BASE64]}: each level as a plane of the six faces below one another.
std::string encodeCubemap(const Cubemap& cubemap);

// The deflated bytes of one plane.
std::string packPlane(const Plane& plane);

} // namespace crossray
