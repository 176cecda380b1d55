// A running tev that shows a render while it is under way: an image with a layer for each bounce and each sum, and the
// sum of all bounces without a layer name.
#pragma once

#include "apps/live/viewer.h"

#include <functional>
#include <memory>
#include <string>

namespace neumann {

class TevViewer : public Viewer {
public:
    // `place`: "HOST:PORT", also "[::1]:14158"; `name`: of the image; `tell`: called once, with a message, if the
    // connection is lost. Throws InputError if nobody listens there.
    TevViewer(const std::string& place, std::string name, std::function<void(const std::string&)> tell);
    ~TevViewer() override;

    void see(const Rendering& so_far) override;

private:
    void send(const std::string& packet);

    struct Connection;
    std::unique_ptr<Connection> connection_;
    std::string place_, name_;
    std::function<void(const std::string&)> tell_;
    std::size_t layers_ = 0;  // number of layers of the created image
};

}  // namespace neumann
