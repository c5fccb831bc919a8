// The inspector's server, as whatever connects may speak to it. Nobody without the token or with a foreign Host is
// answered, and the server still answers the next one.
#include "tests/fuzz/targets/target.h"

#include "harness/inspector/server.h"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

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

// 127.0.0.0/8 is this host's, whole.
sockaddr_in loopback(uint32_t host, uint16_t port)
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl((127u << 24) + host);
    return address;
}

// Who ends its side first keeps its port for a minute, and one address has 28,000 of them: where the kernel gives none
// of these out again (net.ipv4.tcp_tw_reuse), a minute's questions come from many addresses.
sockaddr_in nextLoopback()
{
    constexpr uint32_t kFirst = 2, kAddresses = 64;
    static uint32_t count = 0;
    return loopback(kFirst + count++ % kAddresses, 0);
}

// Says it, ends its side, and hears the answer out. libFuzzer's clock interrupts calls.
std::string ask(int port, const std::string& text)
{
    const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    fuzz::expect(client >= 0, "there is a socket");
    const sockaddr_in from = nextLoopback();
    const int late =
        1; // the port is chosen as it connects, so that it needs to be free for this pair of addresses alone
    ::setsockopt(client, IPPROTO_IP, IP_BIND_ADDRESS_NO_PORT, &late, sizeof(late));
    const bool isBound = ::bind(client, reinterpret_cast<const sockaddr*>(&from), sizeof(from)) == 0;
    fuzz::expect(isBound, "there is an address to ask from");
    const sockaddr_in to = loopback(1, static_cast<uint16_t>(port));
    const bool isConnected =
        TEMP_FAILURE_RETRY(::connect(client, reinterpret_cast<const sockaddr*>(&to), sizeof(to))) == 0;
    if (!isConnected) std::perror("connect");
    fuzz::expect(isConnected, "the server takes connections");
    for (size_t sent = 0; sent < text.size();) {
        const ssize_t count = TEMP_FAILURE_RETRY(::send(client, text.data() + sent, text.size() - sent, MSG_NOSIGNAL));
        if (count <= 0) break; // it has heard enough
        sent += static_cast<size_t>(count);
    }
    ::shutdown(client, SHUT_WR);
    std::string answer;
    char buffer[4096];
    for (ssize_t count; (count = TEMP_FAILURE_RETRY(::recv(client, buffer, sizeof(buffer), 0))) > 0;)
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
