// Serves the page of an unfinished render to browsers on this machine: GET / returns the page, /progress waits for
// news, and /data returns the data that the page shows.
#pragma once

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace neumann {

class PageServer {
public:
    // Serves 127.0.0.1, in a thread of its own; port 0: any free port. Throws InputError if the port is not available.
    explicit PageServer(std::uint16_t port);
    ~PageServer();

    // "http://127.0.0.1:8137/"
    std::string address() const;

    // May be called from any thread, and do not wait. Data are those of explorer_data(); `progress`: an object.
    void tell(nlohmann::ordered_json progress);
    void show(std::string data);
    // What the page shows until there are data: a name of what is rendered, and a PNG.
    void announce(std::string title);
    void preview(std::string png);
    void finish(std::string data);

    // Waits until open pages, or one that `is_expected`, have the last data; but no longer than `at_most`.
    void wait_for_pages(bool is_expected, std::chrono::milliseconds at_most = std::chrono::seconds(5));

private:
    class Answers;
    std::unique_ptr<Answers> answers_;
};

}  // namespace neumann
