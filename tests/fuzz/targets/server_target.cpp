// The inspector's server, as whatever connects may speak to it. Nobody without the token or with a foreign Host is
// answered, and the server still answers the next one.
#include "tests/fuzz/targets/target.h"

#include "harness/inspector/server.h"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>

using namespace crossray;

namespace {

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";
constexpr std::string_view kPort = "PORT", kSecret = "TOKEN"; // in an input they stand for this run's

// Answers without cases and workers: what arrives here has passed the server.
class Routes : public InspectorRoutes {
  public:
    Reply page() const override { return {200, "page", "text/html; charset=utf-8"}; }
    Reply data(const std::string& piece) const override { return {200, fmt::format("{{\"piece\":{}}}", piece.size())}; }
    Reply controls(const std::string&) const override { return {200, "{}"}; }
    Reply render(const std::string& body) override { return checked(body); }
    Reply trace(const std::string& body) override { return checked(body); }
    Reply save(const std::string& body) override { return checked(body); }
    Reply progress() const override { return {200, "{}"}; }
    Reply cancel() override { return {200, "{}"}; }
    void close() override {}

  private:
    static Reply checked(const std::string& body)
    {
        fuzz::expect(body.size() <= kMostBodyBytes, "a body is within the bounds");
        return {200, "{}"};
    }
};

struct Host {
    Host() { server.start(); }
    Routes routes;
    InspectorServer server{routes, kToken, 0};
};

void replaceAll(std::string& text, std::string_view word, const std::string& by)
{
    for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size())
        text.replace(at, word.size(), by);
}

// Says it, ends its side, and hears the answer out.
std::string ask(int port, const std::string& text)
{
    const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    fuzz::expect(client >= 0, "there is a socket");
    // Closed at once and for good: a hundred thousand connections would use up the ports.
    const linger none{1, 0};
    ::setsockopt(client, SOL_SOCKET, SO_LINGER, &none, sizeof(none));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    fuzz::expect(::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0,
                 "the server takes connections");
    for (size_t sent = 0; sent < text.size();) {
        const ssize_t count = ::send(client, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
        if (count <= 0) break; // it has heard enough
        sent += static_cast<size_t>(count);
    }
    ::shutdown(client, SHUT_WR);
    std::string answer;
    char buffer[4096];
    for (ssize_t count; (count = ::recv(client, buffer, sizeof(buffer), 0)) > 0;)
        answer.append(buffer, static_cast<size_t>(count));
    ::close(client);
    return answer;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    static Host& host = *new Host; // its threads run to the end of the process
    const int port = host.server.port();
    std::string text(fuzz::textOf(data, size));
    replaceAll(text, kPort, std::to_string(port));
    replaceAll(text, kSecret, kToken);
    const std::string answer = ask(port, text);
    fuzz::expect(answer.empty() || answer.starts_with("HTTP/1."), "an answer is HTTP");
    fuzz::expect(answer.find(kToken) == std::string::npos, "no answer tells the token");
    if (answer.starts_with("HTTP/1.1 200")) {
        const bool namesUs = text.find(fmt::format("127.0.0.1:{}", port)) != std::string::npos ||
                             text.find(fmt::format("localhost:{}", port)) != std::string::npos;
        fuzz::expect(namesUs, "who is answered has named this host");
        // A query may bear it as %30%31...: then its characters stand there by code.
        fuzz::expect(text.find(kToken) != std::string::npos || text.find('%') != std::string::npos,
                     "who is answered has the token");
    }
    return 0;
}
