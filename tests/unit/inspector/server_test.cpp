// The inspector over the network, and what it refuses.
#include "harness/inspector/server.h"
#include "tests/unit/inspector/inspector_fixture.h"

#include "harness/base/error.h"

#include <fmt/format.h>
#include <httplib.h>

#include <arpa/inet.h>
#include <future>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

using namespace crossray;

namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

// A connection that says what it is told to, and no more.
class RawClient {
  public:
    RawClient(int port, std::string_view text) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
    {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<uint16_t>(port));
        ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
        isConnected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
        if (::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) < 0) isConnected_ = false;
    }
    ~RawClient() { ::close(socket_); }
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    bool isConnected() const { return isConnected_; }
    std::string readAll() const
    {
        std::string text;
        char buffer[4096];
        for (ssize_t count; (count = ::recv(socket_, buffer, sizeof(buffer), 0)) > 0;)
            text.append(buffer, static_cast<size_t>(count));
        return text;
    }

  private:
    int socket_;
    bool isConnected_ = false;
};

class ServerTest : public InspectorFixture {
  protected:
    void SetUp() override
    {
        InspectorFixture::SetUp();
        server_ = std::make_unique<InspectorServer>(*inspector_, kToken, 0);
        server_->start();
    }
    void TearDown() override { server_.reset(); }

    std::string host() const { return fmt::format("127.0.0.1:{}", server_->port()); }
    std::string say(const std::string& text) const { return RawClient(server_->port(), text).readAll(); }
    std::string ask(const std::string& target, const std::string& headers = "") const
    {
        return say(fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\n{}\r\n", target, host(), headers));
    }
    static int statusOf(const std::string& answer)
    {
        return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : -1;
    }
    int statusOf(const std::string& target, const std::string& headers) const { return statusOf(ask(target, headers)); }
    httplib::Result post(const std::string& route, const std::string& body) const
    {
        httplib::Client client("127.0.0.1", server_->port());
        client.set_read_timeout(60);
        return client.Post(route, {{"X-Crossray-Token", kToken}}, body, "application/json");
    }

    const std::string token_ = std::string("?token=") + kToken;
    std::unique_ptr<InspectorServer> server_;
};

} // namespace

TEST_F(ServerTest, answersWhoHasTheToken)
{
    EXPECT_EQ(server_->url(), fmt::format("http://{}/?token={}", host(), kToken));
    const std::string page = ask("/" + token_);
    EXPECT_EQ(statusOf(page), 200);
    EXPECT_NE(page.find("<!doctype html>"), std::string::npos);
    EXPECT_EQ(page.find("Access-Control"), std::string::npos);
    EXPECT_NE(page.find("Cache-Control: no-store"), std::string::npos);
    EXPECT_NE(page.find("Referrer-Policy: no-referrer"), std::string::npos);
    EXPECT_NE(page.find("frame-ancestors 'none'"), std::string::npos);
    EXPECT_EQ(statusOf("/alive", fmt::format("X-Crossray-Token: {}\r\n", kToken)), 200);
    EXPECT_EQ(statusOf("/controls" + token_ + "&case=floor", ""), 200);
    EXPECT_EQ(statusOf("/progress" + token_, ""), 200);
    const auto rendered = post("/render", question("floor"));
    ASSERT_TRUE(rendered);
    EXPECT_EQ(rendered->status, 200);
    const std::string piece = Json::parse(rendered->body)["planes"]["cpu64"];
    EXPECT_EQ(statusOf("/data/" + piece + token_, ""), 200);
    const auto traced = post("/trace", question("floor", {{"pixel", {8, 9}}}));
    ASSERT_TRUE(traced);
    EXPECT_EQ(traced->status, 200);
}

// Packing an answer took ten times as long as the shader.
TEST_F(ServerTest, sendsAnswersUnpackedWhateverABrowserAccepts)
{
    const auto rendered = post("/render", question("floor"));
    ASSERT_TRUE(rendered);
    const Json json = Json::parse(rendered->body);
    const std::string planes = json["planes"]["cpu64"], details = json["item"]["details"];
    for (const std::string& route :
         {std::string("/"), "/data/" + planes, "/data/" + details, std::string("/progress")}) {
        const std::string answer =
            say(fmt::format("GET {}{} HTTP/1.1\r\nHost: {}\r\nAccept-Encoding: gzip, deflate, br, zstd\r\n\r\n", route,
                            token_, host()));
        EXPECT_EQ(statusOf(answer), 200) << route;
        EXPECT_EQ(answer.find("Content-Encoding"), std::string::npos) << route;
        EXPECT_NE(answer.find("Content-Length: "), std::string::npos) << route;
    }
}

