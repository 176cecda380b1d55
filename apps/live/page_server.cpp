#include "apps/live/page_server.h"

#include "apps/output/files/json_text.h"
#include "apps/output/pages/page.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include <fcntl.h>
#include <charconv>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <thread>

namespace neumann {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr seconds without_news{1}, patience{30}, open_for{3};
constexpr std::chrono::milliseconds before_again{200};
constexpr std::size_t most_pages = 64, longest_header = 16384;

// Whether the request names this machine. Another name may point here only so that a browser reads the page for its owner.
bool is_this_machine(std::string_view host) {
    if (host.starts_with('[')) return host.starts_with("[::1]");
    host = host.substr(0, host.find(':'));
    return host == "127.0.0.1" || host == "localhost";
}

// A browser that this process starts must not hold the process's sockets open after its end.
template <typename Socket>
void stays_here(Socket& socket) {
    ::fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
}

// A parameter of "/progress?page=x7&after=3".
std::string_view parameter(std::string_view target, std::string_view name) {
    for (std::size_t at = target.find('?'); at != target.npos;) {
        const std::size_t begin = at + 1, end = std::min(target.find('&', begin), target.size());
        const std::string_view part = target.substr(begin, end - begin);
        if (part.starts_with(name) && part.substr(name.size()).starts_with('=')) return part.substr(name.size() + 1);
        at = end == target.size() ? target.npos : end;
    }
    return {};
}

}  // namespace

// Everything except the public functions runs in the server's thread.
class PageServer::Answers {
public:
    explicit Answers(std::uint16_t port) : acceptor_(io_) {
        const asio::ip::tcp::endpoint here(asio::ip::address_v4::loopback(), port);
        boost::system::error_code error;
        acceptor_.open(here.protocol(), error);
        if (!error) {
            stays_here(acceptor_);
            // This is needed while connections of an earlier server are closing.
            acceptor_.set_option(asio::socket_base::reuse_address(true));
            acceptor_.bind(here, error);
        }
        if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
        if (error)
            throw OptionError(
                "live", fmt::format("{}: this port of 127.0.0.1 cannot be had: {}; without a number any free one is taken", port,
                                    error.message()));
        port_ = acceptor_.local_endpoint().port();
        accept();
        thread_ = std::thread([this] { serve(); });
    }
    ~Answers() {
        io_.stop();
        thread_.join();
    }

    std::uint16_t port() const { return port_; }
    void post(std::function<void()> what) { asio::post(io_, std::move(what)); }
    template <typename Function>
    auto ask(const Function& what) {
        std::promise<decltype(what())> promise;
        asio::post(io_, [&] { promise.set_value(what()); });
        return promise.get_future().get();
    }

    void tell(nlohmann::ordered_json progress) { progress_ = std::move(progress); }
    void show(std::string data, bool is_last) {
        data_ = std::move(data);
        ++version_;
        is_finished_ = is_last;
        for (const auto& session : waiting_) session->timer.cancel();
    }
    void announce(std::string title) { title_ = std::move(title); }
    void preview(std::string png) {
        preview_ = std::move(png);
        ++previews_;
    }
    bool has_pages() const { return !pages_.empty(); }
    bool all_have_the_last() const {
        for (const auto& [id, page] : pages_)
            if (!page.has_last && Clock::now() - page.seen < open_for) return false;
        return true;
    }

private:
    // A connection. It lives as long as one of its requests is being answered.
    struct Session {
        explicit Session(asio::ip::tcp::socket socket) : stream(std::move(socket)), timer(stream.get_executor()) {}
        beast::tcp_stream stream;
        asio::steady_timer timer;
        beast::flat_buffer buffer;
        std::optional<http::request_parser<http::empty_body>> request;
        http::response<http::string_body> reply;
        std::string page;  // the page that asks for news
    };
    using Shared = std::shared_ptr<Session>;

    struct Page {
        Clock::time_point seen;
        bool has_last = false;
    };

