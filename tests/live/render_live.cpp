// `neumann render --live` and `--tev`: what goes over the wire is read by a program of our own, and the render stays as it is.
#include "tests/commands/run_command.h"

#include <gtest/gtest.h>
#include <boost/asio/ip/tcp.hpp>

#include <cstring>
#include <future>
#include <map>

namespace neumann::render_live_test {

using boost::asio::ip::tcp;

// A tev that reads until the connection ends: by tev's own description of its packets (include/tev/Ipc.h).
struct Received {
    std::string name;
    int width = 0, height = 0;
    std::vector<std::string> channels;
    std::map<std::string, std::vector<float>> values;  // by channel
    int updates = 0;
};

class Reader {
public:
    explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}
    template <typename T>
    T number() {
        T value;
        std::memcpy(&value, bytes_.substr(at_, sizeof value).data(), sizeof value);
        at_ += sizeof value;
        return value;
    }
    std::string text() {
        const std::string found = bytes_.c_str() + at_;
        at_ += found.size() + 1;
        return found;
    }
    std::size_t left() const { return bytes_.size() - at_; }

private:
    std::string bytes_;
    std::size_t at_ = 0;
};

void take(Reader packet, Received& image) {
    const int operation = packet.number<std::uint8_t>();
    EXPECT_EQ(packet.number<std::uint8_t>(), 0);
    const std::string name = packet.text();
    if (operation == 4) {
        image.name = name;
        image.width = packet.number<std::int32_t>();
        image.height = packet.number<std::int32_t>();
        const auto count = packet.number<std::int32_t>();
        for (int i = 0; i < count; ++i) image.channels.push_back(packet.text());
    } else {
        ASSERT_EQ(operation, 6);
        EXPECT_EQ(name, image.name);
        const auto count = static_cast<std::size_t>(packet.number<std::int32_t>());
        std::vector<std::string> channels;
        for (std::size_t i = 0; i < count; ++i) channels.push_back(packet.text());
        EXPECT_EQ(packet.number<std::int32_t>(), 0);
        EXPECT_EQ(packet.number<std::int32_t>(), 0);
        const auto width = packet.number<std::int32_t>(), height = packet.number<std::int32_t>();
        std::vector<std::int64_t> offset(count), stride(count);
        for (auto& o : offset) o = packet.number<std::int64_t>();
        for (auto& s : stride) s = packet.number<std::int64_t>();
        std::vector<float> data(packet.left() / sizeof(float));
        for (float& v : data) v = packet.number<float>();
        const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        for (std::size_t c = 0; c < count; ++c) {
            std::vector<float>& to = image.values[channels[c]];
            to.resize(pixels);
            for (std::size_t p = 0; p < pixels; ++p)
                to[p] = data.at(static_cast<std::size_t>(offset[c]) + p * static_cast<std::size_t>(stride[c]));
        }
        ++image.updates;
    }
    EXPECT_EQ(packet.left(), 0u);
}

class RenderLive : public CommandTest {
protected:
    const std::string scene = std::string(SCENES) + "/cornell-box/cornell-box.xml";
    std::vector<std::string> render(const std::string& to, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"render", scene, "-D", "res=16", "-n", "2", "--spp", "64", "--method", "walk", "-o", to};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void expect_same_pictures(const std::string& a, const std::string& b) const {
        for (const std::string& name : names(a))
            if (name.ends_with(".exr")) {
                EXPECT_EQ(text_of(path(a) / name), text_of(path(b) / name)) << name;
            }
        EXPECT_EQ(names(a), names(b));
    }
};

TEST_F(RenderLive, TheBitsAreThoseOfARenderAlone) {
    ASSERT_EQ(run(render("a")).exit_code, 0);
    const Finished done = run(render("b", {"--live"}));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_TRUE(done.err.starts_with("The page of this render, which fills meanwhile: http://127.0.0.1:")) << done.err;
    expect_same_pictures("a", "b");
    // The option may stand before the scene.
    EXPECT_EQ(run({"render", "--live", scene, "-D", "res=8", "-n", "1", "--spp", "4", "-o", "c"}).exit_code, 0);
}

