// The explorer of a render that is under way, on a server of this process.
#pragma once

#include "apps/live/page_server.h"
#include "apps/live/viewer.h"
#include "operators/watch.h"

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace neumann {

class LivePage : public Viewer {
public:
    // Port 0: any that is free. Throws InputError if it cannot be had.
    explicit LivePage(std::uint16_t port) : server_(port) {}

    std::string address() const { return server_.address(); }
    // Opens it in a browser, where there is a display.
    void open();
    // A browser will ask for it.
    void expect() { is_opened_ = true; }

    // From any thread; most calls do nothing.
    void tell(const RenderProgress& progress);
    void see(const Rendering& so_far) override;
    // The last data, and the file that has them, too, if there is one. When this returns, pages that are open have them.
    void finish(std::string data, const std::string& file);

private:
    PageServer server_;
    bool is_opened_ = false;
    std::mutex telling_;
    std::chrono::steady_clock::time_point told_{};
};

}  // namespace neumann
