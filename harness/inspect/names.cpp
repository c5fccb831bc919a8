#include "harness/inspect/names.h"

#include <fmt/format.h>

#include <span>
#include <string_view>

namespace crossray {

namespace {

std::string nameIn(std::span<const std::string_view> names, int number)
{
    const bool isKnown = number >= 0 && number < static_cast<int>(names.size());
    return isKnown ? std::string(names[static_cast<size_t>(number)]) : fmt::format("number {}", number);
}

} // namespace

std::string nameOfReason(int reason)
{
    static constexpr std::string_view kNames[] = {
        "none",
        "iteration cap",
        "left the image",
        "hidden behind a surface",
        "passed the near plane",
        "hit is not in front of the camera",
        "does not meet the proxy",
        "left the scene",
        "total internal reflection",
        "ray without origin or direction",
        "parameter without meaning",
    };
    return nameIn(kNames, reason);
}

std::string nameOfTracingModel(int model)
{
    static constexpr std::string_view kNames[] = {
        "none", "proxy, infinite", "proxy, box", "proxy, sphere", "HiZ", "linear", "patches", "proxy of a probe", "own",
    };
    return nameIn(kNames, model);
}

std::string nameOfIntersection(int kind)
{
    static constexpr std::string_view kNames[] = {"none", "cell", "depth"};
    return nameIn(kNames, kind);
}

} // namespace crossray