TEST_F(ServerTest, refusesWhoHasNoTokenOrAWrongOne)
{
    const std::string wrong = std::string(32, '0'), longer = std::string(kToken) + "0";
    for (const std::string& target :
         {std::string("/"), std::string("/?token="), "/?token=" + wrong, "/?token=" + longer, std::string("/alive"),
          std::string("/data/planes-1-0"), std::string("/nothing"), "/?token=" + std::string(kToken).substr(0, 31)}) {
        const std::string answer = ask(target);
        EXPECT_EQ(statusOf(answer), 403) << target;
        EXPECT_EQ(answer.find(kToken), std::string::npos);
        EXPECT_NE(answer.find("{\"error\":\"the token is missing or wrong"), std::string::npos) << answer;
    }
    EXPECT_EQ(statusOf("/" + token_, "X-Crossray-Token: wrong\r\n"), 403); // the header is what counts then
    const httplib::Headers none;
    httplib::Client client("127.0.0.1", server_->port());
    for (const char* route : {"/render", "/trace", "/save", "/cancel"})
        EXPECT_EQ(client.Post(route, none, question("floor"), "application/json")->status, 403) << route;
    EXPECT_FALSE(isSameToken("", kToken));
    EXPECT_TRUE(isSameToken(kToken, kToken));
    EXPECT_FALSE(isSameToken(longer, kToken));
}

TEST_F(ServerTest, refusesAForeignHostAndAForeignPage)
{
    const auto withHost = [&](const std::string& line) {
        return statusOf(say(fmt::format("GET /{} HTTP/1.1\r\n{}\r\n", token_, line)));
    };
    EXPECT_EQ(withHost(fmt::format("Host: localhost:{}\r\n", server_->port())), 200);
    EXPECT_EQ(withHost("Host: evil.example\r\n"), 403);
    EXPECT_EQ(withHost(fmt::format("Host: evil.example:{}\r\n", server_->port())), 403);
    EXPECT_EQ(withHost("Host: 127.0.0.1\r\n"), 403);
    EXPECT_EQ(withHost("Host: 127.0.0.1:1\r\n"), 403);
    EXPECT_EQ(withHost(""), 403);
    EXPECT_EQ(withHost(fmt::format("Host: {}\r\nHost: evil.example\r\n", host())), 403);
    EXPECT_EQ(statusOf("/" + token_, fmt::format("Origin: http://{}\r\n", host())), 200);
    EXPECT_EQ(statusOf("/" + token_, "Origin: http://evil.example\r\n"), 403);
    EXPECT_EQ(statusOf("/" + token_, "Origin: null\r\n"), 403);
}

TEST_F(ServerTest, servesNothingBesideItsRoutes)
{
    for (const char* target : {"/index.html", "/data/", "/data/../../etc/passwd",
                               "/data/%2e%2e%2f%2e%2e%2fetc%2fpasswd", "/../etc/passwd", "//etc/passwd", "/etc/passwd",
                               "/data/planes-1-0.js", "/render", "/data/PLANES", "/floor.toml", "/%00", "/alive/"}) {
        const std::string answer = ask(target + token_);
        EXPECT_EQ(statusOf(answer), 404) << target;
        EXPECT_EQ(answer.find("root:"), std::string::npos);
    }
    EXPECT_EQ(statusOf(say(fmt::format("DELETE /alive{} HTTP/1.1\r\nHost: {}\r\n\r\n", token_, host()))), 404);
    EXPECT_EQ(statusOf(say(fmt::format("OPTIONS /render{} HTTP/1.1\r\nHost: {}\r\nOrigin: http://evil.example\r\n\r\n",
                                       token_, host()))),
              403);
}

