#include "harness/inspector/server.h"

#include "harness/base/error.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <sys/random.h>
#include <sys/socket.h>
#include <thread>

namespace crossray {

namespace {

constexpr const char* kAddress = "127.0.0.1";
constexpr size_t kThreads = 32;            // clients that may wait, or hang, at once
constexpr time_t kReadSeconds = 5;         // without a byte, then a connection is given up
constexpr time_t kWriteSeconds = 10;       //
constexpr size_t kMostReadBytes = 8 << 20; // of a body that is too large, before its answer

// The page is one file whose scripts and styles are in it; it talks with this server alone, and stands in no frame.
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; img-src data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// By a provider of a known length, which alone goes out as it is: what is set as content, httplib packs by Brotli at
// its slowest, most of a second for the planes of a 256 x 256 rendering, to save a copy within this machine. A refusal
// is short, and set: it goes out even when the server is about to end, as a provider's does not.
void fill(httplib::Response& response, Reply reply)
{
    response.status = reply.status;
    if (reply.status != 200) return response.set_content(reply.body, reply.type);
    const auto body = std::make_shared<const std::string>(std::move(reply.body));
    response.set_content_provider(body->size(), reply.type,
                                  [body](size_t offset, size_t length, httplib::DataSink& sink) {
                                      return sink.write(body->data() + offset, length);
                                  });
}

// Nothing when it is too large, or ends early.
std::optional<std::string> readBody(const httplib::ContentReader& reader, bool& isTooLarge)
{
    std::string body;
    size_t total = 0;
    const bool isWhole = reader([&](const char* data, size_t size) {
        total += size;
        if (total <= kMostBodyBytes) body.append(data, size);
        return total <= kMostReadBytes;
    });
    isTooLarge = total > kMostBodyBytes;
    if (isTooLarge || !isWhole) return std::nullopt;
    return body;
}

} // namespace

std::string makeToken()
{
    std::array<unsigned char, 16> bytes{};
    size_t have = 0;
    while (have < bytes.size()) {
        const ssize_t got = ::getrandom(bytes.data() + have, bytes.size() - have, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) throw EnvironmentError("the system has no random numbers for a token");
        have += static_cast<size_t>(got);
    }
    std::string token;
    for (const unsigned char byte : bytes)
        token += fmt::format("{:02x}", byte);
    return token;
}

bool isToken(std::string_view text)
{
    return text.size() >= kShortestToken && text.size() <= kLongestToken &&
           std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                      c == '-';
           });
}

bool isSameToken(std::string_view given, std::string_view token)
{
    unsigned difference = given.size() == token.size() ? 0u : 1u;
    for (size_t i = 0; i < token.size(); ++i) {
        const char other = given.empty() ? '\0' : given[i % given.size()];
        difference |= static_cast<unsigned>(static_cast<unsigned char>(other) ^ static_cast<unsigned char>(token[i]));
    }
    return difference == 0;
}

struct InspectorServer::Impl {
    Impl(InspectorRoutes& served, std::string secret) : routes(served), token(std::move(secret)) {}

    // Before anything else is looked at, the body included.
    std::optional<Reply> refuse(const httplib::Request& request) const
    {
        const auto isOurs = [&](const std::string& host) {
            return host == fmt::format("{}:{}", kAddress, port) || host == fmt::format("localhost:{}", port);
        };
        if (request.get_header_value_count("Host") != 1 || !isOurs(request.get_header_value("Host")))
            return makeErrorReply(403, fmt::format("the Host is not {}:{}", kAddress, port));
        if (request.has_header("Origin")) {
            const std::string origin = request.get_header_value("Origin");
            if (!origin.starts_with("http://") || !isOurs(origin.substr(7)))
                return makeErrorReply(403, "the request comes from another page");
        }
        const std::string given = request.has_header("X-Crossray-Token") ? request.get_header_value("X-Crossray-Token")
                                                                         : request.get_param_value("token");
        if (!isSameToken(given, token))
            return makeErrorReply(403,
                                  "the token is missing or wrong; open the address that `crossray inspect` printed");
        if (request.has_header("Content-Encoding") || request.is_multipart_form_data())
            return makeErrorReply(400, "a body is JSON as it stands");
        return std::nullopt;
    }

