#include "core/reader/formats/pbrt/unpack.h"

#include "core/base/error.h"
#include "core/base/input_file.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <zlib.h>

namespace neumann::reader {

namespace {

constexpr std::size_t max_unpacked = std::size_t(1) << 31;

class Unpacker {
public:
    Unpacker(const std::string& path, std::string packed) : path_(path), packed_(std::move(packed)) {
        constexpr int with_gzip_header = 16;
        if (inflateInit2(&stream_, MAX_WBITS + with_gzip_header) != Z_OK) throw RunError("zlib could not be started");
    }
    ~Unpacker() { inflateEnd(&stream_); }
    Unpacker(const Unpacker&) = delete;
    Unpacker& operator=(const Unpacker&) = delete;

    std::string run() {
        std::string result;
        std::vector<char> part(std::size_t(1) << 16);
        std::size_t taken = 0;
        int state = Z_OK;
        while (state != Z_STREAM_END) {
            if (stream_.avail_in == 0) {
                const std::size_t some = std::min<std::size_t>(packed_.size() - taken, std::numeric_limits<uInt>::max());
                if (some == 0) throw InputError(path_ + ": ends before what is packed in it does");
                stream_.next_in = reinterpret_cast<Bytef*>(packed_.data() + taken);
                stream_.avail_in = static_cast<uInt>(some);
                taken += some;
            }
            stream_.next_out = reinterpret_cast<Bytef*>(part.data());
            stream_.avail_out = static_cast<uInt>(part.size());
            state = inflate(&stream_, Z_NO_FLUSH);
            if (state != Z_OK && state != Z_STREAM_END) throw InputError(path_ + ": is not a gzip file, or is damaged");
            result.append(part.data(), part.size() - stream_.avail_out);
            if (result.size() > max_unpacked) throw InputError(path_ + ": is longer than 2 GiB when it is unpacked");
        }
        return result;
    }

private:
    const std::string& path_;
    std::string packed_;
    z_stream stream_{};
};

}  // namespace

std::string read_unpacked(const std::string& path) {
    std::string bytes = read_input(path);
    return path.ends_with(".gz") ? Unpacker(path, std::move(bytes)).run() : bytes;
}

}  // namespace neumann::reader