TEST_F(ServerTest, refusesABodyThatIsTooLargeOrNone)
{
    const auto large = post("/render", std::string(kMostBodyBytes + 1, ' '));
    ASSERT_TRUE(large);
    EXPECT_EQ(large->status, 413);
    // Without a length, piece by piece.
    std::string chunked =
        fmt::format("POST /render{} HTTP/1.1\r\nHost: {}\r\nTransfer-Encoding: chunked\r\n\r\n", token_, host());
    for (int i = 0; i < 20; ++i)
        chunked += "1000\r\n" + std::string(0x1000, ' ') + "\r\n";
    EXPECT_EQ(statusOf(say(chunked + "0\r\n\r\n")), 413);
    const auto broken = post("/render", "{\"case\":");
    ASSERT_TRUE(broken);
    EXPECT_EQ(broken->status, 400);
    EXPECT_EQ(statusOf(say(fmt::format("POST /render{} HTTP/1.1\r\nHost: {}\r\nContent-Encoding: gzip\r\n"
                                       "Content-Length: 2\r\n\r\n{{}}",
                                       token_, host()))),
              400);
    EXPECT_EQ(statusOf(say(fmt::format("POST /render{} HTTP/1.1\r\nHost: {}\r\nContent-Type: multipart/form-data; "
                                       "boundary=x\r\nContent-Length: 2\r\n\r\n{{}}",
                                       token_, host()))),
              400);
    for (const char* noise : {"\r\n\r\n", "nonsense\r\n\r\n", "GET\r\n\r\n", "\x16\x03\x01\x02"}) {
        const RawClient client(server_->port(), noise);
        EXPECT_TRUE(client.isConnected());
    }
    EXPECT_EQ(statusOf("/alive" + token_, ""), 200);
}

TEST_F(ServerTest, clientsThatHangKeepNobodyWaiting)
{
    std::vector<std::unique_ptr<RawClient>> idle;
    for (int i = 0; i < 24; ++i)
        idle.push_back(
            std::make_unique<RawClient>(server_->port(), i % 2 == 0 ? "" : "POST /render HTTP/1.1\r\nHost:"));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(statusOf("/alive" + token_, ""), 200);
    EXPECT_LT(std::chrono::steady_clock::now() - start, 4s); // less than a silent client is granted
}

TEST_F(ServerTest, twoClientsAtOnceAreBothAnswered)
{
    const auto run = [&](const std::string& testCase, double fov) {
        int done = 0;
        for (int i = 0; i < 10; ++i) {
            const auto reply = post("/render", question(testCase, {{"parameters", {{"camera.fov", fov + i}}}}));
            EXPECT_TRUE(reply);
            if (!reply) break;
            EXPECT_TRUE(reply->status == 200 || reply->status == 409) << reply->body;
            const Json json = Json::parse(reply->body);
            EXPECT_TRUE(reply->status == 200 || json["superseded"] == true);
            EXPECT_TRUE(reply->status == 409 || json["item"]["name"] == testCase);
            done += reply->status == 200;
            const auto trace = post("/trace", question(testCase, {{"pixel", {8, 9}}}));
            EXPECT_TRUE(trace && (trace->status == 200 || trace->status == 409));
        }
        return done;
    };
    std::future<int> first = std::async(std::launch::async, [&] { return run("floor", 40); });
    const int second = run("hang", 50); // on cpu64 it is a case like another
    EXPECT_GT(first.get() + second, 0);
    const auto last = post("/render", question("floor"));
    ASSERT_TRUE(last);
    EXPECT_EQ(last->status, 200);
}

TEST_F(ServerTest, whoWaitsWhenItEndsHasAnAnswer)
{
    std::future<int> waiting = std::async(std::launch::async, [&] {
        const auto reply = post("/render", question("hang", {{"backends", {"test"}}}));
        return reply ? reply->status : 0;
    });
    while (!parse(inspector_->progress())["busy"])
        std::this_thread::sleep_for(2ms);
    const auto start = std::chrono::steady_clock::now();
    server_->stop();
    EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
    EXPECT_EQ(waiting.get(), 409);
}

TEST_F(ServerTest, aPortIsTakenOnce)
{
    try {
        InspectorServer second(*inspector_, kToken, server_->port());
        FAIL() << "it listens twice";
    } catch (const EnvironmentError& error) {
        EXPECT_EQ(std::string(error.what()),
                  fmt::format("--port {}: it cannot be listened on; another one, or 0 for a free one, is allowed",
                              server_->port()));
    }
    EXPECT_EQ(makeToken().size(), 32u);
    EXPECT_NE(makeToken(), makeToken());
}
