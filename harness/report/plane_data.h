// Planes for a page. Of a report, as JSON: 32-bit floats, channel after channel, their bytes sorted by significance,
// deflated, in base64. Of a server, as bytes: the floats as they are.
#pragma once

#include "harness/base/plane.h"
#include "harness/scene/cubemap.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

// Remembers which planes of a case have been written, so that an answer with the same bits as another's is a reference.
class PlaneEncoder {
  public:
    // {"width":..,"height":..,"planes":[{"name":..,"channels":..,"data":BASE64 or "same":SOURCE}]}
    std::string encode(const std::string& source, std::span<const Plane> planes);
    // Takes the last encode() back: what it made is not part of the report.
    void forget(const std::string& source);

  private:
    struct Written {
        std::string source;
        std::string bytes;
    };
    std::map<std::string, std::vector<Written>> written_; // by the plane's name
};

// A head and the floats: uint32, the size of the head in bytes, a multiple of 4; the head, JSON that blanks may follow,
// {"width":..,"height":..,"planes":[{"name":..,"channels":..}]}; of each plane its 32-bit floats, channel after
// channel. All little-endian.
std::string formatPlaneBytes(std::span<const Plane> planes);

// {"size":..,"levels":[BASE64]}: each level as a plane of the six faces below one another.
std::string encodeCubemap(const Cubemap& cubemap);

// The deflated bytes of one plane.
std::string packPlane(const Plane& plane);

// By zlib.
std::string deflateBytes(std::string_view bytes);

} // namespace crossray
