// The inspector over HTTP, for the browser on this machine and nobody else: 127.0.0.1 alone, a token that each request
// must bear, and no file of the disk behind any route.
#pragma once

#include "harness/inspector/routes.h"

#include <memory>
#include <string>
#include <string_view>

namespace crossray {

// 128 random bits as 32 digits.
std::string makeToken();
// Whether a text may be one: long enough that nobody guesses it, and of characters that an address may hold.
inline constexpr size_t kShortestToken = 16, kLongestToken = 128;
bool isToken(std::string_view text);
// Takes as long for any wrong token.
bool isSameToken(std::string_view given, std::string_view token);

class InspectorServer {
  public:
    // Listens from here on; port 0: a free one. Throws EnvironmentError when it cannot be had.
    InspectorServer(InspectorRoutes& routes, std::string token, int port);
    ~InspectorServer(); // stops
    InspectorServer(const InspectorServer&) = delete;
    InspectorServer& operator=(const InspectorServer&) = delete;

    int port() const;
    std::string url() const; // with the token
    // Answers on threads of its own until stop().
    void start();
    void stop();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace crossray
