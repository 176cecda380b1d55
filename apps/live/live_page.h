// The explorer of an unfinished render, on a server of this process.
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
    // Port 0: any free port. Throws InputError if the port is not available.
    explicit LivePage(std::uint16_t port) : server_(port) {}

    std::string address() const { return server_.address(); }
    // What the page shows before the first pictures: the scene's name, and previews as PNG.
    void announce(const std::string& scene) { server_.announce(scene); }
    void preview(std::string png) { server_.preview(std::move(png)); }
    // Opens the page in a browser, if there is a display.
    void open();
    // Call if a browser will request the page.
    void expect() { is_opened_ = true; }

    // May be called from any thread; most calls do nothing.
    void tell(const RenderProgress& progress);
    void see(const Rendering& so_far) override;
    // Sends the last data, and writes them into `file` if it is not empty. When this returns, open pages have them.
    void finish(std::string data, const std::string& file);

private:
    PageServer server_;
    bool is_opened_ = false;
    std::mutex telling_;
    std::chrono::steady_clock::time_point last_report_{};
};

}  // namespace neumann
