#include "apps/live/tev_viewer.h"

#include "apps/live/tev_packets.h"
#include "apps/output/files/series_files.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <boost/asio/ip/tcp.hpp>

#include <fcntl.h>
#include <chrono>

namespace neumann {

namespace {

constexpr std::chrono::seconds longest_wait{10};  // until tev has taken a packet
const std::string rest_layer = "rest";

// A name without its ending: "bounce_003".
std::string layer_of(const std::string& file) { return file.substr(0, file.rfind('.')); }

}  // namespace

struct TevViewer::Connection {
    boost::asio::ip::tcp::iostream stream;
};

TevViewer::TevViewer(const std::string& place, std::string name, std::function<void(const std::string&)> tell)
    : connection_(std::make_unique<Connection>()), place_(place), name_(std::move(name)), tell_(std::move(tell)) {
    const std::size_t colon = place.rfind(':');
    if (colon == place.npos || colon == 0 || colon + 1 == place.size())
        throw OptionError("tev", fmt::format("{}: expected HOST:PORT, such as 127.0.0.1:14158", place));
    std::string host = place.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    auto& stream = connection_->stream;
    stream.expires_after(longest_wait);
    const std::string port = place.substr(colon + 1);
    if (port.size() > 5 || port.find_first_not_of("0123456789") != port.npos || std::stoi(port) > 65535)
        throw OptionError("tev", fmt::format("{}: {} is no port; expected HOST:PORT, such as 127.0.0.1:14158", place, port));
    stream.connect(host, port);
    if (!stream)
        throw OptionError("tev", fmt::format("{}: nobody answers there: {}; expected a tev that is running, which listens at "
                                             "127.0.0.1:14158 unless its --host says otherwise",
                                             place, stream.error().message()));
    ::fcntl(stream.rdbuf()->native_handle(), F_SETFD, FD_CLOEXEC);
}

TevViewer::~TevViewer() = default;

void TevViewer::send(const std::string& packet) {
    if (!connection_) return;
    auto& stream = connection_->stream;
    stream.expires_after(longest_wait);
    stream.write(packet.data(), static_cast<std::streamsize>(packet.size())).flush();
    if (stream) return;
    tell_(fmt::format("warning: tev at {} is not there any more, and gets no more pictures: {}", place_, stream.error().message()));
    connection_.reset();
}

void TevViewer::see(const Rendering& so_far) {
    if (!connection_) return;
    const BounceSeries& series = so_far.series;
    const std::size_t bounces = series.report.bounces.size(), layers = 2 * bounces + (series.rest ? 1 : 0);
    if (layers != layers_) {
        std::vector<std::string> channels = tev_channels("");
        const auto add = [&](const std::string& file) {
            const auto of_layer = tev_channels(layer_of(file));
            channels.insert(channels.end(), of_layer.begin(), of_layer.end());
        };
        for (std::size_t i = 0; i < bounces; ++i) add(bounce_file(i));
        if (series.rest) add(rest_layer);
        for (std::size_t i = 0; i < bounces; ++i) add(sum_file(i));
        const Film& film = so_far.scene->film;
        send(tev_create_image(name_, film.crop_width, film.crop_height, channels));
        layers_ = layers;
    }
    const auto update = [&](const std::string& file, const Image& picture) {
        send(tev_update_image(name_, layer_of(file), picture));
    };
    for (std::size_t i = 0; i < bounces; ++i) update(bounce_file(i), series.term(i).mean);
    if (series.rest) update(rest_layer, series.rest->mean);
    for (std::size_t i = 0; i < bounces; ++i) {
        const Image sum = series.sum(i).mean;
        update(sum_file(i), sum);
        if (i + 1 == bounces) send(tev_update_image(name_, "", sum));
    }
}

}  // namespace neumann