TEST_F(RenderLive, APortThatIsTakenIsRefusedBeforeTheScene) {
    boost::asio::io_context io;
    const tcp::acceptor taken(io, tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0));
    const std::string port = std::to_string(taken.local_endpoint().port());
    EXPECT_EQ(refused(render("a", {"--live", port})),
              "--live " + port +
                  ": this port of 127.0.0.1 cannot be had: Address already in use; without a number any free one is taken\n");
    EXPECT_EQ(names(), Names{});
}

TEST_F(RenderLive, TevGetsEachBounceAndSum) {
    boost::asio::io_context io;
    tcp::acceptor acceptor(io, tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0));
    auto received = std::async(std::launch::async, [&] {
        tcp::iostream stream(acceptor.accept());
        Received image;
        std::uint32_t length = 0;
        while (stream.read(reinterpret_cast<char*>(&length), sizeof length)) {
            std::string packet(length - sizeof length, '\0');
            stream.read(packet.data(), static_cast<std::streamsize>(packet.size()));
            take(Reader(std::move(packet)), image);
        }
        return image;
    });
    const Finished done = run(render("a", {"--tev", "localhost:" + std::to_string(acceptor.local_endpoint().port())}));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const Received image = received.get();
    EXPECT_EQ(image.name, "a");
    EXPECT_EQ(image.width, 16);
    EXPECT_EQ(image.height, 16);
    std::vector<std::string> expected{"R", "G", "B"};
    for (const char* layer : {"bounce_000", "bounce_001", "bounce_002", "rest", "sum_000", "sum_001", "sum_002"})
        for (const char* channel : {".R", ".G", ".B"}) expected.push_back(std::string(layer) + channel);
    EXPECT_EQ(image.channels, expected);
    EXPECT_GE(image.updates, 2 * 8);  // so far, and in the end
    // What was sent last is what the files hold, as another program reads them.
    const Finished read =
        run_program({PYTHON, "-c",
                     "import OpenImageIO as oiio\n"
                     "for name in ('bounce_000', 'bounce_001', 'bounce_002', 'sum_002', 'rest'):\n"
                     "    image = oiio.ImageBuf('a/' + name + '.exr')\n"
                     "    names = image.spec().channelnames\n"
                     "    pixels = image.get_pixels(oiio.FLOAT)\n"
                     "    for c in 'RGB':\n"
                     "        print(name + '.' + c, *[repr(float(v)) for v in pixels[:, :, names.index(c)].flatten()])\n"});
    ASSERT_EQ(read.exit_code, 0) << read.err;
    std::istringstream lines(read.out);
    int compared = 0;
    for (std::string line; std::getline(lines, line); ++compared) {
        std::istringstream words(line);
        std::string channel;
        words >> channel;
        for (const float sent : image.values.at(channel)) {
            double value = -1.0;
            words >> value;
            EXPECT_EQ(sent, static_cast<float>(value)) << channel;
        }
        if (channel.starts_with("sum_002")) {
            EXPECT_EQ(image.values.at(channel), image.values.at(channel.substr(8)));
        }
    }
    EXPECT_EQ(compared, 15);
}

TEST_F(RenderLive, TevThatIsNotThereOrGoesAway) {
    std::string port;
    {
        boost::asio::io_context io;
        const tcp::acceptor once(io, tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0));
        port = std::to_string(once.local_endpoint().port());
    }
    const std::string place = "127.0.0.1:" + port;
    EXPECT_EQ(refused(render("a", {"--tev", place})),
              "--tev " + place +
                  ": nobody answers there: Connection refused; expected a tev that is running, which listens at "
                  "127.0.0.1:14158 unless its --host says otherwise\n");
    EXPECT_EQ(refused(render("a", {"--tev", "here"})), "--tev here: expected HOST:PORT, such as 127.0.0.1:14158\n");
    EXPECT_EQ(names(), Names{});

    boost::asio::io_context io;
    tcp::acceptor acceptor(io, tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0));
    auto gone = std::async(std::launch::async, [&] { acceptor.accept().close(); });
    const Finished done = run(render("a", {"--tev", "127.0.0.1:" + std::to_string(acceptor.local_endpoint().port())}));
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_NE(done.err.find("is not there any more, and gets no more pictures"), std::string::npos) << done.err;
    EXPECT_TRUE(std::filesystem::exists(path("a/index.html")));
}

}  // namespace neumann::render_live_test
