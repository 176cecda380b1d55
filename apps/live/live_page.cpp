#include "apps/live/live_page.h"

#include "apps/live/open_browser.h"

namespace neumann {

void LivePage::open() { is_opened_ = open_browser(address()); }

void LivePage::tell(const RenderProgress& progress) {
    constexpr std::chrono::milliseconds between(200);
    const std::unique_lock lock(telling_, std::try_to_lock);
    const auto now = std::chrono::steady_clock::now();
    if (!lock || now - last_report_ < between) return;
    last_report_ = now;
    nlohmann::ordered_json json = {{"samples", progress.samples}, {"seconds", progress.seconds}, {"fraction", progress.fraction}};
    if (progress.seconds_left) json["seconds_left"] = *progress.seconds_left;
    server_.tell(std::move(json));
}

void LivePage::see(const Rendering& so_far) { server_.show(page_data(so_far, true)); }

void LivePage::finish(std::string data, const std::string& file) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (!file.empty()) json["file"] = file;
    server_.tell(std::move(json));
    server_.finish(std::move(data));
    server_.wait_for_pages(is_opened_);
}

}  // namespace neumann
