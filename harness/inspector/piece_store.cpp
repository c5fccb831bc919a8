#include "harness/inspector/piece_store.h"

#include "harness/report/plane_data.h"

#include <fmt/format.h>

namespace crossray {

PieceStore::Names PieceStore::keep(std::string details, std::map<std::string, std::vector<Plane>> planes)
{
    const std::lock_guard lock(mutex_);
    const uint64_t serial = ++count_;
    Names names;
    Render render;
    names.details = fmt::format("case-{}", serial);
    render.pieces[names.details] = std::make_shared<const Piece>(Piece{std::move(details), {}});
    size_t number = 0;
    for (auto& [source, list] : planes) {
        for (const Plane& plane : list)
            render.bytes += plane.values.size() * sizeof(double);
        const std::string name = fmt::format("planes-{}-{}", serial, number++);
        names.planes[source] = name;
        render.pieces[name] = std::make_shared<const Piece>(Piece{"", std::move(list)});
    }
    renders_.push_back(std::move(render));
    size_t bytes = 0;
    for (const Render& each : renders_)
        bytes += each.bytes;
    while (renders_.size() > kMost || (renders_.size() > kFewest && bytes > kMostBytes)) {
        bytes -= renders_.front().bytes;
        renders_.pop_front();
    }
    return names;
}

std::optional<PieceStore::Data> PieceStore::find(const std::string& name) const
{
    std::shared_ptr<const Piece> piece;
    {
        const std::lock_guard lock(mutex_);
        for (const Render& render : renders_) {
            const auto found = render.pieces.find(name);
            if (found != render.pieces.end()) piece = found->second;
        }
    }
    if (!piece) return std::nullopt;
    if (!piece->json.empty()) return Data{piece->json, true};
    // The wire is this machine's memory: packing would take longer than the bytes that it saves.
    return Data{formatPlaneBytes(piece->planes), false};
}

} // namespace crossray