    template <typename Answer>
    void post(const char* route, Answer answer)
    {
        server.Post(route, [answer](const httplib::Request&, httplib::Response& response,
                                    const httplib::ContentReader& reader) {
            bool isTooLarge = false;
            const std::optional<std::string> body = readBody(reader, isTooLarge);
            if (body) return fill(response, answer(*body));
            fill(response, isTooLarge
                               ? makeErrorReply(413, fmt::format("the body is larger than {} bytes", kMostBodyBytes))
                               : makeErrorReply(400, "the body ends early"));
        });
    }

    void addRoutes()
    {
        const auto get = [this](const char* route, auto answer) {
            server.Get(route, [answer](const httplib::Request& request, httplib::Response& response) {
                fill(response, answer(request));
            });
        };
        get("/", [this](const httplib::Request&) { return routes.page(); });
        get("/data/([a-z0-9-]{1,60})",
            [this](const httplib::Request& request) { return routes.data(request.matches[1]); });
        get("/controls",
            [this](const httplib::Request& request) { return routes.controls(request.get_param_value("case")); });
        get("/progress", [this](const httplib::Request&) { return routes.progress(); });
        get("/alive", [](const httplib::Request&) { return Reply{200, "{\"alive\":true}"}; });
        post("/render", [this](const std::string& body) { return routes.render(body); });
        post("/trace", [this](const std::string& body) { return routes.trace(body); });
        post("/save", [this](const std::string& body) { return routes.save(body); });
        post("/cancel", [this](const std::string&) { return routes.cancel(); });
    }

    void configure()
    {
        using HandlerResponse = httplib::Server::HandlerResponse;
        server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
        // httplib's own options let a second server share the port.
        server.set_socket_options([](socket_t socket) {
            const int yes = 1;
            ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
        });
        server.set_tcp_nodelay(true);
        server.set_keep_alive_max_count(1); // what is left of a refused body is nobody's next request
        server.set_read_timeout(kReadSeconds);
        server.set_write_timeout(kWriteSeconds);
        server.set_default_headers({{"Cache-Control", "no-store"},
                                    {"Content-Security-Policy", kContentPolicy},
                                    {"Cross-Origin-Resource-Policy", "same-origin"},
                                    {"Referrer-Policy", "no-referrer"},
                                    {"X-Content-Type-Options", "nosniff"},
                                    {"X-Frame-Options", "DENY"}});
        server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            const std::optional<Reply> refusal = refuse(request);
            if (!refusal) return HandlerResponse::Unhandled;
            fill(response, *refusal);
            return HandlerResponse::Handled;
        });
        server.set_error_handler([](const httplib::Request&, httplib::Response& response) {
            if (response.has_header("Content-Type")) return; // it has its answer
            const int status = response.status;
            fill(response,
                 makeErrorReply(status, status == 404 ? "there is nothing here" : "the request is not understood"));
        });
        server.set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
            fill(response, makeErrorReply(500, "unexpected failure"));
        });
    }

    InspectorRoutes& routes;
    const std::string token;
    httplib::Server server;
    int port = 0;
    std::thread thread;
};

InspectorServer::InspectorServer(InspectorRoutes& routes, std::string token, int port)
    : impl_(std::make_unique<Impl>(routes, std::move(token)))
{
    impl_->configure();
    impl_->addRoutes();
    if (port == 0) {
        impl_->port = impl_->server.bind_to_any_port(kAddress);
        if (impl_->port <= 0) throw EnvironmentError("no port of 127.0.0.1 can be listened on");
    } else {
        if (!impl_->server.bind_to_port(kAddress, port)) {
            throw EnvironmentError(
                fmt::format("--port {}: it cannot be listened on; another one, or 0 for a free one, is allowed", port));
        }
        impl_->port = port;
    }
}

InspectorServer::~InspectorServer()
{
    stop();
}

int InspectorServer::port() const
{
    return impl_->port;
}

std::string InspectorServer::url() const
{
    return fmt::format("http://{}:{}/?token={}", kAddress, impl_->port, impl_->token);
}

void InspectorServer::start()
{
    impl_->thread = std::thread([this] { impl_->server.listen_after_bind(); });
    while (!impl_->server.is_running())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void InspectorServer::stop()
{
    if (!impl_->thread.joinable()) return;
    impl_->server.stop();
    impl_->routes.close();
    impl_->thread.join();
}

} // namespace crossray
