// What a server of a page answers, to a client that is not ours in its place: a plain socket.
#include "apps/live/page_server.h"
#include "core/base/error.h"

#include <gtest/gtest.h>
#include <boost/asio.hpp>

#include <sys/resource.h>
#include <unistd.h>
#include <chrono>
#include <ctime>
#include <sstream>
#include <thread>

namespace neumann::page_server_test {

using boost::asio::ip::tcp;

int port_of(const PageServer& server) {
    const std::string address = server.address();
    EXPECT_TRUE(address.starts_with("http://127.0.0.1:"));
    return std::stoi(address.substr(std::string("http://127.0.0.1:").size()));
}

// All that comes back for these lines.
std::string answer(const PageServer& server, const std::string& what, const std::string& host = "127.0.0.1") {
    tcp::iostream stream("127.0.0.1", std::to_string(port_of(server)));
    stream << what << " HTTP/1.1\r\nHost: " << host << "\r\nConnection: close\r\n\r\n" << std::flush;
    std::ostringstream all;
    all << stream.rdbuf();
    return all.str();
}
std::string body(const std::string& answer) { return answer.substr(answer.find("\r\n\r\n") + 4); }
nlohmann::json progress(const PageServer& server, std::uint64_t after, const std::string& page = "p") {
    return nlohmann::json::parse(body(answer(server, "GET /progress?page=" + page + "&after=" + std::to_string(after))));
}

TEST(PageServer, WaitsForDataAndHandsThemOut) {
    PageServer server(0);
    EXPECT_NE(body(answer(server, "GET /")).find("No samples yet"), std::string::npos);
    EXPECT_TRUE(answer(server, "GET /preview.png").starts_with("HTTP/1.1 404"));
    server.announce("</script>.xml");
    server.preview("PNG");
    EXPECT_NE(body(answer(server, "GET /")).find("id=\"title\">\"\\u003c/script>.xml\"</script>"), std::string::npos);
    EXPECT_EQ(body(answer(server, "GET /preview.png")), "PNG");
    server.tell({{"samples", 3}});
    nlohmann::json news = progress(server, 0);  // after a second without any
    EXPECT_EQ(news.at("version"), 0);
    EXPECT_EQ(news.at("samples"), 3);
    EXPECT_EQ(news.at("finished"), false);
    server.show("<script id=\"data\">1</script>");
    news = progress(server, 0);
    EXPECT_EQ(news.at("version"), 1);
    EXPECT_EQ(body(answer(server, "GET /data")), "<script id=\"data\">1</script>");
    const std::string page = body(answer(server, "GET /"));
    EXPECT_NE(page.find("id=\"live\">1</script>\n<script id=\"data\">1</script>"), std::string::npos);
    server.finish("last");
    news = progress(server, 1);
    EXPECT_EQ(news.at("version"), 2);
    EXPECT_EQ(news.at("finished"), true);
    EXPECT_EQ(body(answer(server, "GET /data")), "last");
}

TEST(PageServer, AnswersItsOwnHostAndReadersOnly) {
    PageServer server(0);
    server.show("secret");
    for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "localhost:1", "[::1]:8080"})
        EXPECT_TRUE(answer(server, "GET /data", host).starts_with("HTTP/1.1 200")) << host;
    for (const char* host : {"evil.example", "127.0.0.1.evil.example", "localhost.evil.example:80", "[::2]", ""}) {
        const std::string refused = answer(server, "GET /data", host);
        EXPECT_TRUE(refused.starts_with("HTTP/1.1 403")) << host;
        EXPECT_EQ(refused.find("secret"), std::string::npos);
    }
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS"})
        EXPECT_TRUE(answer(server, std::string(method) + " /data").starts_with("HTTP/1.1 405")) << method;
    EXPECT_TRUE(answer(server, "GET /etc/passwd").starts_with("HTTP/1.1 404"));
    EXPECT_EQ(answer(server, "GET /data").find("Access-Control"), std::string::npos);
}

// News that cannot be told, a list in place of an object, cost the connection that asked for them; the next one is answered.
TEST(PageServer, AnErrorEndsAConnectionAndNotTheServer) {
    PageServer server(0);
    server.tell(nlohmann::ordered_json::array());
    EXPECT_EQ(answer(server, "GET /progress?page=p&after=1"), "");
    server.tell({{"samples", 3}});
    EXPECT_EQ(progress(server, 1).at("samples"), 3);
}

// Where a connection gets no descriptor the server waits, for less of the processor than a third of the time, and takes it later.
TEST(PageServer, WaitsForADescriptor) {
    PageServer server(0);
    boost::asio::io_context io;
    tcp::socket client(io, tcp::v4());
    rlimit all{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &all), 0);
    const int free = ::dup(0);
    ::close(free);
    rlimit none = all;
    none.rlim_cur = static_cast<rlim_t>(free);
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
    client.connect({boost::asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port_of(server))});
    const std::clock_t before = std::clock();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &all), 0);
    EXPECT_LT(seconds, 0.1);
    const std::string asked = "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n";
    boost::asio::write(client, boost::asio::buffer(asked));
    std::string answer;
    boost::system::error_code end;
    boost::asio::read(client, boost::asio::dynamic_buffer(answer), end);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
}

TEST(PageServer, APortThatIsTakenIsRefused) {
    const PageServer server(0);
    const int port = port_of(server);
    try {
        const PageServer second(static_cast<std::uint16_t>(port));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(),
                  "live " + std::to_string(port) +
                      ": this port of 127.0.0.1 cannot be had: Address already in use; without a number any free one is "
                      "taken");
    }
}

// Who looks has the last data before the server goes; who does not come is not waited for.
TEST(PageServer, WaitsForPagesThatAreOpen) {
    using Clock = std::chrono::steady_clock;
    using std::chrono::milliseconds;
    PageServer server(0);
    auto begin = Clock::now();
    server.wait_for_pages(false);
    EXPECT_LT(Clock::now() - begin, milliseconds(500));
    server.wait_for_pages(true, milliseconds(300));
    EXPECT_GE(Clock::now() - begin, milliseconds(300));
    server.show("first");
    progress(server, 0);
    server.finish("last");
    begin = Clock::now();
    server.wait_for_pages(false, milliseconds(300));
    EXPECT_GE(Clock::now() - begin, milliseconds(300));
    progress(server, 2);
    begin = Clock::now();
    server.wait_for_pages(true);
    EXPECT_LT(Clock::now() - begin, milliseconds(500));
}

}  // namespace neumann::page_server_test
