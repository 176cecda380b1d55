// The page of a render that is under way, served to browsers on this machine: GET / is the page, /progress waits for news, and
// /data is what the page shows.
#pragma once

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace neumann {

class PageServer {
public:
    // On 127.0.0.1, in a thread of its own; port 0: any that is free. Throws InputError if it cannot be had.
    explicit PageServer(std::uint16_t port);
    ~PageServer();

    // "http://127.0.0.1:8137/"
    std::string address() const;

    // From any thread; none waits for a browser. Data are those of explorer_data(); `progress`: an object.
    void tell(nlohmann::ordered_json progress);
    void show(std::string data);
    // The last data.
    void finish(std::string data);

    // Waits until pages that are open have the last data, and where one `is_expected`, until it has come: so long at most.
    void wait_for_pages(bool is_expected, std::chrono::milliseconds at_most = std::chrono::seconds(5));

private:
    class Answers;
    std::unique_ptr<Answers> answers_;
};

}  // namespace neumann
