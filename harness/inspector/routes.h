// What the server asks for, route by route; it knows no more of the inspector.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace crossray {

struct Reply {
    int status = 200;
    std::string body;
    std::string type = "application/json";
};
// {"error": text}, on one line.
Reply makeErrorReply(int status, std::string_view text);

inline constexpr size_t kMostBodyBytes = 64 << 10;

// Called from several threads at once. No member throws on account of what a request says.
class InspectorRoutes {
  public:
    virtual ~InspectorRoutes() = default;

    virtual Reply page() const = 0;
    virtual Reply data(const std::string& piece) const = 0;
    virtual Reply controls(const std::string& caseName) const = 0;
    virtual Reply render(const std::string& body) = 0;
    virtual Reply trace(const std::string& body) = 0;
    virtual Reply save(const std::string& body) = 0;
    virtual Reply progress() const = 0;
    virtual Reply cancel() = 0;
    // Ends the work in progress and takes no other: whoever waits has an answer.
    virtual void close() = 0;
};

} // namespace crossray