    // An error in a response, such as no memory for a page, ends its connection, but not the render.
    void serve() {
        for (;;) try {
                io_.run();
                return;
            } catch (const std::exception&) {
            }
    }
    void accept() {
        acceptor_.async_accept([this](boost::system::error_code error, asio::ip::tcp::socket socket) {
            if (error) {  // for example no free descriptor, which may last
                again_.expires_after(before_again);
                again_.async_wait([this](boost::system::error_code) { accept(); });
                return;
            }
            accept();
            stays_here(socket);
            read(std::make_shared<Session>(std::move(socket)));
        });
    }
    // The body is not read, because no request here has one.
    void read(const Shared& session) {
        session->request.emplace();
        session->request->header_limit(longest_header);
        session->stream.expires_after(patience);
        http::async_read_header(session->stream, session->buffer, *session->request,
                                [this, session](boost::system::error_code error, std::size_t) {
                                    if (!error) answer(session);
                                });
    }
    void answer(const Shared& session) {
        const auto& request = session->request->get();
        const std::string_view target(request.target().data(), request.target().size());
        const std::string_view host(request[http::field::host].data(), request[http::field::host].size());
        const std::string_view path = target.substr(0, target.find('?'));
        session->page.clear();
        if (!is_this_machine(host)) return send(session, http::status::forbidden, "text/plain", "not for this host\n");
        if (request.method() != http::verb::get)
            return send(session, http::status::method_not_allowed, "text/plain", "there is nothing to write here\n");
        if (path == "/") return send(session, http::status::ok, "text/html; charset=utf-8", whole_page());
        if (path == "/data") return send(session, http::status::ok, "text/plain; charset=utf-8", data_);
        if (path == "/progress") return wait_for_news(session, target);
        if (path == "/preview.png" && !preview_.empty()) return send(session, http::status::ok, "image/png", preview_);
        if (path == "/favicon.ico") return send(session, http::status::no_content, "text/plain", "");
        send(session, http::status::not_found, "text/plain", "there is no such thing here\n");
    }
    void wait_for_news(const Shared& session, std::string_view target) {
        std::uint64_t after = 0;
        const std::string_view text = parameter(target, "after");
        std::from_chars(text.data(), text.data() + text.size(), after);
        session->page = std::string(parameter(target, "page"));
        if (pages_.size() < most_pages || pages_.contains(session->page)) pages_[session->page].seen = Clock::now();
        if (after != version_ || is_finished_) return send_news(session, after);
        waiting_.insert(session);
        session->timer.expires_after(without_news);
        session->timer.async_wait([this, session, after](boost::system::error_code) {
            waiting_.erase(session);
            send_news(session, after);
        });
    }
    void send_news(const Shared& session, std::uint64_t after) {
        Json news = progress_;
        news["version"] = version_;
        if (previews_ > 0) news["preview"] = previews_;
        news["finished"] = is_finished_;
        if (!is_finished_ || after != version_) session->page.clear();
        send(session, http::status::ok, "application/json",
             json_text(news));  // a path may not be UTF-8
    }
    std::string whole_page() const {
        if (data_.empty()) {
            const std::string title =
                fmt::format("<script type=\"application/json\" id=\"title\">{}</script>\n", for_script(title_));
            return neumann::page("waiting.html", {title});
        }
        const std::string version = fmt::format("<script type=\"application/json\" id=\"live\">{}</script>\n", version_);
        return neumann::page("explorer.html", {version, data_});
    }
    void send(const Shared& session, http::status status, const char* type, std::string body) {
        const bool goes_on = session->request->get().keep_alive() && status == http::status::ok;
        auto& reply = session->reply = {status, 11};
        reply.set(http::field::content_type, type);
        reply.set(http::field::cache_control, "no-store");
        reply.set("X-Content-Type-Options", "nosniff");
        if (status == http::status::method_not_allowed) reply.set(http::field::allow, "GET");
        reply.keep_alive(goes_on);
        reply.body() = std::move(body);
        reply.prepare_payload();
        session->stream.expires_after(patience);
        http::async_write(session->stream, reply, [this, session, goes_on](boost::system::error_code error, std::size_t) {
            if (error) return;
            if (const auto page = pages_.find(session->page); page != pages_.end()) page->second.has_last = true;
            if (goes_on) return read(session);
            session->stream.socket().shutdown(asio::ip::tcp::socket::shutdown_send, error);
        });
    }

    asio::io_context io_;
    asio::ip::tcp::acceptor acceptor_;
    asio::steady_timer again_{io_};
    std::uint16_t port_ = 0;
    nlohmann::ordered_json progress_ = nlohmann::ordered_json::object();
    std::string title_, preview_, data_;
    std::uint64_t previews_ = 0;
    std::uint64_t version_ = 0;
    bool is_finished_ = false;
    std::map<std::string, Page> pages_;
    std::set<Shared> waiting_;
    std::thread thread_;
};

PageServer::PageServer(std::uint16_t port) : answers_(std::make_unique<Answers>(port)) {}
PageServer::~PageServer() = default;

std::string PageServer::address() const { return fmt::format("http://127.0.0.1:{}/", answers_->port()); }

void PageServer::tell(nlohmann::ordered_json progress) {
    answers_->post([to = answers_.get(), progress = std::move(progress)] { to->tell(progress); });
}
void PageServer::announce(std::string title) {
    answers_->post([to = answers_.get(), title = std::move(title)] { to->announce(title); });
}
void PageServer::preview(std::string png) {
    answers_->post([to = answers_.get(), png = std::move(png)] { to->preview(png); });
}
void PageServer::show(std::string data) {
    answers_->post([to = answers_.get(), data = std::move(data)]() mutable { to->show(std::move(data), false); });
}
void PageServer::finish(std::string data) {
    answers_->post([to = answers_.get(), data = std::move(data)]() mutable { to->show(std::move(data), true); });
}

void PageServer::wait_for_pages(bool is_expected, std::chrono::milliseconds at_most) {
    const auto until = Clock::now() + at_most;
    const auto have_it = [&] {
        return answers_->ask([&] { return (!is_expected || answers_->has_pages()) && answers_->all_have_the_last(); });
    };
    while (!have_it() && Clock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

}  // namespace neumann
